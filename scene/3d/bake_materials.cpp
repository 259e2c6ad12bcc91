#include "scene/3d/bake_materials.h"

#include "core/threads.h"

#include <algorithm>
#include <iterator>

namespace cl::scene {

namespace {

/// Whether both point to the very same picture; pictures are never changed in place.
bool is_same(const std::weak_ptr<const Image>& a, const std::shared_ptr<const Image>& b) {
    return !a.owner_before(b) && !b.owner_before(a);
}

bool is_made_of(const KeptCapture& kept, const BakeMaterial& material) {
    return kept.input == material.input && is_same(kept.albedo_image, material.albedo_image) &&
           is_same(kept.emission_image, material.emission_image);
}

bool has_texels(const KeptCapture& kept) {
    return kept.capture->albedo.size() > 1 || kept.capture->emission.size() > 1;
}

} // namespace

BakeMaterials::BakeMaterials(std::span<const Material* const> materials, std::vector<KeptCapture>* kept)
    : made_(materials.size()) {
    inputs_.reserve(materials.size());
    for (const Material* material : materials) { // on this thread: materials are not made for more
        inputs_.push_back(material ? material->bake_material() : BakeMaterial{});
    }
    if (!kept) {
        capture_others(false);
        return;
    }
    take(*kept);
    capture_others(true);
    kept->clear();
    std::copy_if(made_.begin(), made_.end(), std::back_inserter(*kept), has_texels);
}

void BakeMaterials::take(std::span<const KeptCapture> kept) {
    for (size_t i = 0; i < made_.size(); ++i) {
        const auto found = std::find_if(kept.begin(), kept.end(),
                                        [&](const KeptCapture& k) { return is_made_of(k, inputs_[i]); });
        if (found != kept.end()) {
            made_[i] = *found;
        }
    }
}

void BakeMaterials::capture_others(bool with_digests) {
    parallel_for_each(made_.size(), [&](size_t i) {
        if (made_[i].capture) {
            return;
        }
        const BakeMaterial& material = inputs_[i];
        const auto capture =
            std::make_shared<const gi::MaterialCapture>(gi::capture_material(material.input));
        made_[i] = {material.input, material.albedo_image, material.emission_image, capture, {}};
        if (with_digests) {
            Digester digester;
            capture->albedo.add_to(digester);
            capture->emission.add_to(digester);
            made_[i].digest = digester.digest();
        }
    });
}

} // namespace cl::scene
