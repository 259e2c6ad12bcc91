#include "scene/io/scene_instancer.h"

#include "scene/io/assign.h"
#include "scene/io/link_resolver.h"
#include "scene/io/local_resources.h"
#include "scene/io/scene_file.h"
#include "scene/main/missing_node.h"
#include "scene/main/node.h"
#include "scene/resources/missing_resource.h"

#include "core/object/class_registry.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <unordered_set>

namespace cl::scene {

namespace {

/// Goes through a file's nodes in order and builds the tree (spec tscn section 6).
class SceneInstancer {
public:
    SceneInstancer(const PackedScene& scene, Diagnostics& diagnostics, InstancingBudget& budget)
        : scene_(scene), file_(*scene.file()), diagnostics_(diagnostics), budget_(budget) {}

    Expected<std::unique_ptr<Node>> run() {
        for (const NodeEntry& entry : file_.nodes) {
            if (const Status added = add(entry); !added) {
                return added.error();
            }
        }
        if (!root_) {
            return error_at(file_.where, "expected a root node, found none that could be made");
        }
        root_->set_scene_file(scene_.path());
        for (const ConnectionEntry& connection : file_.connections) {
            connect(connection);
        }
        return std::move(root_);
    }

private:
    static Error error_at(const SourceLocation& where, std::string message,
                          ErrorCode code = ErrorCode::ParseError) {
        return {code, std::move(message), where};
    }

    Status add(const NodeEntry& entry) {
        if (!root_ && entry.parent) {
            return error_at(entry.where, "expected a root node above, found none that could be made");
        }
        Node* parent = nullptr;
        if (entry.parent) {
            if (is_below_left_out(*entry.parent)) {
                return {};
            }
            parent = find(*entry.parent);
            if (!parent) {
                return error_at(entry.where,
                                fmt::format("expected the path of a node above as \"parent\", found \"{}\"",
                                            *entry.parent));
            }
        }
        const bool is_override =
            entry.type.empty() && entry.instance.is_nil() && entry.instance_placeholder.empty();
        return is_override ? change_existing(entry, *parent) : add_new(entry, parent);
    }

    /// The node at a path from the root; absolute paths lead nowhere (spec tscn section 6).
    [[nodiscard]] Node* find(const std::string& path) const {
        return path.empty() || path.front() == '/' ? nullptr : root_->get_node(path);
    }

    Status change_existing(const NodeEntry& entry, Node& parent) {
        Node* node = find_child(parent, entry.name);
        if (!node) {
            left_out_.insert(entry.path());
            diagnostics_.warn(
                entry.where,
                fmt::format("expected a node \"{}\" in the instanced scene, found none: left out",
                            entry.path()));
            return {};
        }
        return fill(entry, *node);
    }

    [[nodiscard]] static Node* find_child(const Node& parent, const std::string& name) {
        for (const std::unique_ptr<Node>& child : parent.children()) {
            if (child->name().view() == name) {
                return child.get();
            }
        }
        return nullptr;
    }

    Status add_new(const NodeEntry& entry, Node* parent) {
        Expected<std::unique_ptr<Node>> made = make(entry);
        if (!made) {
            return made.error();
        }
        std::unique_ptr<Node> node = std::move(*made);
        if (!node) {
            left_out_.insert(entry.path());
            return {};
        }
        if (Status filled = fill(entry, *node); !filled) {
            return filled;
        }
        return place(entry, std::move(node), parent);
    }

    /// Null: the node is left out, and a warning said so.
    Expected<std::unique_ptr<Node>> make(const NodeEntry& entry) {
        if (budget_.nodes_left == 0) {
            return error_at(entry.where, "expected a scene of at most 1048576 nodes, found more",
                            ErrorCode::OutOfMemory);
        }
        --budget_.nodes_left;
        std::unique_ptr<Node> node;
        if (const ResourceLink* link = ResourceLink::in(entry.instance)) {
            Expected<std::unique_ptr<Node>> instance = make_instance(entry, *link);
            if (!instance || !*instance) {
                return instance;
            }
            node = std::move(*instance);
        } else if (!entry.type.empty()) {
            node = make_of_class(entry);
        } else {
            node = std::make_unique<Node>();
            node->set_declared_class("InstancePlaceholder");
            diagnostics_.warn(entry.where, "instance placeholders are kept, without effect",
                              "InstancePlaceholder");
        }
        if (!entry.name.empty()) {
            node->set_name_verbatim(entry.name);
        } else if (node->name().empty()) {
            node->set_name_verbatim(node->class_name());
        }
        return node;
    }

    std::unique_ptr<Node> make_of_class(const NodeEntry& entry) {
        const TextAssignment* transform = find_assignment(entry.properties, "transform");
        const bool has_transform = transform && transform->value.type() == Variant::Type::Transform;
        CreatedNode created = create_node(ClassRegistry::instance(), StringName(entry.type),
                                          has_transform ? TransformHint::HasTransform : TransformHint::None);
        if (created.support != NodeSupport::Full) {
            warn_unknown_node_class(entry.type, entry.where, diagnostics_);
        }
        return std::move(created.node);
    }

