// Values out of real Godot 3.2.3: what it reads from a text, and how it prints that again.

#include "tests/core/godot_binary.h"
#include "tests/shared_dir.h"

#include "core/variant/variant_parser.h"
#include "core/variant/variant_writer.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace cl::tests {
namespace {

/// Texts for which we differ from Godot's str2var on purpose, with the reason.
const std::map<std::string, std::string> kExceptions = {
    {"#80ff8040",
     "Godot takes a colour for damaged if the text ends right behind it, and so gives the text back; in a "
     "file, where a line end follows, it reads the colour that we read"},
};

struct Sample {
    std::string raw, var2str, str;
    int type = 0;
    std::vector<uint8_t> binary;
};

std::vector<Sample> read_samples(const std::filesystem::path& file) {
    std::vector<Sample> samples;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        const nlohmann::json j = nlohmann::json::parse(line);
        samples.push_back(
            {j["raw"], j["var2str"], j["str"], j["type"], decode_base64(j["b64"].get<std::string>())});
    }
    return samples;
}

/// What Godot's str2var does: the first value in the text, or the text itself if there is none.
Variant str2var(const std::string& text) {
    VariantReader reader(text, "");
    Expected<Variant> value = reader.read_value();
    return value ? *value : Variant(text);
}

/// Equal bytes, whatever stands in padding; `expected` may end in rubbish behind a terminated string list.
bool same_binary(const std::vector<BinaryByte>& got, const std::vector<uint8_t>& expected) {
    if (got.size() != expected.size()) {
        return false;
    }
    for (size_t i = 0; i < got.size(); i++) {
        if (got[i] && *got[i] != expected[i]) {
            return false;
        }
    }
    return true;
}

} // namespace

TEST_SUITE("core/variants_corpus") {
    TEST_CASE("every value of the corpus reads to Godot's value and prints as Godot prints it") {
        const auto shared = shared_dir();
        if (!shared) {
            MESSAGE("skipped: no folder with the reference material");
            return;
        }
        const std::vector<Sample> samples = read_samples(*shared / "assets/variants/variants.jsonl");
        CHECK(samples.size() == 880);
        VariantWriteOptions as_godot;
        as_godot.style = TextStyle::Godot;
        size_t exceptions = 0;
        for (const Sample& sample : samples) {
            CAPTURE(sample.raw);
            const Variant value = str2var(sample.raw);
            const bool agrees = static_cast<int>(value.type()) == sample.type &&
                                same_binary(encode_godot_binary(value), sample.binary) &&
                                variant_to_text(value, as_godot) == sample.var2str &&
                                variant_to_str(value) == sample.str;
            if (kExceptions.count(sample.raw) > 0) {
                exceptions++;
                CHECK_FALSE(agrees); // an exception that is none any more has to go
                continue;
            }
            CHECK(static_cast<int>(value.type()) == sample.type);
            CHECK(same_binary(encode_godot_binary(value), sample.binary));
            CHECK(variant_to_text(value, as_godot) == sample.var2str);
            CHECK(variant_to_str(value) == sample.str);
        }
        CHECK(exceptions == kExceptions.size());
    }

    TEST_CASE(
        "what exact style writes reads back to the same bits, and is Godot's text for all of the corpus") {
        const auto shared = shared_dir();
        if (!shared) {
            MESSAGE("skipped: no folder with the reference material");
            return;
        }
        for (const Sample& sample : read_samples(*shared / "assets/variants/variants.jsonl")) {
            CAPTURE(sample.raw);
            const Variant value = str2var(sample.raw);
            const std::string text = variant_to_text(value);
            const Expected<Variant> back = parse_variant(text);
            REQUIRE(back.has_value());
            CHECK(encode_godot_binary(*back) == encode_godot_binary(value));
            if (kExceptions.count(sample.raw) == 0) {
                CHECK(text == sample.var2str);
            }
        }
    }
}

} // namespace cl::tests
