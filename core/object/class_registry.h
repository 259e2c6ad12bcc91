#pragma once

#include "core/object/class_builder.h"
#include "core/object/class_info.h"
#include "core/object/object.h"

#include <memory>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <unordered_map>
#include <vector>

namespace cl {

/// All classes of the process, filled by explicit register_*_types() calls (no static initialisers).
class ClassRegistry {
public:
    [[nodiscard]] static ClassRegistry& instance();

    /// Registers T (base before derived; twice is a no-op). T has a `kClassName` of its own and may have a
    /// public `static void bind(ClassBuilder<T>&)`. `Base` is its registered base class. A T that is abstract
    /// or has no default constructor gives no `create`.
    template <typename T, typename Base = void>
    const ClassInfo& add();

    /// nullptr if unknown.
    [[nodiscard]] const ClassInfo* find(const StringName& name) const noexcept;
    [[nodiscard]] const ClassInfo* find(std::type_index type) const noexcept;
    /// Description of the object's dynamic type, else of its nearest registered base; nullptr if not even
    /// Object is registered.
    [[nodiscard]] const ClassInfo* class_of(const Object& object) const;
    /// nullptr if unknown or abstract.
    [[nodiscard]] std::unique_ptr<Object> create(const StringName& name) const;
    /// The same for classes derived from Reference. Null if unknown, abstract or not a Reference.
    [[nodiscard]] Ref<Reference> create_ref(const StringName& name) const;
    /// Every class, base before derived, in order of registration.
    [[nodiscard]] std::vector<const ClassInfo*> classes() const;

private:
    ClassInfo& insert(std::string_view name, std::type_index type, const ClassInfo* parent);
    std::vector<std::unique_ptr<ClassInfo>> classes_;
    std::unordered_map<StringName, ClassInfo*> by_name_;
    std::unordered_map<std::type_index, ClassInfo*> by_type_;
};

/// Registers Object, Reference, Resource. Called by the layers' register functions.
void register_core_types(ClassRegistry& registry);

template <typename T, typename Base>
const ClassInfo& ClassRegistry::add() {
    static_assert(std::is_base_of_v<Object, T>, "only Objects have classes in the registry");
    if (const ClassInfo* known = find(std::type_index(typeid(T)))) {
        return *known;
    }
    const ClassInfo* parent = nullptr;
    if constexpr (!std::is_void_v<Base>) {
        static_assert(std::is_base_of_v<Base, T> && !std::is_same_v<Base, T>, "Base is not a base of T");
        parent = find(std::type_index(typeid(Base)));
        CL_ASSERT(parent, "register the base class before the derived one");
    }
    ClassInfo& info = insert(T::kClassName, std::type_index(typeid(T)), parent);
    if constexpr (std::is_same_v<T, Object>) {
        info.is_instance = [](const Object&) { return true; };
    } else {
        info.is_instance = [](const Object& o) { return dynamic_cast<const T*>(&o) != nullptr; };
    }
    if constexpr (std::is_default_constructible_v<T>) { // false for classes with pure virtual functions
        info.create = []() -> std::unique_ptr<Object> { return std::make_unique<T>(); };
    }
    if constexpr (requires(ClassBuilder<T> & builder) { T::bind(builder); }) {
        ClassBuilder<T> builder(info);
        T::bind(builder);
    }
    return info;
}

} // namespace cl
