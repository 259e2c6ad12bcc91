#pragma once

#include <algorithm>
#include <list>
#include <utility>

namespace cl::radiosity {

/// Things that are dear to make, each by what it was made for. They stay where they are until forgotten.
template <typename Key, typename Value>
class Kept {
public:
    /// @param make  called for a value that is not there
    template <typename Make>
    const Value& get(const Key& key, const Make& make) {
        if (const Value* known = find(key)) {
            return *known;
        }
        entries_.push_back({key, make(), true});
        return entries_.back().value;
    }
    /// Null if it is not there; else it counts as asked for.
    const Value* find(const Key& key) {
        const auto at =
            std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
        if (at == entries_.end()) {
            return nullptr;
        }
        at->asked_for = true;
        return &at->value;
    }
    /// Forgets what nobody asked for since it was called last.
    void forget_others() {
        entries_.remove_if([](Entry& e) { return !std::exchange(e.asked_for, false); });
    }
    void clear() { entries_.clear(); }

private:
    struct Entry {
        Key key;
        Value value;
        bool asked_for;
    };
    std::list<Entry> entries_;
};

} // namespace cl::radiosity
