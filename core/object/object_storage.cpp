// What saving writes of an object, and in which order (spec tscn section 7).

#include "core/object/class_registry.h"
#include "core/object/object.h"
#include "core/object/resource.h"

namespace cl {

namespace {

using PropertyValue = Object::PropertyValue;

bool is_null_object(const Variant& value, Variant::Type property_type) {
    return property_type == Variant::Type::Object && (value.is_nil() || !value.to_object());
}

/// Collects the values of one object that differ from those of a fresh instance.
class StoredValues {
public:
    explicit StoredValues(const Object& object)
        : object_(object), info_(object.class_info()), is_resource_(info_.is_a(Resource::kClassName)) {}

    void add_static(const ClassInfo& owner, SaveOrder order) {
        for (const PropertyInfo& p : owner.properties) {
            // A property declared again in a derived class is saved there, once.
            if (p.save_order == order && p.stored && info_.find_property(p.name) == &p) {
                add_unless_default(p);
            }
        }
    }

    void add_dynamic(const std::vector<PropertyValue>& values) {
        for (const PropertyValue& p : values) {
            const bool is_null = p.value.is_nil() || is_null_object(p.value, p.value.type());
            if (!is_resource_ || !is_null) {
                out_.push_back(p);
            }
        }
    }

    void add_all(const std::vector<PropertyValue>& values) {
        out_.insert(out_.end(), values.begin(), values.end());
    }

    std::vector<PropertyValue> take() { return std::move(out_); }

private:
    void add_unless_default(const PropertyInfo& p) {
        if (p.stored_if && !p.stored_if(object_)) {
            return;
        }
        Variant value = p.get(object_);
        if (is_resource_ && is_null_object(value, p.type)) {
            return;
        }
        if (p.always_stored || !(value == info_.default_of(p))) {
            out_.push_back({p.name, std::move(value)});
        }
    }

    const Object& object_;
    const ClassInfo& info_;
    bool is_resource_;
    std::vector<PropertyValue> out_;
};

/// The class after whose static properties the dynamic ones come.
const ClassInfo* owner_of_dynamic(const std::vector<const ClassInfo*>& lineage) {
    for (auto c = lineage.rbegin(); c != lineage.rend(); ++c) {
        if ((*c)->lists_dynamic) {
            return *c;
        }
    }
    return lineage.back();
}

} // namespace

std::vector<PropertyValue> Object::stored_properties() const {
    std::vector<PropertyValue> dynamic;
    list_dynamic(dynamic);
    const std::vector<const ClassInfo*> lineage = class_info().lineage();
    const ClassInfo* dynamic_owner = owner_of_dynamic(lineage);

    StoredValues values(*this);
    for (const ClassInfo* c : lineage) {
        values.add_static(*c, SaveOrder::Declared);
        if (c == dynamic_owner) {
            values.add_dynamic(dynamic);
        }
    }
    for (const ClassInfo* c : lineage) {
        values.add_static(*c, SaveOrder::Last);
    }
    values.add_all(extra_);
    return values.take();
}

} // namespace cl
