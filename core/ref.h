#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>

namespace cl {

/// Mix-in for objects that are shared through Ref<T>. The count lives in the object.
class RefCounted {
public:
    RefCounted() = default;
    RefCounted(const RefCounted&) noexcept {}
    RefCounted& operator=(const RefCounted&) noexcept { return *this; }
    void retain() const noexcept { count_.fetch_add(1, std::memory_order_relaxed); }
    /// True if this was the last owner: the caller deletes.
    [[nodiscard]] bool release() const noexcept {
        return count_.fetch_sub(1, std::memory_order_acq_rel) == 1;
    }
    [[nodiscard]] int use_count() const noexcept { return count_.load(std::memory_order_relaxed); }

protected:
    ~RefCounted() = default;

private:
    mutable std::atomic<int> count_{0};
};

/// Shared ownership of a resource. T derives from RefCounted and has a virtual destructor.
template <typename T>
class Ref {
public:
    Ref() = default;
    Ref(std::nullptr_t) {}
    explicit Ref(T* object) : object_(object) { retain(); }
    Ref(const Ref& other) : object_(other.object_) { retain(); }
    Ref(Ref&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    template <typename U>
    requires std::is_convertible_v<U*, T*> Ref(const Ref<U>& other) : object_(other.get()) { retain(); }
    ~Ref() { drop(); }
    Ref& operator=(const Ref& other) {
        if (this != &other) {
            Ref copy(other);
            std::swap(object_, copy.object_);
        }
        return *this;
    }
    Ref& operator=(Ref&& other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }

    [[nodiscard]] T* get() const noexcept { return object_; }
    T* operator->() const noexcept { return object_; }
    T& operator*() const noexcept { return *object_; }
    explicit operator bool() const noexcept { return object_ != nullptr; }
    friend bool operator==(const Ref& a, const Ref& b) noexcept { return a.object_ == b.object_; }
    friend bool operator==(const Ref& a, std::nullptr_t) noexcept { return a.object_ == nullptr; }

    /// Null if the object is not a U.
    template <typename U>
    [[nodiscard]] Ref<U> cast() const {
        return Ref<U>(dynamic_cast<U*>(object_));
    }

private:
    void retain() const noexcept {
        if (object_) {
            object_->retain();
        }
    }
    void drop() noexcept {
        if (object_ && object_->release()) {
            delete object_;
        }
        object_ = nullptr;
    }
    T* object_ = nullptr;
};

template <typename T, typename... Args>
[[nodiscard]] Ref<T> make_ref(Args&&... args) {
    return Ref<T>(new T(std::forward<Args>(args)...));
}

} // namespace cl

template <typename T>
struct std::hash<cl::Ref<T>> {
    size_t operator()(const cl::Ref<T>& ref) const noexcept { return std::hash<T*>{}(ref.get()); }
};
