#include "tests/servers/gi/hand_made_octree.h"
#include "tests/servers/gi/relight_scene.h"
#include "tests/servers/gi/whole_mips.h"

#include "servers/gi/s3tc.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace cl;

std::string hex(const gi::Dxt5Block& block) {
    std::string text;
    for (const uint8_t byte : block) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

std::vector<gi::BlockTexel> full_block(const glm::vec3& color, uint8_t alpha) {
    std::vector<gi::BlockTexel> texels;
    for (int place = 0; place < 16; ++place) {
        texels.push_back({place, color, alpha});
    }
    return texels;
}

TEST_SUITE("servers/gi/s3tc") {
    TEST_CASE("blocks recorded from Godot 3.2.3 come out bit for bit") {
        // Two lower rows of dark leaves: alpha 1 above, 0 (= 255) below; colour index 1 where no leaf is.
        std::vector<gi::BlockTexel> rows;
        for (int place = 8; place < 16; ++place) {
            rows.push_back({place, glm::vec3(0.0f), 255});
        }
        CHECK(hex(gi::encode_block(rows)) == "ff004992240000000000000055550000");
        // A full block of one colour: both ends are that colour.
        const glm::vec3 lit(24.5f / 31, 30.5f / 63, 6.5f / 31);
        CHECK(hex(gi::encode_block(full_block(lit, 255))) == "ffff000000000000c6c3c6c300000000");
    }

    TEST_CASE("a partial block spans black to its brightest along the mean colour") {
        // Brightest (0.8, 0.4, 0): int(0.8 * 31) = 24, int(0.4 * 63) = 25: 0xC320. Its distance from the
        // block's first end, itself, is 0: index 0. A texel of half of it: 3 * 0.5 + 0.5 = 2: index 1 by
        // Godot's order, which decodes to black, where 2/3 or 1/3 would be right.
        const gi::Dxt5Block block = gi::encode_block(
            std::vector<gi::BlockTexel>{{0, {0.8f, 0.4f, 0.0f}, 255}, {5, {0.4f, 0.2f, 0.0f}, 255}});
        CHECK(hex(block).substr(16) == "20c3000054555555");
        const auto texels = gi::decode_block(block);
        CHECK(int(texels[0]) == (24 << 3 | 24 >> 2));
        CHECK(int(texels[1]) == (25 << 2 | 25 >> 4));
        CHECK(int(texels[2]) == 0);
        CHECK(int(texels[5 * 4]) == 0);
        CHECK(int(texels[3]) == 255);
        CHECK(int(texels[1 * 4 + 3]) == 0);
    }

    TEST_CASE("a full block divides by the squared distance and so shows its darker colour too bright") {
        std::vector<gi::BlockTexel> texels = full_block(glm::vec3(0.5f), 255);
        texels[0].color = glm::vec3(1.0f);
        const auto decoded = gi::decode_block(gi::encode_block(texels));
        CHECK(int(decoded[0]) == 255);
        // Distance^2 = 0.75: 3 * 0.866 / 0.75 is beyond 3: index 2, (2 * 255 + 123) / 3; 123 = 15 of 31.
        CHECK(int(decoded[4]) == 211);
        CHECK(int(decoded[5]) == 211); // (2 * 255 + 125) / 3; 125 = 31 of 63
    }

    TEST_CASE("colours beyond 1 are clamped") {
        const auto decoded = gi::decode_block(gi::encode_block(full_block({7.0f, 1.5f, 0.0f}, 255)));
        CHECK(int(decoded[0]) == 255);
        CHECK(int(decoded[1]) == 255);
        CHECK(int(decoded[2]) == 0);
    }

    TEST_CASE("alpha is at most half a seventh of the block's range off") {
        for (const bool is_full : {true, false}) {
            std::vector<gi::BlockTexel> texels;
            for (int place = 0; place < (is_full ? 16 : 15); ++place) {
                texels.push_back({place, glm::vec3(0.0f), uint8_t(40 + 13 * place)});
            }
            const auto decoded = gi::decode_block(gi::encode_block(texels));
            const int range = is_full ? 13 * 15 : 40 + 13 * 14;
            for (const gi::BlockTexel& t : texels) {
                CHECK(std::abs(int(decoded[size_t(t.place) * 4 + 3]) - int(t.alpha)) <= range / 14 + 1);
            }
        }
        CHECK(int(gi::decode_block(gi::encode_block(full_block(glm::vec3(0.0f), 77)))[3]) == 77);
    }

    TEST_CASE("levels halve until one side is 4; thinner volumes have none") {
        CHECK(gi::block_mip_count({64, 64, 64}) == 5);
        CHECK(gi::block_mip_count({128, 32, 64}) == 4);
        CHECK(gi::block_mip_count({64, 4, 64}) == 1);
        CHECK(gi::block_mip_count({64, 2, 64}) == 0);
    }

    TEST_CASE("block levels hold the cells' places") {
        const gi::CellLayout layout = gi::make_layout(tests::busy_octree());
        gi::CellEnergies energies;
        gi::energies_from_leaves(layout, gi::emission_energies(layout), 0.3f, energies);
        const std::vector<tests::MipLevel> blocks =
            tests::whole_mips(layout, energies, 4, gi::TexelCoding::Dxt5);
        const std::vector<tests::MipLevel> plain = tests::whole_mips(layout, energies, 4);
        REQUIRE(blocks.size() == 5);
        size_t occupied = 0;
        for (size_t i = 3; i < blocks[0].rgba8.size(); i += 4) {
            REQUIRE(blocks[0].rgba8[i] == plain[0].rgba8[i]); // leaves are 255, all else 0
            occupied += blocks[0].rgba8[i] != 0;
        }
        CHECK(occupied == layout.leaves.size());
    }
}

} // namespace
