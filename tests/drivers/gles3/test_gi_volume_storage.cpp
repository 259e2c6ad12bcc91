#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"

#include "drivers/gles3/gi_volume_storage.h"

#include <doctest/doctest.h>

#include <vector>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;

namespace {

constexpr gl::SamplerDecl kVolume[] = {{"volume", "sampler3D", 0, 1}};

GIVolumeStorage make_storage() {
    Expected<GIVolumeStorage> storage = GIVolumeStorage::create();
    REQUIRE(storage);
    return *std::move(storage);
}

/// The volume at the middle, at LOD 0, 0.5, 1 ...
std::vector<glm::vec4> along_lods(const gl::Texture3D& volume, int count) {
    volume.bind(0);
    return tests::probe_fragments("uniform sampler3D volume;\nvec4 probe(int i) { return textureLod(volume, "
                                  "vec3(0.5), float(i) * 0.5); }",
                                  count, kVolume);
}

} // namespace

TEST_SUITE("drivers/gles3/gi_volume_storage") {
    TEST_CASE("[gl] a new volume is 0 in every texel of every level") {
        on_each_gl([](GLTest&) {
            GIVolumeStorage storage = make_storage();
            // Textures of other content come and go first, so that zeros are not there by chance.
            for (int i = 0; i < 3; ++i) {
                const Expected<RID> dirt = storage.create({{16, 8, 16}, 4});
                REQUIRE(dirt);
                REQUIRE(storage.upload(*dirt, 0, {0, 0, 0}, {16, 8, 16},
                                       std::vector<uint8_t>(16 * 8 * 16 * 4, 255)));
                CHECK(storage.free(*dirt));
            }
            const Expected<RID> rid = storage.create({{16, 8, 16}, 4});
            REQUIRE(rid);
            const gl::Texture3D& volume = *storage.get(*rid);
            volume.bind(0);
            for (int mip = 0; mip < 4; ++mip) {
                const glm::ivec3 size = volume.size(mip);
                const std::string s = std::to_string(size.x), t = std::to_string(size.y),
                                  m = std::to_string(mip);
                const auto texels = tests::probe_fragments(
                    "uniform sampler3D volume;\nvec4 probe(int i) { return texelFetch(volume, ivec3(i % " +
                        s + ", (i / " + s + ") % " + t + ", i / (" + s + " * " + t + ")), " + m + "); }",
                    size.x * size.y * size.z, kVolume);
                for (const glm::vec4& texel : texels) {
                    REQUIRE(texel == glm::vec4(0.0f));
                }
            }
        });
    }

    TEST_CASE("[gl] LODs go linearly between the levels and stop at the last one there is") {
        on_each_gl([](GLTest&) {
            GIVolumeStorage storage = make_storage();
            const Expected<RID> rid = storage.create({{8, 8, 8}, 3}); // 8, 4, 2: the level of 1 is missing
            REQUIRE(rid);
            for (int mip = 0; mip < 3; ++mip) {
                const int edge = 8 >> mip;
                const std::vector<uint8_t> level(static_cast<size_t>(edge * edge * edge * 4),
                                                 static_cast<uint8_t>(100 * mip));
                REQUIRE(storage.upload(*rid, mip, glm::ivec3(0), glm::ivec3(edge), level));
            }
            const auto got = along_lods(*storage.get(*rid), 9);
            for (size_t i = 0; i < got.size(); ++i) {
                const float lod = std::min(2.0f, 0.5f * static_cast<float>(i));
                CHECK(got[i].a == doctest::Approx(100.0f * lod / 255.0f).epsilon(0.01));
            }
        });
    }

    TEST_CASE("[gl] beyond the volume its edge texels go on") {
        on_each_gl([](GLTest&) {
            GIVolumeStorage storage = make_storage();
            const Expected<RID> rid = storage.create({{2, 1, 1}, 1});
            REQUIRE(rid);
            REQUIRE(storage.upload(*rid, 0, {1, 0, 0}, {1, 1, 1}, std::vector<uint8_t>(4, 255)));
            storage.get(*rid)->bind(0);
            const auto got = tests::probe_fragments("uniform sampler3D volume;\n"
                                                    "vec4 probe(int i) { return textureLod(volume, "
                                                    "vec3(float(i) * 8.0 - 4.0, -3.0, 9.0), 0.0); }",
                                                    2, kVolume);
            CHECK(got[0].r == 0.0f);
            CHECK(got[1].r == 1.0f);
        });
    }

    TEST_CASE("[gl] wrong sizes, levels and handles are refused with what was expected") {
        on_each_gl([](GLTest&) {
            GIVolumeStorage storage = make_storage();
            CHECK(storage.create({{3, 4, 4}, 1}).error().message ==
                  "GI volume: expected powers of two as size, found 3x4x4");
            CHECK(storage.create({{4, 4, 0}, 1}).error().code == ErrorCode::InvalidArgument);
            CHECK(storage.create({{4, 2, 1}, 4}).error().message ==
                  "GI volume: expected 1 to 3 mips, found 4");
            CHECK(storage.create({{1 << 20, 1, 1}, 1}).error().code == ErrorCode::Unsupported);
            const Expected<RID> rid = storage.create({{4, 4, 4}, 3});
            REQUIRE(rid);
            const std::vector<uint8_t> one(4);
            CHECK(storage.upload(*rid, 3, {0, 0, 0}, {1, 1, 1}, one).error().code ==
                  ErrorCode::InvalidArgument);
            CHECK(storage.upload(*rid, 1, {2, 0, 0}, {1, 1, 1}, one).error().code ==
                  ErrorCode::InvalidArgument);
            CHECK(storage.upload(*rid, 0, {0, 0, 0}, {2, 1, 1}, one).error().code ==
                  ErrorCode::InvalidArgument);
            CHECK(storage.free(*rid));
            CHECK(storage.upload(*rid, 0, {0, 0, 0}, {1, 1, 1}, one).error().message ==
                  "GI volume: expected a live volume, found a stale or foreign RID");
        });
    }
}
