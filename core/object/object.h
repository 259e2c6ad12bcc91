#pragma once

#include "core/expected.h"
#include "core/ref.h"
#include "core/string_name.h"
#include "core/variant/variant.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cl {

class ClassInfo; // core/object/class_info.h
class Object;

/// What became of an assignment.
enum class SetResult {
    Done,
    UnknownProperty, ///< no such property: kept as an extra property, so that saving writes it back
    WrongType,       ///< the value does not convert to the property's type: the property keeps its value
    Refused,         ///< right type, out of range: the setter kept the old value
};

enum class ConnectFlags : uint32_t { None = 0, Deferred = 1, Persist = 2, OneShot = 4, ReferenceCounted = 8 };

/// Base of everything with a class name, properties and signals (nodes, resources, scripts).
/// Not thread safe; used from the main thread.
class Object {
public:
    static constexpr std::string_view kClassName = "Object";

    Object();
    virtual ~Object();
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    /// Registered description of the dynamic type, found by typeid. The nearest registered base if the type
    /// itself was not registered.
    [[nodiscard]] const ClassInfo& class_info() const;
    /// Name in scene files: the registered class name, unless the object stands in for a class that we do
    /// not have (then that class's name).
    [[nodiscard]] StringName class_name() const;
    void set_declared_class(StringName name) { declared_class_ = name; }

    /// Assigns a property by name with the conversions of a scene file.
    SetResult set(const StringName& property, const Variant& value);
    /// Nil if there is no such property.
    [[nodiscard]] Variant get(const StringName& property) const;
    [[nodiscard]] bool has_property(const StringName& property) const;

    struct PropertyValue {
        StringName name;
        Variant value;
    };
    /// Every property that saving would write, base class first, dynamic ones after the static ones of their
    /// class, those equal to the class default left out, unknown ones from the file last.
    [[nodiscard]] std::vector<PropertyValue> stored_properties() const;
    /// Unknown properties met in files, in order of first assignment.
    [[nodiscard]] const std::vector<PropertyValue>& extra_properties() const noexcept { return extra_; }
    /// Keeps a value that no property takes, so that saving writes it back. set() does so for unknown ones.
    void keep_extra(const StringName& property, const Variant& value);

    /// Calls a registered method. NotFound / InvalidArgument on a wrong name or wrong arguments.
    Expected<Variant> call(const StringName& method, std::span<const Variant> arguments);

    using Slot = std::function<void(std::span<const Variant>)>;
    /// Connects a callable; returns an id for disconnect(). InvalidArgument if the class has no such signal.
    /// OneShot is honoured here. Deferred, Persist and ReferenceCounted are kept for their owner: an Object
    /// has no queue, so the scene layer connects a slot that queues its call.
    Expected<uint64_t> connect(const StringName& signal, Slot slot, ConnectFlags flags = ConnectFlags::None);
    void disconnect(const StringName& signal, uint64_t id);
    /// Calls the slots in order of connection. Slots may connect, disconnect, emit and delete this object
    /// while it runs: one that is disconnected in time is not called, one that is connected is called from
    /// the next time.
    void emit_signal(const StringName& signal, std::span<const Variant> arguments = {});

    /// Weak identity: expires with the object.
    [[nodiscard]] std::weak_ptr<Object*> handle() const;

protected:
    /// Properties whose names depend on the object's state, such as `material/0`. The defaults know none.
    virtual SetResult set_dynamic(const StringName& property, const Variant& value);
    virtual bool get_dynamic(const StringName& property, Variant& value) const;
    /// Appends the dynamic properties that exist now, in save order, as saving writes them.
    virtual void list_dynamic(std::vector<PropertyValue>& out) const;

private:
    struct Connection {
        uint64_t id;
        StringName signal;
        Slot slot;
        ConnectFlags flags;
    };
    const PropertyValue* find_extra(const StringName& property) const noexcept;

    StringName declared_class_;
    std::vector<PropertyValue> extra_;
    std::vector<Connection> connections_;
    uint64_t next_connection_ = 1;
    mutable std::shared_ptr<Object*> handle_;
};

/// A ref-counted Object.
class Reference : public Object, public RefCounted {
public:
    static constexpr std::string_view kClassName = "Reference";
};

} // namespace cl
