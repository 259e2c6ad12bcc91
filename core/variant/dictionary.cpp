#include "core/variant/variant.h"
#include "core/variant/variant_compare.h"

#include <algorithm>

namespace cl {
namespace {

constexpr size_t kNotFound = SIZE_MAX;
constexpr size_t kUnindexedEntries = 8; // up to here comparing keys one by one is faster than hashing

/// First slot on the probe path of `hash` that is free or whose entry `matches`.
template <typename Matches>
size_t probe(const std::vector<uint32_t>& index, size_t hash, Matches matches) {
    const size_t mask = index.size() - 1;
    size_t slot = hash & mask;
    while (index[slot] != 0 && !matches(index[slot] - 1)) {
        slot = (slot + 1) & mask;
    }
    return slot;
}

} // namespace

const std::vector<Dictionary::Entry>& Dictionary::entries() const noexcept {
    return entries_;
}
size_t Dictionary::size() const noexcept {
    return entries_.size();
}

size_t Dictionary::find_position(const Variant& key) const noexcept {
    if (index_.empty()) {
        const auto found = std::find_if(entries_.begin(), entries_.end(),
                                        [&](const Entry& entry) { return same_key(entry.first, key); });
        return found == entries_.end() ? kNotFound : static_cast<size_t>(found - entries_.begin());
    }
    const size_t slot =
        probe(index_, hash_key(key), [&](size_t i) { return same_key(entries_[i].first, key); });
    return index_[slot] == 0 ? kNotFound : index_[slot] - 1;
}

void Dictionary::add_to_index(size_t position) {
    const auto never = [](size_t) { return false; }; // the key is new: any free slot on its path will do
    index_[probe(index_, hash_key(entries_[position].first), never)] = static_cast<uint32_t>(position + 1);
}

void Dictionary::rebuild_index() {
    size_t slots = 32;
    while (slots < entries_.size() * 4) { // grows by rebuilding at half full
        slots *= 2;
    }
    index_.assign(slots, 0);
    for (size_t i = 0; i < entries_.size(); i++) {
        add_to_index(i);
    }
}

void Dictionary::set(Variant key, Variant value) {
    const size_t position = find_position(key);
    if (position != kNotFound) {
        entries_[position].second = std::move(value);
        return;
    }
    entries_.emplace_back(std::move(key), std::move(value));
    if (entries_.size() <= kUnindexedEntries) {
        return;
    }
    if (index_.size() < entries_.size() * 2) {
        rebuild_index();
    } else {
        add_to_index(entries_.size() - 1);
    }
}

const Variant* Dictionary::find(const Variant& key) const noexcept {
    const size_t position = find_position(key);
    return position == kNotFound ? nullptr : &entries_[position].second;
}

const Variant* Dictionary::find(std::string_view key) const noexcept {
    const auto matches = [&](const Entry& entry) {
        const std::string* text = entry.first.get_if<std::string>();
        return text && *text == key;
    };
    if (index_.empty()) {
        const auto found = std::find_if(entries_.begin(), entries_.end(), matches);
        return found == entries_.end() ? nullptr : &found->second;
    }
    const size_t slot = probe(index_, hash_key(key), [&](size_t i) { return matches(entries_[i]); });
    return index_[slot] == 0 ? nullptr : &entries_[index_[slot] - 1].second;
}

} // namespace cl
