#include "terrain/gpu/gl_context.h"

#include <array>
#include <atomic>
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <optional>
#include <sstream>
#include <vector>

#ifdef SCREE_SANITIZED
// Drivers keep memory of every context, some of it taken by code that they compile at run time and
// that no suppression can name. So a program that opened a context is not searched for leaks; the
// tests without one still are.
static std::atomic<bool> a_context_was_asked_for = false;
extern "C" __attribute__((visibility("default"))) int __lsan_is_turned_off();
int __lsan_is_turned_off() {
    return a_context_was_asked_for ? 1 : 0;
}
#endif

namespace scree::terrain {
namespace {

constexpr const char* kRemedy =
    "install libegl1, libegl-mesa0 and libgl1-mesa-dri (software) or the graphics card's driver";

// libepoxy ends the program where a library that it needs is missing, so that is asked first.
bool library_is_there(const char* name) {
    void* handle = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr)
        return false;
    dlclose(handle);
    return true;
}

struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    bool software = false;
};

// Devices that EGL lists, hardware before software; then Mesa without a device.
std::vector<Candidate> candidates() {
    std::vector<Candidate> hardware;
    std::vector<Candidate> software;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 32> devices{};
        EGLint n_devices = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &n_devices) ==
            EGL_FALSE)
            n_devices = 0;
        for (EGLint i = 0; i < n_devices; ++i) {
            const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
            const char* words = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
            const bool soft =
                words != nullptr &&
                std::string(words).find("EGL_MESA_device_software") != std::string::npos;
            (soft ? software : hardware)
                .push_back(
                    {eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr), soft});
        }
    }
    hardware.insert(hardware.end(), software.begin(), software.end());
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        hardware.push_back(
            {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
             false});
    return hardware;
}

std::optional<EGLConfig> choose_config(EGLDisplay display) {
    if (epoxy_has_egl_extension(display, "EGL_KHR_no_config_context"))
        return EGL_NO_CONFIG_KHR;
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint n_configs = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &n_configs) == EGL_FALSE || n_configs < 1)
        return std::nullopt;
    return config;
}

EGLContext create_context(EGLDisplay display) {
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
        return EGL_NO_CONTEXT;
    const auto config = choose_config(display);
    if (!config)
        return EGL_NO_CONTEXT;
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
    return eglCreateContext(display, *config, EGL_NO_CONTEXT, wanted);
}

bool names_software(const std::string& renderer) {
    for (const char* name : {"llvmpipe", "softpipe", "SWR", "swrast", "Software"})
        if (renderer.find(name) != std::string::npos)
            return true;
    return false;
}

}  // namespace

// The display of a device is EGL's, one for the whole process: opening it again does nothing, and
// closing it would pull it from under the other contexts, so it stays open to the end.
struct GlContext::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::string device;
    bool software = false;
    int max_texture_size = 0;
    int max_texture_layers = 0;

    ~State() {
        if (context == EGL_NO_CONTEXT)
            return;
        if (eglGetCurrentContext() == context)
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }

    bool open(const Candidate& candidate) {
        display = candidate.display;
        if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
            return false;
        context = create_context(display);
        if (context == EGL_NO_CONTEXT ||
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE)
            return false;
        device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        software = candidate.software || names_software(device);
        glGetIntegerv(GL_MAX_TEXTURE_SIZE, &max_texture_size);
        glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_texture_layers);
        return true;
    }
};

GlContext::GlContext(std::unique_ptr<State> state) : state_(std::move(state)) {}
GlContext::~GlContext() = default;

GlContext::Attempt GlContext::try_make(const GlContextOptions& options) {
#ifdef SCREE_SANITIZED
    a_context_was_asked_for = true;
#endif
    std::ostringstream text;
    if (!epoxy_has_egl()) {
        text << "there is no EGL library (libEGL.so.1): " << kRemedy;
        return {nullptr, text.str()};
    }
    if (!library_is_there("libOpenGL.so.0") && !library_is_there("libGL.so.1")) {
        text << "there is no OpenGL library (libOpenGL.so.0 or libGL.so.1): install libopengl0; "
             << kRemedy;
        return {nullptr, text.str()};
    }
    const auto all = candidates();
    for (const Candidate& candidate : all) {
        auto state = std::make_unique<State>();
        if (!state->open(candidate) || (options.software && !state->software))
            continue;
        return {std::unique_ptr<GlContext>(new GlContext(std::move(state))), {}};
    }
    text << "no " << (options.software ? "software " : "") << "device gives an OpenGL 4.5 context "
         << "without a display (" << all.size() << " tried): " << kRemedy;
    return {nullptr, text.str()};
}

std::unique_ptr<GlContext> GlContext::make(const GlContextOptions& options) {
    Attempt attempt = try_make(options);
    if (!attempt.context)
        fail<DeviceError>(attempt.reason);
    return std::move(attempt.context);
}

void GlContext::make_current() const {
    if (eglGetCurrentContext() == state_->context)
        return;
    eglBindAPI(EGL_OPENGL_API);
    if (eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context) ==
        EGL_FALSE)
        fail<DeviceError>("the OpenGL context of ", state_->device,
                          " cannot be made current; is it in use on another thread?");
}

const std::string& GlContext::device() const {
    return state_->device;
}
bool GlContext::is_software() const {
    return state_->software;
}
int GlContext::max_texture_size() const {
    return state_->max_texture_size;
}
int GlContext::max_texture_layers() const {
    return state_->max_texture_layers;
}

}  // namespace scree::terrain
