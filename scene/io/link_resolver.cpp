#include "scene/io/link_resolver.h"

#include <algorithm>

namespace cl::scene {

namespace {

// Depth is bounded by the reader (kMaxTextDepth), so these may recurse.
bool contains_link(const Variant& value) {
    if (const Array* array = value.get_if<Array>()) {
        return std::any_of(array->begin(), array->end(), contains_link);
    }
    if (const Dictionary* dictionary = value.get_if<Dictionary>()) {
        return std::any_of(
            dictionary->entries().begin(), dictionary->entries().end(),
            [](const Dictionary::Entry& e) { return contains_link(e.first) || contains_link(e.second); });
    }
    return ResourceLink::in(value) != nullptr;
}

Expected<Variant> replace(const Variant& value, const LinkResolver& resolver);

Expected<Variant> replace_in_array(const Array& array, const LinkResolver& resolver) {
    Array replaced;
    replaced.reserve(array.size());
    for (const Variant& element : array) {
        Expected<Variant> v = replace(element, resolver);
        if (!v) {
            return v;
        }
        replaced.push_back(std::move(*v));
    }
    return Variant(std::move(replaced));
}

Expected<Variant> replace_in_dictionary(const Dictionary& dictionary, const LinkResolver& resolver) {
    Dictionary replaced;
    for (const Dictionary::Entry& entry : dictionary.entries()) {
        Expected<Variant> key = replace(entry.first, resolver);
        if (!key) {
            return key;
        }
        Expected<Variant> value = replace(entry.second, resolver);
        if (!value) {
            return value;
        }
        replaced.set(std::move(*key), std::move(*value));
    }
    return Variant(std::move(replaced));
}

Expected<Variant> replace(const Variant& value, const LinkResolver& resolver) {
    if (const Array* array = value.get_if<Array>()) {
        return replace_in_array(*array, resolver);
    }
    if (const Dictionary* dictionary = value.get_if<Dictionary>()) {
        return replace_in_dictionary(*dictionary, resolver);
    }
    const ResourceLink* link = ResourceLink::in(value);
    return link ? resolver(*link) : Expected<Variant>(value);
}

} // namespace

Expected<Variant> resolve_links(const Variant& value, const LinkResolver& resolver) {
    return contains_link(value) ? replace(value, resolver) : Expected<Variant>(value);
}

} // namespace cl::scene
