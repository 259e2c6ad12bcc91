#pragma once

#include "core/object/class_registry.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace cl::scene {

/// Binds fields of the plain struct that a class T keeps its parameters in, so that a class with a hundred
/// properties needs no hundred setters. `get` and `set` are T's accessors of the whole struct.
template <typename T, typename Struct>
class StructProperties {
public:
    using Get = const Struct& (T::*)() const;
    using Set = void (T::*)(const Struct&);
    StructProperties(ClassBuilder<T>& builder, Get get, Set set) : builder_(builder), get_(get), set_(set) {}

    template <typename V>
    PropertyBuilder<T> field(std::string_view name, V Struct::*member) {
        return builder_.property(name, getter(member), [get = get_, set = set_, member](T& object, V value) {
            Struct changed = (object.*get)();
            changed.*member = std::move(value);
            (object.*set)(changed);
        });
    }

    /// An enum or an int that counts from 0; numbers beyond the names are refused.
    /// @param names  as for PropertyHint::Enum: "Off,On"
    template <typename V>
    PropertyBuilder<T> choice(std::string_view name, V Struct::*member, std::string names) {
        const int64_t count = std::count(names.begin(), names.end(), ',') + 1;
        const auto assign = [get = get_, set = set_, member, count](T& object, V value) {
            const auto number = static_cast<int64_t>(value);
            if (number < 0 || number >= count) {
                return SetResult::Refused;
            }
            Struct changed = (object.*get)();
            changed.*member = value;
            (object.*set)(changed);
            return SetResult::Done;
        };
        return builder_.property(name, getter(member), assign).enumeration(std::move(names));
    }

private:
    template <typename V>
    auto getter(V Struct::*member) const {
        return [get = get_, member](const T& object) -> V { return (object.*get)().*member; };
    }

    ClassBuilder<T>& builder_;
    Get get_;
    Set set_;
};

} // namespace cl::scene
