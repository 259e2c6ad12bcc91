#include "scene/io/imported_texture.h"

#include "scene/io/config_file.h"

#include "core/image/alpha_border.h"
#include "core/threads.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

namespace cl::scene {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 11> kImageSuffixes{"png", "jpg", "jpeg", "hdr",  "exr", "webp",
                                                          "bmp", "tga", "svg",  "svgz", "dds"};

struct Import {
    std::optional<Expected<Image>> image;
    uint32_t flags = texture_flag::kDefault;
    bool fix_alpha_border = true;
    Diagnostics diagnostics;
};

uint32_t flags_of(const ConfigFile& import) {
    enum Repeat : int64_t { Disabled, Enabled, Mirrored };
    const int64_t repeat = import.int_or("params/flags/repeat", Enabled);
    uint32_t flags = 0;
    flags |= repeat == Enabled ? texture_flag::kRepeat : 0;
    flags |= repeat == Mirrored ? texture_flag::kMirroredRepeat : 0;
    flags |= import.bool_or("params/flags/filter", true) ? texture_flag::kFilter : 0;
    flags |= import.bool_or("params/flags/mipmaps", true) ? texture_flag::kMipmaps : 0;
    flags |= import.bool_or("params/flags/anisotropic", false) ? texture_flag::kAnisotropic : 0;
    return flags;
}

void read_settings(const fs::path& file, Import& import) {
    fs::path settings = file;
    settings += ".import";
    std::error_code error;
    if (!fs::is_regular_file(settings, error)) {
        return;
    }
    if (const Expected<ConfigFile> config = ConfigFile::load(settings, import.diagnostics)) {
        import.flags = flags_of(*config);
        import.fix_alpha_border = config->bool_or("params/process/fix_alpha_border", true);
    } else {
        import.diagnostics.warn(config.error().where,
                                config.error().message + "; the image's settings are not used");
    }
}

void load(const fs::path& file, Import& import) {
    read_settings(file, import);
    import.image = load_image(file);
    if (*import.image && import.fix_alpha_border) {
        **import.image = with_fixed_alpha_border(**import.image);
    }
}

} // namespace

bool is_image_name(std::string_view path) noexcept {
    const size_t dot = path.rfind('.');
    if (dot == std::string_view::npos) {
        return false;
    }
    std::string suffix(path.substr(dot + 1));
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::find(kImageSuffixes.begin(), kImageSuffixes.end(), suffix) != kImageSuffixes.end();
}

std::vector<Expected<Ref<StreamTexture>>> import_textures(std::span<const fs::path> files,
                                                          Diagnostics& diagnostics) {
    std::vector<Import> imports(files.size());
    parallel_for(files.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            load(files[i], imports[i]);
        }
    });
    std::vector<Expected<Ref<StreamTexture>>> textures;
    textures.reserve(files.size());
    for (Import& import : imports) {
        for (const Warning& w : import.diagnostics.warnings()) {
            diagnostics.warn(w.where, w.message);
        }
        if (!*import.image) {
            textures.emplace_back(import.image->error());
            continue;
        }
        auto texture = make_ref<StreamTexture>();
        texture->set_flags(import.flags);
        texture->set_image(std::make_shared<const Image>(std::move(**import.image)));
        textures.emplace_back(std::move(texture));
    }
    return textures;
}

} // namespace cl::scene
