#include "tests/scene/property_laws.h"

#include <doctest/doctest.h>

#include <memory>

namespace cl::tests {

std::vector<const PropertyInfo*> own_stored_properties(const ClassInfo& info) {
    std::vector<const PropertyInfo*> own;
    for (const PropertyInfo& p : info.properties) {
        if (p.stored) {
            own.push_back(&p);
        }
    }
    return own;
}

void check_choice(const Choice& choice, std::initializer_list<int64_t> wrong, int64_t right) {
    CAPTURE(choice.class_name);
    CAPTURE(choice.property);
    const std::unique_ptr<Object> object = ClassRegistry::instance().create(choice.class_name);
    REQUIRE(object != nullptr);
    const Variant before = object->get(choice.property);
    for (int64_t number : wrong) {
        CHECK(object->set(choice.property, number) == SetResult::Refused);
        CHECK(object->get(choice.property) == before);
    }
    CHECK(object->set(choice.property, right) == SetResult::Done);
    CHECK(object->get(choice.property) == Variant(right));
}

} // namespace cl::tests
