#include "core/node_path.h"

namespace cl {
namespace {

/// The non-empty pieces of `text` between separators.
std::vector<StringName> split(std::string_view text, char separator) {
    std::vector<StringName> pieces;
    while (!text.empty()) {
        const size_t end = std::min(text.find(separator), text.size());
        if (end > 0) {
            pieces.emplace_back(text.substr(0, end));
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return pieces;
}

} // namespace

NodePath::NodePath(std::string_view text) {
    absolute_ = text.starts_with('/');
    const size_t colon = std::min(text.find(':'), text.size());
    names_ = split(text.substr(0, colon), '/');
    subnames_ = split(text.substr(colon), ':');
}

std::string NodePath::to_string() const {
    std::string text;
    if (absolute_) {
        text += '/';
    }
    for (size_t i = 0; i < names_.size(); i++) {
        if (i > 0) {
            text += '/';
        }
        text += names_[i].view();
    }
    for (const StringName& subname : subnames_) {
        text += ':';
        text += subname.view();
    }
    return text;
}

} // namespace cl
