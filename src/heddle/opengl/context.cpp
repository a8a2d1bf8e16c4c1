#include <heddle/base/error.h>
#include <heddle/opengl/context.h>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <vector>

namespace heddle::opengl {
namespace {

constexpr const char* kFix =
    "install libegl1, libgl1 and a driver (Debian: libgl1-mesa-dri has one that needs no GPU), or use --backend sample";

[[noreturn]] void fail(const std::string& what) {
    throw Error(ErrorCode::Device, "opengl: " + what, kFix);
}

/// epoxy ends the program if a library is missing, so they are checked first.
void require_libraries() {
    void* egl = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (egl == nullptr) fail("there is no libEGL.so.1");
    void* gl = dlopen("libOpenGL.so.0", RTLD_LAZY | RTLD_LOCAL);
    if (gl == nullptr) gl = dlopen("libGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (gl == nullptr) fail("there is no libOpenGL.so.0 and no libGL.so.1");
}

/// The displays to try, the surfaceless one first: it needs no device.
std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> out;
    const EGLDisplay none = EGL_NO_DISPLAY;
    if (epoxy_has_egl_extension(none, "EGL_EXT_platform_base")) {
        if (epoxy_has_egl_extension(none, "EGL_MESA_platform_surfaceless")) {
            out.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                   EGL_DEFAULT_DISPLAY, nullptr));
        }
        if (epoxy_has_egl_extension(none, "EGL_EXT_platform_device") &&
            epoxy_has_egl_extension(none, "EGL_EXT_device_enumeration")) {
            std::array<EGLDeviceEXT, 16> devices{};
            EGLint count = 0;
            eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
            for (EGLint i = 0; i < count; ++i) {
                out.push_back(eglGetPlatformDisplayEXT(
                    EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
            }
        }
    }
    return out;
}

} // namespace

struct Context::Handles {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    ~Handles() { close(); }

    void close() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        // the display is kept: it belongs to the process, and terminating it unloads a driver that
        // is used elsewhere
        display = EGL_NO_DISPLAY;
        context = EGL_NO_CONTEXT;
    }

    /// Returns false if this display does not offer such a context.
    bool open(EGLDisplay on, const ContextOptions& options) {
        EGLint major = 0;
        EGLint minor = 0;
        if (on == EGL_NO_DISPLAY || eglInitialize(on, &major, &minor) != EGL_TRUE) return false;
        display = on;
        const bool surfaceless = epoxy_has_egl_extension(on, "EGL_KHR_surfaceless_context");
        const bool bare = epoxy_has_egl_extension(on, "EGL_KHR_no_config_context");
        if (surfaceless && bare && eglBindAPI(EGL_OPENGL_API) == EGL_TRUE) {
            const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                                   options.major,
                                                   EGL_CONTEXT_MINOR_VERSION,
                                                   options.minor,
                                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                   EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                                   EGL_LOSE_CONTEXT_ON_RESET,
                                                   EGL_NONE};
            context = eglCreateContext(on, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
            if (context != EGL_NO_CONTEXT &&
                eglMakeCurrent(on, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) {
                return true;
            }
        }
        close();
        return false;
    }
};

Context::Context(const ContextOptions& options) : handles_(std::make_unique<Handles>()) {
    require_libraries();
    bool open = false;
    for (EGLDisplay display : displays()) {
        open = handles_->open(display, options);
        if (open) break;
    }
    if (!open) {
        fail(str("no driver gives OpenGL ", options.major, ".", options.minor,
                 " (core) without a window"));
    }
    read_limits();
}

Context::Context(OfWindow, const ContextOptions& options) {
    require_libraries();
    GLint major = 0;
    GLint minor = 0;
    if (glGetString(GL_VERSION) != nullptr) {
        glGetIntegerv(GL_MAJOR_VERSION, &major);
        glGetIntegerv(GL_MINOR_VERSION, &minor);
    }
    if (major < options.major || (major == options.major && minor < options.minor)) {
        fail(str("the window's driver gives OpenGL ", major, ".", minor, ", ", options.major, ".",
                 options.minor, " is needed"));
    }
    read_limits();
}

std::unique_ptr<Context> Context::of_window(const ContextOptions& options) {
    return std::unique_ptr<Context>(new Context(OfWindow{}, options));
}

void Context::read_limits() {
    driver_ = str(reinterpret_cast<const char*>(glGetString(GL_RENDERER)), ", OpenGL ",
                  reinterpret_cast<const char*>(glGetString(GL_VERSION)));
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limits_.storage_bytes);
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    std::array<GLint, 2> frame{};
    glGetIntegerv(GL_MAX_FRAMEBUFFER_WIDTH, &frame[0]);
    glGetIntegerv(GL_MAX_FRAMEBUFFER_HEIGHT, &frame[1]);
    limits_.viewport = std::min({viewport[0], viewport[1], frame[0], frame[1]});
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits_.texture);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limits_.layers);
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &limits_.groups);
    check("start");
}

Context::~Context() = default;

void Context::make_current() const {
    if (!handles_) return;
    if (eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context) !=
        EGL_TRUE) {
        fail("a context cannot be made current again");
    }
}

bool Context::is_software() const {
    return driver_.find("llvmpipe") != std::string::npos ||
           driver_.find("softpipe") != std::string::npos;
}

void Context::check(const char* stage) const {
    check_status(glGetGraphicsResetStatus(), glGetError(), stage);
}

void check_status(std::uint32_t reset, std::uint32_t error, const char* stage) {
    if (reset != GL_NO_ERROR || error == GL_CONTEXT_LOST) {
        throw LostContext(ErrorCode::Device,
                          str("opengl: the context was lost in stage '", stage, "'"),
                          "run again, with a lower --memory if a batch took too long");
    }
    if (error == GL_OUT_OF_MEMORY) {
        throw Error(ErrorCode::OutOfMemory,
                    str("opengl: the driver is out of memory in stage '", stage, "'"),
                    "lower --memory, or use larger voxels");
    }
    if (error != GL_NO_ERROR) {
        throw Error(ErrorCode::Device,
                    str("opengl: error 0x", std::hex, error, " in stage '", stage, "'"),
                    "try another driver, or --backend sample");
    }
}

} // namespace heddle::opengl
