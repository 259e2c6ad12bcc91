#pragma once

#include "core/assert.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace cl {

/// Handle to an object behind a server's door: slot and generation, plain data, free to copy.
/// Freeing bumps the slot's generation, so a stale RID is detected, never followed.
struct RID {
    uint32_t slot = 0;
    uint32_t generation = 0; ///< 0 = the null RID
    [[nodiscard]] bool is_valid() const noexcept { return generation != 0; }
    explicit operator bool() const noexcept { return is_valid(); }
    friend bool operator==(RID, RID) = default;
    friend auto operator<=>(RID, RID) = default;
};

/// Sole owner of the objects of one kind. Addresses are stable only until the next make().
/// Owners of different kinds start their slots at different numbers (`first_slot`), so a RID of one kind is
/// refused by the owner of another: give each kind its own value of RIDKind.
template <typename T>
class RID_Owner {
public:
    /// @param kind  0..255, unique to this owner within its server; stored in the top byte of the slot.
    explicit RID_Owner(uint32_t kind = 0) : kind_(kind << 24) {}

    RID make(T value) {
        uint32_t index;
        if (!free_.empty()) {
            index = free_.back();
            free_.pop_back();
        } else {
            index = static_cast<uint32_t>(slots_.size());
            CL_ASSERT(index < (1u << 24), "more than 2^24 objects of one kind");
            slots_.emplace_back();
        }
        slots_[index].value.emplace(std::move(value));
        return RID{kind_ | index, slots_[index].generation};
    }
    /// nullptr if `rid` is null, stale or of another kind.
    [[nodiscard]] T* get(RID rid) noexcept {
        Slot* slot = find(rid);
        return slot ? &*slot->value : nullptr;
    }
    [[nodiscard]] const T* get(RID rid) const noexcept { return const_cast<RID_Owner*>(this)->get(rid); }
    [[nodiscard]] bool owns(RID rid) const noexcept { return get(rid) != nullptr; }

    /// Destroys the object; false if there was none.
    bool free(RID rid) {
        Slot* slot = find(rid);
        if (!slot) {
            return false;
        }
        slot->value.reset();
        ++slot->generation;
        free_.push_back(rid.slot & 0xFFFFFFu);
        return true;
    }
    [[nodiscard]] size_t size() const noexcept { return slots_.size() - free_.size(); }

    /// Calls f(RID, T&) for each live object, in slot order.
    template <typename F>
    void for_each(F&& f) {
        for (uint32_t i = 0; i < slots_.size(); ++i) {
            if (slots_[i].value) {
                f(RID{kind_ | i, slots_[i].generation}, *slots_[i].value);
            }
        }
    }

private:
    struct Slot {
        std::optional<T> value;
        uint32_t generation = 1;
    };
    Slot* find(RID rid) noexcept {
        const uint32_t index = rid.slot & 0xFFFFFFu;
        if ((rid.slot & 0xFF000000u) != kind_ || index >= slots_.size()) {
            return nullptr;
        }
        Slot& slot = slots_[index];
        return slot.generation == rid.generation && slot.value ? &slot : nullptr;
    }
    uint32_t kind_;
    std::vector<Slot> slots_;
    std::vector<uint32_t> free_;
};

} // namespace cl

template <>
struct std::hash<cl::RID> {
    size_t operator()(cl::RID rid) const noexcept {
        return std::hash<uint64_t>{}((static_cast<uint64_t>(rid.generation) << 32) | rid.slot);
    }
};