    Expected<std::unique_ptr<Node>> make_instance(const NodeEntry& entry, const ResourceLink& link) {
        const auto& ext = scene_.resources().ext;
        const auto found = ext.find(link.id());
        const Ref<Resource> resource = found != ext.end() ? found->second : nullptr;
        const Ref<PackedScene> inner = resource.cast<PackedScene>();
        if (inner && inner->file()) {
            if (budget_.depth_left == 0) {
                return error_at(entry.where, "expected scenes inside scenes at most 64 deep, found more",
                                ErrorCode::OutOfMemory);
            }
            --budget_.depth_left;
            Expected<std::unique_ptr<Node>> node = instance_scene(*inner, diagnostics_, budget_);
            ++budget_.depth_left;
            return node;
        }
        if (resource.cast<MissingResource>() && root_) {
            diagnostics_.warn(entry.where, fmt::format("\"{}\" is left out: its scene {} could not be read",
                                                       entry.path(), resource->path()));
            return std::unique_ptr<Node>();
        }
        return error_at(entry.where,
                        fmt::format("expected a scene as \"instance\", found {}",
                                    resource ? "a " + resource->class_name().str() : std::string("null")));
    }

    Status fill(const NodeEntry& entry, Node& node) {
        for (const TextAssignment& assignment : entry.properties) {
            const Expected<Variant> value =
                resolve_links(assignment.value, [this](const ResourceLink& link) { return resolve(link); });
            if (!value) {
                return error_at(assignment.value_where, value.error().message, value.error().code);
            }
            if (Status assigned = assign(node, assignment, *value, diagnostics_); !assigned) {
                return assigned;
            }
        }
        for (const std::string& group : entry.groups) {
            node.add_to_group(StringName(group), GroupSaving::Saved);
        }
        return {};
    }

    Status place(const NodeEntry& entry, std::unique_ptr<Node> node, Node* parent) {
        if (!parent) {
            root_ = std::move(node);
            return {};
        }
        Node* child = node.get();
        if (const Status added = parent->add_child(std::move(node), Naming::Keep); !added) {
            return error_at(entry.where, added.error().message, added.error().code);
        }
        const size_t siblings_before = parent->children().size() - 1;
        if (entry.index && *entry.index >= 0 && static_cast<size_t>(*entry.index) < siblings_before) {
            if (const Status moved = parent->move_child(*child, static_cast<size_t>(*entry.index)); !moved) {
                return error_at(entry.where, moved.error().message, moved.error().code);
            }
        }
        return child->set_owner(root_.get());
    }

    Expected<Variant> resolve(const ResourceLink& link) {
        const PackedScene::Resources& resources = scene_.resources();
        if (link.kind() == ResourceLink::Kind::Path) {
            const auto loaded = resources.by_path.find(link.path());
            return loaded != resources.by_path.end() ? Variant(loaded->second) : Variant();
        }
        const bool is_sub = link.kind() == ResourceLink::Kind::Sub;
        const auto& made = is_sub ? resources.sub : resources.ext;
        const auto found = made.find(link.id());
        if (found == made.end()) {
            return Variant();
        }
        return is_sub ? local_.localized(found->second) : Variant(found->second);
    }

    void connect(const ConnectionEntry& entry) {
        Node* from = find(entry.from);
        Node* to = find(entry.to);
        if (!from || !to) {
            return; // Godot skips these in silence; they come with nodes that were left out
        }
        // A signal that is not known here belongs to a script or to a class that we do not have.
        static_cast<void>(from->connect_method(StringName(entry.signal), *to, StringName(entry.method),
                                               static_cast<ConnectFlags>(entry.flags), entry.binds));
    }

    /// True for the path of a node that was left out, and of all below it.
    [[nodiscard]] bool is_below_left_out(const std::string& parent) const {
        if (left_out_.empty()) {
            return false;
        }
        std::string path = parent.substr(0, 2) == "./" ? parent : "./" + parent;
        for (;;) {
            if (left_out_.count(path) > 0) {
                return true;
            }
            const size_t slash = path.rfind('/');
            if (slash == std::string::npos || slash == 0) {
                return false;
            }
            path.resize(slash);
        }
    }

    const PackedScene& scene_;
    const SceneFile& file_;
    Diagnostics& diagnostics_;
    InstancingBudget& budget_;
    std::unique_ptr<Node> root_;
    LocalResources local_;
    std::unordered_set<std::string> left_out_; // paths of entries without a node
};

} // namespace

Expected<std::unique_ptr<Node>> instance_scene(const PackedScene& scene, Diagnostics& diagnostics,
                                               InstancingBudget& budget) {
    return SceneInstancer(scene, diagnostics, budget).run();
}

} // namespace cl::scene
