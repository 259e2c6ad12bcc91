#include "scene/io/resource_link.h"

#include "core/variant/variant_writer.h"

#include <fmt/format.h>

namespace cl::scene {

std::string ResourceLink::to_text() const {
    if (kind_ == Kind::Path) {
        std::string text = "Resource( ";
        append_quoted(text, path_);
        return text + " )";
    }
    return fmt::format("{}( {} )", kind_ == Kind::Ext ? "ExtResource" : "SubResource", id_);
}

} // namespace cl::scene
