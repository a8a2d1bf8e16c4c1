#pragma once

#include <heddle/base/error.h>

#include <cstdint>
#include <memory>
#include <string>

namespace heddle::opengl {

/// What is asked of the driver.
struct ContextOptions {
    int major = 4; ///< least version of OpenGL, core profile
    int minor = 5;
};

/// Numbers of the driver that sizes are planned by.
struct ContextLimits {
    std::int64_t storage_bytes = 0; ///< largest shader storage block
    std::int32_t viewport = 0;      ///< px, most along an axis
    std::int32_t texture = 0;       ///< px, most along an axis of a 2D image
    std::int32_t layers = 0;        ///< most in an array of images
    std::int32_t groups = 0;        ///< most work groups along x
};

/// Device: the driver gave up the context with all that was made in it; another may do.
struct LostContext : Error {
    using Error::Error;
};

/// OpenGL without a window or a display, by EGL: surfaceless where the driver has it (Mesa), else
/// on the first EGL device that gives a context. Current on the thread that made it, which alone
/// may use it and all that is made in it.
class Context {
public:
    /// @throws Error  Device: no libEGL, no driver, or one below the version asked for
    explicit Context(const ContextOptions& options = {});
    /// The context that a window has made current on this thread and that it keeps.
    /// @throws Error  Device: none is current, or one below the version asked for
    [[nodiscard]] static std::unique_ptr<Context> of_window(const ContextOptions& options = {});
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes it current on this thread again, after another was: one that has its own window is not
    /// moved.
    /// @throws Error  Device
    void make_current() const;
    [[nodiscard]] const ContextLimits& limits() const { return limits_; }
    /// Name and version of the driver, for reports.
    [[nodiscard]] const std::string& driver() const { return driver_; }
    /// True where OpenGL runs on the CPU (Mesa's llvmpipe or softpipe).
    [[nodiscard]] bool is_software() const;

    /// @param stage  what was done since the last call, for the message
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

/// Throws unless `reset` and `error`, as glGetGraphicsResetStatus and glGetError give them, are 0.
/// @throws Error  as Context::check
void check_status(std::uint32_t reset, std::uint32_t error, const char* stage);

} // namespace heddle::opengl
