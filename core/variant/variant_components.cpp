#include "core/variant/variant_components.h"

#include "core/assert.h"

#include <algorithm>

namespace cl {
namespace {

Components make(std::initializer_list<float> numbers) {
    Components c;
    std::copy(numbers.begin(), numbers.end(), c.values.begin());
    c.count = static_cast<int>(numbers.size());
    return c;
}

// One overload for each mathematical type; the text's order is spelled out here and nowhere else.
Components components(glm::vec2 v) {
    return make({v.x, v.y});
}
Components components(const Rect2& r) {
    return make({r.position.x, r.position.y, r.size.x, r.size.y});
}
Components components(const glm::vec3& v) {
    return make({v.x, v.y, v.z});
}
Components components(const Transform2D& t) {
    return make({t.x.x, t.x.y, t.y.x, t.y.y, t.origin.x, t.origin.y});
}
Components components(const Plane& p) {
    return make({p.normal.x, p.normal.y, p.normal.z, p.d});
}
Components components(const glm::quat& q) {
    return make({q.x, q.y, q.z, q.w});
}
Components components(const AABB& b) {
    return make({b.position.x, b.position.y, b.position.z, b.size.x, b.size.y, b.size.z});
}
Components components(const glm::mat3& m) {
    return make({m[0].x, m[1].x, m[2].x, m[0].y, m[1].y, m[2].y, m[0].z, m[1].z, m[2].z});
}
Components components(const Transform& t) {
    Components c = components(t.basis);
    c.values[9] = t.origin.x;
    c.values[10] = t.origin.y;
    c.values[11] = t.origin.z;
    c.count = 12;
    return c;
}
Components components(const Color& c) {
    return make({c.r, c.g, c.b, c.a});
}

template <typename T>
Components components_if(const Variant& value) {
    const T* v = value.get_if<T>();
    return v ? components(*v) : Components{};
}

glm::mat3 basis_from_rows(std::span<const float> n) {
    return {glm::vec3(n[0], n[3], n[6]), glm::vec3(n[1], n[4], n[7]), glm::vec3(n[2], n[5], n[8])};
}

} // namespace

int component_count(Variant::Type type) noexcept {
    switch (type) {
    case Variant::Type::Vector2:
        return 2;
    case Variant::Type::Vector3:
        return 3;
    case Variant::Type::Rect2:
    case Variant::Type::Plane:
    case Variant::Type::Quat:
    case Variant::Type::Color:
        return 4;
    case Variant::Type::Transform2D:
    case Variant::Type::AABB:
        return 6;
    case Variant::Type::Basis:
        return 9;
    case Variant::Type::Transform:
        return 12;
    default:
        return 0;
    }
}

Components components_of(const Variant& value) noexcept {
    switch (value.type()) {
    case Variant::Type::Vector2:
        return components_if<glm::vec2>(value);
    case Variant::Type::Rect2:
        return components_if<Rect2>(value);
    case Variant::Type::Vector3:
        return components_if<glm::vec3>(value);
    case Variant::Type::Transform2D:
        return components_if<Transform2D>(value);
    case Variant::Type::Plane:
        return components_if<Plane>(value);
    case Variant::Type::Quat:
        return components_if<glm::quat>(value);
    case Variant::Type::AABB:
        return components_if<AABB>(value);
    case Variant::Type::Basis:
        return components_if<glm::mat3>(value);
    case Variant::Type::Transform:
        return components_if<Transform>(value);
    case Variant::Type::Color:
        return components_if<Color>(value);
    default:
        return {};
    }
}

Variant from_components(Variant::Type type, std::span<const float> n) {
    CL_ASSERT(n.size() >= static_cast<size_t>(component_count(type)), "too few components");
    switch (type) {
    case Variant::Type::Vector2:
        return glm::vec2(n[0], n[1]);
    case Variant::Type::Rect2:
        return Rect2{{n[0], n[1]}, {n[2], n[3]}};
    case Variant::Type::Vector3:
        return glm::vec3(n[0], n[1], n[2]);
    case Variant::Type::Transform2D:
        return Transform2D{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}};
    case Variant::Type::Plane:
        return Plane{{n[0], n[1], n[2]}, n[3]};
    case Variant::Type::Quat:
        return glm::quat(n[3], n[0], n[1], n[2]); // glm takes w first
    case Variant::Type::AABB:
        return AABB{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    case Variant::Type::Basis:
        return basis_from_rows(n);
    case Variant::Type::Transform:
        return Transform{basis_from_rows(n), {n[9], n[10], n[11]}};
    case Variant::Type::Color:
        return Color{n[0], n[1], n[2], n[3]};
    default:
        return {};
    }
}

} // namespace cl
