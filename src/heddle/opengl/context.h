#pragma once

#include <heddle/base/error.h>

#include <cstdint>
#include <memory>
#include <string>

namespace heddle::opengl {

/// The requirements for a context.
struct ContextOptions {
    int major = 4; ///< minimum version of OpenGL, core profile
    int minor = 5;
};

/// Limits of the driver that sizes are planned with.
struct ContextLimits {
    std::int64_t storage_bytes = 0; ///< largest shader storage block
    std::int32_t viewport = 0;      ///< px, maximum along an axis
    std::int32_t texture = 0;       ///< px, maximum along an axis of a 2D image
    std::int32_t layers = 0;        ///< maximum in an array of images
    std::int32_t groups = 0;        ///< maximum number of work groups along x
};

/// Device error: the driver lost the context with all its objects; a new context may work.
struct LostContext : Error {
    using Error::Error;
};

/// OpenGL without a window or a display, by EGL: surfaceless if the driver supports it (Mesa), else
/// on the first EGL device that offers a context. It is current on the thread that made it, which
/// alone may use it and its objects.
class Context {
public:
    /// @throws Error  Device: no libEGL, no driver, or an OpenGL version below the minimum
    explicit Context(const ContextOptions& options = {});
    /// The context of a window, which is current on this thread and which the window owns.
    /// @throws Error  Device: none is current, or its OpenGL version is below the minimum
    [[nodiscard]] static std::unique_ptr<Context> of_window(const ContextOptions& options = {});
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes it current on this thread again, after another context was; one that belongs to a
    /// window is left as it is.
    /// @throws Error  Device
    void make_current() const;
    [[nodiscard]] const ContextLimits& limits() const { return limits_; }
    /// Name and version of the driver, for reports.
    [[nodiscard]] const std::string& driver() const { return driver_; }
    /// True if OpenGL runs on the CPU (Mesa's llvmpipe or softpipe).
    [[nodiscard]] bool is_software() const;

    /// @param stage  the work since the last call, for the message
    /// @throws Error  OutOfMemory; Device: a call failed; LostContext
    void check(const char* stage) const;

private:
    struct Handles;
    struct OfWindow {};
    Context(OfWindow, const ContextOptions& options);
    void read_limits();
    std::unique_ptr<Handles> handles_;
    ContextLimits limits_;
    std::string driver_;
};

/// Throws unless `reset` and `error`, from glGetGraphicsResetStatus and glGetError, are 0.
/// @throws Error  as Context::check
void check_status(std::uint32_t reset, std::uint32_t error, const char* stage);

} // namespace heddle::opengl
