#pragma once

#include "core/expected.h"
#include "core/variant/variant_parser.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cl::scene {

/// Takes the fields of one tag by name and type; the first that is missing or of a wrong type is the error.
/// Getters after an error return empty values, so that a caller reads all it wants and asks once.
class TagFields {
public:
    explicit TagFields(const TextTag& tag) : tag_(tag) {}

    [[nodiscard]] bool has(std::string_view name) const noexcept { return tag_.find(name) != nullptr; }
    std::string required_text(std::string_view name);
    std::string text_or_empty(std::string_view name);
    int64_t required_int(std::string_view name);
    /// Also takes a String that holds an int, as `index` is written.
    int64_t int_or(std::string_view name, int64_t otherwise);
    std::vector<std::string> texts(std::string_view name);
    Array array(std::string_view name);

    [[nodiscard]] const Status& status() const noexcept { return status_; }

private:
    const TextTag::Field* required(std::string_view name);
    void fail_type(const TextTag::Field& field, std::string_view expected);

    const TextTag& tag_;
    Status status_;
};

} // namespace cl::scene
