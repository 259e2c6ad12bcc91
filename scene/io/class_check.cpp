#include "scene/io/class_check.h"

#include "scene/io/assign.h"
#include "scene/io/link_resolver.h"
#include "scene/main/missing_node.h"

#include "core/object/class_registry.h"
#include "core/object/resource.h"

namespace cl::scene {

namespace {

void check_properties(Object& object, const Assignments& assignments, Diagnostics& diagnostics) {
    const auto no_resources = [](const ResourceLink&) -> Expected<Variant> { return Variant(); };
    for (const TextAssignment& a : assignments) {
        const Expected<Variant> value = resolve_links(a.value, no_resources);
        // What other answers mean cannot be told without the resources: only unknown names count.
        if (value && object.set(StringName(a.key), *value) == SetResult::UnknownProperty) {
            warn_unknown_property(object, a, diagnostics);
        }
    }
}

void check_resource(const std::string& type, const Assignments& assignments, const SourceLocation& where,
                    Diagnostics& diagnostics) {
    const Ref<Reference> object = ClassRegistry::instance().create_ref(StringName(type));
    if (!object) {
        warn_unknown_resource_class(type, where, diagnostics);
        return;
    }
    check_properties(*object, assignments, diagnostics);
}

void check_node(const NodeEntry& entry, Diagnostics& diagnostics) {
    if (entry.type.empty() || !entry.instance.is_nil()) {
        return;
    }
    const CreatedNode created = create_node(ClassRegistry::instance(), StringName(entry.type));
    if (created.support != NodeSupport::Full) {
        warn_unknown_node_class(entry.type, entry.where, diagnostics);
        return;
    }
    const TextAssignment* script = find_assignment(entry.properties, "script");
    if (!script || script->value.is_nil()) {
        check_properties(*created.node, entry.properties, diagnostics);
    }
}

} // namespace

void check_classes(const SceneFile& file, Diagnostics& diagnostics) {
    for (const SubEntry& s : file.sub_resources) {
        check_resource(s.type, s.properties, s.where, diagnostics);
    }
    if (file.kind == SceneFile::Kind::Resource) {
        check_resource(file.resource_type, file.resource, file.where, diagnostics);
    }
    for (const NodeEntry& entry : file.nodes) {
        check_node(entry, diagnostics);
    }
}

} // namespace cl::scene
