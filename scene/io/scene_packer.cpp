#include "scene/io/scene_packer.h"

#include "scene/io/resource_link.h"
#include "scene/io/resource_packer.h"
#include "scene/main/node.h"

#include <algorithm>
#include <memory>

namespace cl::scene {

namespace {

using PropertyValue = Object::PropertyValue;

const PropertyValue* find(const std::vector<PropertyValue>& values, const StringName& name) {
    const auto found =
        std::find_if(values.begin(), values.end(), [&](const PropertyValue& p) { return p.name == name; });
    return found != values.end() ? &*found : nullptr;
}

/// What differs from a node of a base scene, values set back to their class's default included.
std::vector<PropertyValue> changed_properties(const Node& node, const Node& base) {
    std::vector<PropertyValue> changed;
    const std::vector<PropertyValue> now = node.stored_properties();
    for (const PropertyValue& p : now) {
        if (!(base.get(p.name) == p.value)) {
            changed.push_back(p);
        }
    }
    for (const PropertyValue& p : base.stored_properties()) {
        Variant value = node.get(p.name);
        if (!find(now, p.name) && !(value == p.value)) {
            changed.push_back({p.name, std::move(value)});
        }
    }
    return changed;
}

std::vector<std::string> saved_groups(const Node& node, const Node* base) {
    std::vector<std::string> groups;
    for (const Node::Group& g : node.groups()) {
        if (g.saving == GroupSaving::Saved && !(base && base->is_in_group(g.name))) {
            groups.push_back(g.name.str());
        }
    }
    std::sort(groups.begin(), groups.end());
    return groups;
}

class ScenePacker {
public:
    ScenePacker(const Node& root, ResourceLoader& loader, Diagnostics& diagnostics,
                const PackOptions& options)
        : root_(root), loader_(loader), diagnostics_(diagnostics), original_(options.original),
          packer_(file_, options.path, options.original) {}

    Expected<SceneFile> run() {
        if (Status packed = pack_root(); !packed) {
            return packed.error();
        }
        if (original_) {
            file_.connections = original_->connections;
            file_.editables = original_->editables;
        }
        return std::move(file_);
    }

private:
    /// A scene that nodes of the tree came from, made afresh to compare with.
    struct Base {
        std::unique_ptr<Node> root;
        const Node* instance = nullptr; // the node of our tree that stands for it
    };

    Status pack_root() {
        NodeEntry entry;
        entry.name = root_.name().str();
        Base base;
        const ExtEntry* inherited = inherited_scene();
        if (inherited) {
            Expected<std::unique_ptr<Node>> made = instance_of(inherited->path);
            if (!made) {
                return made.error();
            }
            base = {std::move(*made), &root_};
            entry.instance = packer_.link_to_file(inherited->path, "PackedScene");
        } else {
            entry.type = root_.class_name().str();
        }
        write(root_, std::move(entry), base.root.get());
        return pack_children(root_, inherited ? &base : nullptr);
    }

    /// The scene that the original inherits from; nullptr if it is none.
    [[nodiscard]] const ExtEntry* inherited_scene() const {
        const ResourceLink* link = original_ && !original_->nodes.empty()
                                       ? ResourceLink::in(original_->nodes.front().instance)
                                       : nullptr;
        return link ? original_->find_ext(link->id()) : nullptr;
    }

    Expected<std::unique_ptr<Node>> instance_of(const std::string& path) {
        const Expected<Ref<Resource>> resource = loader_.load_path(path);
        if (!resource) {
            return resource.error();
        }
        const Ref<PackedScene> scene = resource->cast<PackedScene>();
        return scene
                   ? scene->instance(diagnostics_)
                   : Expected<std::unique_ptr<Node>>(Error{ErrorCode::NotFound, "expected a scene", {path}});
    }

    Status pack_children(const Node& parent, const Base* base) {
        for (const std::unique_ptr<Node>& child : parent.children()) {
            if (Status packed = pack_node(*child, base); !packed) {
                return packed;
            }
        }
        return {};
    }

    Status pack_node(const Node& node, const Base* base) {
        NodeEntry entry;
        entry.name = node.name().str();
        entry.parent = node.parent() == &root_ ? "." : root_.path_to(*node.parent()).to_string();
        if (const Node* before = base ? base->root->get_node(base->instance->path_to(node)) : nullptr) {
            entry.index = static_cast<int64_t>(node.index());
            entry.properties = packer_.pack_properties(changed_properties(node, *before));
            entry.groups = saved_groups(node, before);
            if (!entry.properties.empty() || !entry.groups.empty()) {
                file_.nodes.push_back(std::move(entry));
            }
            return pack_children(node, base);
        }
        if (node.owner() != &root_) {
            return {}; // made at run time
        }
        if (base) {
            entry.index = static_cast<int64_t>(node.index());
        }
        if (node.scene_file().empty()) {
            entry.type = node.class_name().str();
            write(node, std::move(entry), nullptr);
            return pack_children(node, base);
        }
        Expected<std::unique_ptr<Node>> made = instance_of(node.scene_file());
        if (!made) {
            return made.error();
        }
        entry.instance = packer_.link_to_file(node.scene_file(), "PackedScene");
        const Base inner{std::move(*made), &node};
        write(node, std::move(entry), inner.root.get());
        return pack_children(node, &inner);
    }

    void write(const Node& node, NodeEntry entry, const Node* base) {
        entry.properties =
            packer_.pack_properties(base ? changed_properties(node, *base) : node.stored_properties());
        entry.groups = saved_groups(node, base);
        file_.nodes.push_back(std::move(entry));
    }

    const Node& root_;
    ResourceLoader& loader_;
    Diagnostics& diagnostics_;
    const SceneFile* original_;
    SceneFile file_;
    ResourcePacker packer_;
};

} // namespace

Expected<SceneFile> pack_scene(const Node& root, ResourceLoader& loader, Diagnostics& diagnostics,
                               const PackOptions& options) {
    return ScenePacker(root, loader, diagnostics, options).run();
}

} // namespace cl::scene
