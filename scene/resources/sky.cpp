#include "scene/resources/sky.h"

#include "servers/visual_server.h"

#include "core/object/class_registry.h"

#include <array>

namespace cl::scene {

void Sky::bind(ClassBuilder<Sky>& c) {
    c.doc("Light from far away in every direction.").abstract();
    c.property("radiance_size", &Sky::radiance_size, &Sky::set_radiance_size)
        .enumeration("32,64,128,256,512,1024,2048")
        .doc("Edge of the reflection map [texels].");
}

SetResult Sky::set_radiance_size(int exponent) {
    if (exponent < 0 || exponent > 6) {
        return SetResult::Refused;
    }
    radiance_size_ = exponent;
    sky_changed();
    return SetResult::Done;
}

RID Sky::rid(VisualServer& server) const {
    if (const RID made = rid_.in(server)) {
        return made;
    }
    SkyDesc desc = describe();
    if (desc.size.x <= 0 || desc.size.y <= 0) {
        return {};
    }
    desc.radiance_map_size = 32 << radiance_size_;
    rid_.adopt(server, server.sky_create(std::move(desc)));
    return rid_.get();
}

void Sky::sky_changed() {
    rid_.reset();
    emit_changed();
}

PanoramaSky::PanoramaSky() : panorama_([this] { sky_changed(); }) {}

void PanoramaSky::bind(ClassBuilder<PanoramaSky>& c) {
    c.doc("A panorama image as a sky.");
    c.property("panorama", &PanoramaSky::panorama, &PanoramaSky::set_panorama)
        .doc("Equirectangular image; decoded from sRGB if it has 8 bits.");
}

void PanoramaSky::set_panorama(Ref<Texture> texture) {
    panorama_.set(std::move(texture));
    sky_changed();
}

SkyDesc PanoramaSky::describe() const {
    SkyDesc desc;
    const std::shared_ptr<const Image> image = panorama_ ? panorama_->image() : nullptr;
    if (!image || image->data.empty()) {
        return desc;
    }
    desc.size = image->size;
    if (channel_count(image->format) != bytes_per_pixel(image->format)) { // floats: linear already
        const Image linear = image->converted_to(PixelFormat::RGBF);
        const std::span<const float> values = linear.floats();
        desc.radiance.assign(values.begin(), values.end());
        return desc;
    }
    std::array<float, 256> linear_from_byte{};
    for (size_t i = 0; i < linear_from_byte.size(); ++i) {
        linear_from_byte[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
    }
    const Image rgb = image->converted_to(PixelFormat::RGB8);
    desc.radiance.reserve(rgb.data.size());
    for (uint8_t byte : rgb.data) {
        desc.radiance.push_back(linear_from_byte[byte]);
    }
    return desc;
}

} // namespace cl::scene
