#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cl {

/// An interned string: comparing and hashing two of them compares one pointer. Never freed; for identifiers
/// (classes, properties, signals, groups, node names), not for text.
class StringName {
public:
    StringName() noexcept;
    StringName(std::string_view text);
    StringName(const char* text) : StringName(std::string_view(text)) {}
    StringName(const std::string& text) : StringName(std::string_view(text)) {}

    [[nodiscard]] const std::string& str() const noexcept { return *text_; }
    [[nodiscard]] std::string_view view() const noexcept { return *text_; }
    [[nodiscard]] bool empty() const noexcept { return text_->empty(); }
    friend bool operator==(const StringName& a, const StringName& b) noexcept { return a.text_ == b.text_; }
    /// Alphabetical, so that ordered containers print the same on every run.
    friend bool operator<(const StringName& a, const StringName& b) noexcept { return *a.text_ < *b.text_; }

private:
    friend struct std::hash<StringName>;
    const std::string* text_;
};

} // namespace cl

template <>
struct std::hash<cl::StringName> {
    size_t operator()(const cl::StringName& name) const noexcept {
        return std::hash<const std::string*>{}(name.text_);
    }
};
