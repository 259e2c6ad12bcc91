#include "drivers/osmesa/osmesa_context.h"

#include <fmt/core.h>

#include <array>
#include <cstdint>
#include <dlfcn.h>
#include <utility>

namespace cl::osmesa {

namespace {

using drivers::GLContext;

// What we use of <GL/osmesa.h>, which would pull in the desktop <GL/gl.h> beside our GLES header.
using OSMesaContext = struct osmesa_context*;
using OSMesaProc = void (*)();
constexpr int kOsmesaFormat = 0x22, kOsmesaRgba = 0x1908;
constexpr int kOsmesaProfile = 0x33, kOsmesaCoreProfile = 0x34;
constexpr int kOsmesaContextMajorVersion = 0x36, kOsmesaContextMinorVersion = 0x37;
constexpr unsigned kGlUnsignedByte = 0x1401;

/// The library's entry points; the same for all contexts.
struct Library {
    OSMesaContext (*create_context_attribs)(const int* attributes, OSMesaContext share) = nullptr;
    void (*destroy_context)(OSMesaContext context) = nullptr;
    unsigned char (*make_current)(OSMesaContext context, void* buffer, unsigned type, int width,
                                  int height) = nullptr;
    OSMesaContext (*get_current_context)() = nullptr;
    OSMesaProc (*get_proc_address)(const char* name) = nullptr;
};

template <typename Function>
bool look_up(void* library, const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(dlsym(library, name));
    return function != nullptr;
}

Expected<Library> open_library() {
    // Never closed: Mesa's threads and thread-local destructors outlive the contexts.
    void* handle = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        const char* why = dlerror();
        return Error{ErrorCode::Unsupported,
                     fmt::format("osmesa: {}", why ? why : "libOSMesa.so.8 cannot be loaded")};
    }
    Library library;
    const bool complete = look_up(handle, "OSMesaCreateContextAttribs", library.create_context_attribs) &&
                          look_up(handle, "OSMesaDestroyContext", library.destroy_context) &&
                          look_up(handle, "OSMesaMakeCurrent", library.make_current) &&
                          look_up(handle, "OSMesaGetCurrentContext", library.get_current_context) &&
                          look_up(handle, "OSMesaGetProcAddress", library.get_proc_address);
    if (!complete) {
        return Error{ErrorCode::Unsupported,
                     "osmesa: libOSMesa.so.8 is older than OSMesaCreateContextAttribs"};
    }
    return library;
}

class OsmesaContext final : public GLContext {
public:
    OsmesaContext(const Library& library, OSMesaContext context) : library_(library), context_(context) {}
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;
    ~OsmesaContext() override {
        if (library_.get_current_context() == context_) {
            release_current();
        }
        library_.destroy_context(context_);
    }
    [[nodiscard]] drivers::DriverKind kind() const noexcept override { return drivers::DriverKind::Osmesa; }
    [[nodiscard]] glm::ivec2 size() const override { return glm::ivec2(0); }

protected:
    Status make_current_raw() override {
        if (!library_.make_current(context_, framebuffer_.data(), kGlUnsignedByte, kEdge, kEdge)) {
            return Error{ErrorCode::Unsupported, "osmesa: the context could not be made current"};
        }
        return {};
    }
    void release_current_raw() override { release_current(); }
    Proc proc_address(const char* name) const override { return library_.get_proc_address(name); }

private:
    void release_current() { library_.make_current(nullptr, nullptr, 0, 0, 0); }
    static constexpr int kEdge = 4;
    Library library_;
    OSMesaContext context_;
    /// Framebuffer 0, which OSMesa insists on and nobody draws to.
    std::array<uint32_t, size_t{kEdge} * kEdge> framebuffer_{};
};

} // namespace

Expected<std::unique_ptr<GLContext>> create_context() {
    Expected<Library> library = open_library();
    if (!library) {
        return library.error();
    }
    // Any version from 3.1 gives Mesa's best. 3.3 is the least that has all of GLES 3.0's GLSL features.
    const int attributes[] = {kOsmesaFormat,
                              kOsmesaRgba,
                              kOsmesaContextMajorVersion,
                              3,
                              kOsmesaContextMinorVersion,
                              3,
                              kOsmesaProfile,
                              kOsmesaCoreProfile,
                              0};
    OSMesaContext context = library->create_context_attribs(attributes, nullptr);
    if (!context) {
        return Error{ErrorCode::Unsupported, "osmesa: no OpenGL 3.3 core context"};
    }
    return std::unique_ptr<GLContext>(new OsmesaContext(*library, context));
}

} // namespace cl::osmesa
