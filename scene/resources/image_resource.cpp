#include "scene/resources/texture.h"

#include "core/object/class_registry.h"

#include <fmt/format.h>

#include <array>
#include <optional>

namespace cl::scene {

using namespace std::string_view_literals;

namespace {

struct NamedFormat {
    std::string_view name;
    PixelFormat format;
};
constexpr std::array<NamedFormat, 10> kFormats{{
    {"Lum8", PixelFormat::L8},
    {"LumAlpha8", PixelFormat::LA8},
    {"Red8", PixelFormat::R8},
    {"RedGreen", PixelFormat::RG8},
    {"RGB8", PixelFormat::RGB8},
    {"RGBA8", PixelFormat::RGBA8},
    {"RFloat", PixelFormat::RF},
    {"RGFloat", PixelFormat::RGF},
    {"RGBFloat", PixelFormat::RGBF},
    {"RGBAFloat", PixelFormat::RGBAF},
}};

std::optional<PixelFormat> format_named(std::string_view name) {
    for (const NamedFormat& f : kFormats) {
        if (f.name == name) {
            return f.format;
        }
    }
    return std::nullopt;
}

std::string_view name_of(PixelFormat format) {
    for (const NamedFormat& f : kFormats) {
        if (f.format == format) {
            return f.name;
        }
    }
    return "";
}

int64_t int_entry(const Dictionary& d, std::string_view key) {
    const Variant* value = d.find(key);
    return value && value->is_num() ? value->to_int() : -1;
}

/// The base level of a stored image. @return ParseError for a size, format or byte count that does not fit.
Expected<std::shared_ptr<const Image>> image_from(const Dictionary& d) {
    const int64_t width = int_entry(d, "width"), height = int_entry(d, "height");
    if (width < 1 || height < 1 || width > kMaxImageEdge || height > kMaxImageEdge) {
        return Error{ErrorCode::ParseError,
                     fmt::format("expected \"width\" and \"height\" from 1 to {}, found {} and {}",
                                 kMaxImageEdge, width, height)};
    }
    const Variant* format_value = d.find("format"sv);
    const std::string* name = format_value ? format_value->get_if<std::string>() : nullptr;
    if (!name) {
        return Error{ErrorCode::ParseError, "expected a format name as \"format\", found none"};
    }
    const Variant* data_value = d.find("data"sv);
    const auto* data = data_value ? data_value->get_if<PoolByteArray>() : nullptr;
    if (!data) {
        return Error{ErrorCode::ParseError, "expected a PoolByteArray as \"data\", found none"};
    }
    const std::optional<PixelFormat> format = format_named(*name);
    if (!format) {
        return Error{ErrorCode::Unsupported, fmt::format("image format \"{}\" is not supported", *name)};
    }
    const auto base_bytes = static_cast<size_t>(width * height * bytes_per_pixel(*format));
    if (data->size() < base_bytes) { // mipmaps, if any, follow the base level
        return Error{ErrorCode::ParseError,
                     fmt::format("expected at least {} * {} * {} = {} bytes of data, found {}", width, height,
                                 bytes_per_pixel(*format), base_bytes, data->size())};
    }
    auto image = std::make_shared<Image>();
    image->size = {static_cast<int>(width), static_cast<int>(height)};
    image->format = *format;
    image->data.assign(data->span().begin(), data->span().begin() + static_cast<std::ptrdiff_t>(base_bytes));
    return std::shared_ptr<const Image>(std::move(image));
}

} // namespace

void ImageResource::bind(ClassBuilder<ImageResource>& c) {
    c.doc("Pixels inside a scene file.");
    c.property("data", &ImageResource::data, &ImageResource::set_data)
        .doc("width, height, format, mipmaps and the bytes, row 0 at the top.");
}

void ImageResource::set_image(std::shared_ptr<const Image> image) {
    image_ = std::move(image);
    data_ = {};
    refusal_.clear();
    emit_changed();
}

Dictionary ImageResource::data() const {
    if (data_.size() > 0 || !image_) {
        return data_;
    }
    Dictionary d;
    d.set("data", PoolByteArray(image_->data));
    d.set("format", name_of(image_->format));
    d.set("height", image_->size.y);
    d.set("mipmaps", false);
    d.set("width", image_->size.x);
    return d;
}

SetResult ImageResource::set_data(const Dictionary& data) {
    refusal_.clear();
    const Expected<std::shared_ptr<const Image>> image = image_from(data);
    if (!image && image.error().code != ErrorCode::Unsupported) {
        refusal_ = image.error().message;
        return SetResult::Refused;
    }
    problem_ = image ? std::string() : image.error().message;
    data_ = data;
    image_ = image ? *image : nullptr;
    emit_changed();
    return SetResult::Done;
}

} // namespace cl::scene
