#include "core/string_name.h"

#include <mutex>
#include <unordered_set>

namespace cl {
namespace {

struct TextHash {
    using is_transparent = void;
    size_t operator()(std::string_view text) const noexcept { return std::hash<std::string_view>{}(text); }
};

/// Every text ever interned; the set's nodes never move, so a pointer to an element is a name.
struct Table {
    std::mutex mutex;
    std::unordered_set<std::string, TextHash, std::equal_to<>> texts;
};

Table& table() {
    static Table* const instance = new Table; // never destroyed: names outlive every other static object
    return *instance;
}

const std::string* intern(std::string_view text) {
    Table& t = table();
    const std::lock_guard lock(t.mutex);
    const auto found = t.texts.find(text);
    return found != t.texts.end() ? &*found : &*t.texts.emplace(text).first;
}

} // namespace

StringName::StringName() noexcept {
    static const std::string* const empty = intern({});
    text_ = empty;
}

StringName::StringName(std::string_view text) : text_(intern(text)) {}

} // namespace cl
