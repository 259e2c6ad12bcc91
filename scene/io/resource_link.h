#pragma once

#include "core/object/object.h"
#include "core/variant/variant.h"

#include <cstdint>
#include <string>
#include <utility>

namespace cl::scene {

/// Stands in a value that was read for a resource that is defined elsewhere, until the resource is made.
class ResourceLink final : public Reference {
public:
    enum class Kind {
        Ext,  ///< `ExtResource( id )`
        Sub,  ///< `SubResource( id )`
        Path, ///< `Resource( "path" )`
    };
    ResourceLink(Kind kind, int64_t id) : kind_(kind), id_(id) {}
    explicit ResourceLink(std::string path) : kind_(Kind::Path), path_(std::move(path)) {}

    [[nodiscard]] Kind kind() const noexcept { return kind_; }
    [[nodiscard]] int64_t id() const noexcept { return id_; }
    [[nodiscard]] const std::string& path() const noexcept { return path_; }

    /// The link that a value is, or nullptr.
    [[nodiscard]] static const ResourceLink* in(const Variant& value) noexcept {
        return dynamic_cast<const ResourceLink*>(value.to_object());
    }
    /// As the file spells it.
    [[nodiscard]] std::string to_text() const;

private:
    Kind kind_;
    int64_t id_ = 0;
    std::string path_;
};

} // namespace cl::scene
