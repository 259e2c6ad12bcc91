#include "scene/3d/bake_inputs.h"

#include "core/assert.h"
#include "core/io/log.h"
#include "core/threads.h"

#include <numeric>
#include <unordered_map>
#include <utility>

namespace cl::scene {

namespace {

/// Numbers things in the order in which they are met.
template <typename T>
class Numbers {
public:
    /// @return the thing's number, and whether it is new.
    std::pair<size_t, bool> add(const T* thing) {
        const auto [at, is_new] = known_.try_emplace(thing, known_.size());
        return {at->second, is_new};
    }

private:
    std::unordered_map<const T*, size_t> known_;
};

Digest digest_of(const MeshSurface& surface) {
    return Digester()
        .add(surface.format)
        .add(surface.vertex_count)
        .add(surface.index_count)
        .add(std::span<const uint8_t>(surface.vertices))
        .add(std::span<const uint8_t>(surface.indices))
        .digest();
}

void add_transform(Digester& digester, const Transform& t) {
    for (const glm::vec3& column : {t.basis[0], t.basis[1], t.basis[2], t.origin}) {
        digester.add(column.x).add(column.y).add(column.z);
    }
}

} // namespace

BakeInputs::BakeInputs(std::span<const BakeItem> items, BakeMemory* memory) {
    std::vector<const Material*> materials;
    list_surfaces(items, materials);
    check_surfaces(memory != nullptr);
    materials_.emplace(materials, memory ? &memory->captures : nullptr);
}

void BakeInputs::list_surfaces(std::span<const BakeItem> items, std::vector<const Material*>& materials) {
    Numbers<MeshSurface> surface_numbers;
    Numbers<Material> material_numbers;
    for (const BakeItem& item : items) {
        const std::span<const MeshSurface> surfaces = item.mesh->surfaces();
        for (size_t i = 0; i < surfaces.size(); ++i) {
            if (surfaces[i].primitive != PrimitiveType::Triangles) {
                continue;
            }
            const auto [stored, is_new_surface] = surface_numbers.add(&surfaces[i]);
            if (is_new_surface) {
                stored_.push_back({&surfaces[i], {}, {}, nullptr});
            }
            const auto [material, is_new_material] = material_numbers.add(item.materials[i].get());
            if (is_new_material) {
                materials.push_back(item.materials[i].get());
            }
            placed_.push_back({&item, stored, material});
        }
    }
}

void BakeInputs::check_surfaces(bool with_digests) {
    parallel_for_each(stored_.size(), [&](size_t i) {
        Stored& stored = stored_[i];
        if (const Status sound = validate_surface(*stored.surface); !sound) {
            stored.damage = sound.error();
        } else if (with_digests) {
            stored.digest = digest_of(*stored.surface);
        }
    });
    for (const Stored& stored : stored_) {
        if (stored.damage) {
            log_warning("GI bake: a surface is left out: " + stored.damage->message);
        }
    }
    std::erase_if(placed_, [this](const Placed& p) { return stored_[p.stored].damage.has_value(); });
}

std::vector<Digest> BakeInputs::digests() const {
    std::vector<Digest> digests;
    digests.reserve(placed_.size());
    for (const Placed& p : placed_) {
        Digester digester;
        add_transform(digester, p.item->probe_from_mesh);
        digests.push_back(
            digester.add(stored_[p.stored].digest).add(materials_->digest(p.material)).digest());
    }
    return digests;
}

void BakeInputs::decode(std::span<const uint32_t> numbers) {
    std::vector<bool> wanted(stored_.size());
    for (const uint32_t number : numbers) {
        wanted[placed_[number].stored] = true;
    }
    parallel_for_each(stored_.size(), [&](size_t i) {
        if (wanted[i] && !stored_[i].arrays) {
            Expected<SurfaceArrays> decoded = decode_surface(*stored_[i].surface);
            CL_ASSERT(decoded.has_value(), "the surface was found sound");
            stored_[i].arrays = std::make_unique<SurfaceArrays>(std::move(*decoded));
        }
    });
}

std::vector<gi::PlotSurface> BakeInputs::plots(std::span<const uint32_t> numbers) {
    decode(numbers);
    std::vector<gi::PlotSurface> plots;
    plots.reserve(numbers.size());
    for (const uint32_t number : numbers) {
        const Placed& p = placed_[number];
        const SurfaceArrays& arrays = *stored_[p.stored].arrays;
        plots.push_back({.local_from_mesh = p.item->probe_from_mesh,
                         .positions = arrays.positions,
                         .normals = arrays.normals,
                         .uvs = arrays.uvs,
                         .indices = arrays.indices,
                         .material = &materials_->capture(p.material)});
    }
    return plots;
}

std::vector<gi::PlotSurface> BakeInputs::all_plots() {
    std::vector<uint32_t> all(placed_.size());
    std::iota(all.begin(), all.end(), 0u);
    return plots(all);
}

int64_t BakeInputs::triangle_count() const {
    int64_t corners = 0;
    for (const Placed& p : placed_) {
        const MeshSurface& surface = *stored_[p.stored].surface;
        corners += surface.index_count > 0 ? surface.index_count : surface.vertex_count;
    }
    return corners / 3;
}

} // namespace cl::scene
