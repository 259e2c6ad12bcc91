#pragma once

#include "core/object/resource.h"
#include "core/ref.h"

#include <functional>
#include <utility>

namespace cl::scene {

/// A Ref<T> that tells its holder when the resource changes. Address-stable: the holder is not copied or
/// moved.
template <typename T>
class WatchedRef {
public:
    WatchedRef() = default;
    /// @param on_changed  called on each change of the resource held at that time, not when set() replaces
    /// it.
    explicit WatchedRef(std::function<void()> on_changed) : on_changed_(std::move(on_changed)) {}
    ~WatchedRef() { set(nullptr); }
    WatchedRef(const WatchedRef&) = delete;
    WatchedRef& operator=(const WatchedRef&) = delete;

    void watch(std::function<void()> on_changed) { on_changed_ = std::move(on_changed); }
    [[nodiscard]] const Ref<T>& get() const noexcept { return ref_; }
    [[nodiscard]] T* operator->() const noexcept { return ref_.get(); }
    explicit operator bool() const noexcept { return static_cast<bool>(ref_); }
    void set(Ref<T> ref) {
        if (ref_) {
            ref_->remove_on_changed(subscription_);
        }
        ref_ = std::move(ref);
        if (ref_) {
            subscription_ = ref_->on_changed([this] {
                if (on_changed_) {
                    on_changed_();
                }
            });
        }
    }

private:
    Ref<T> ref_;
    uint64_t subscription_ = 0;
    std::function<void()> on_changed_;
};

} // namespace cl::scene
