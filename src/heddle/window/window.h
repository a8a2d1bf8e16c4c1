#pragma once

#include <heddle/base/progress.h>
#include <heddle/viewer/session/session.h>

#include <cstdint>

namespace heddle::window {

struct WindowOptions {
    std::int32_t width = 1280; ///< pixels
    std::int32_t height = 800;
};

/// Response figures of a window.
struct WindowCounts {
    std::int64_t inputs = 0; ///< frames that showed the effect of an input
    double median_ms = 0.0;  ///< from the input to the picture that shows it
    double worst_ms = 0.0;
    std::int64_t contexts = 0; ///< opened contexts: one, and one more for each that was lost
    std::string driver;
};

/// Opens a window that shows a subject and returns when it is closed. If the driver loses its
/// context, the window is reopened with the same settings.
/// @param settings  the initial settings
/// @param progress  closes the window when it is cancelled
/// @throws Error    Device: no display, no OpenGL 4.5; as Session
[[nodiscard]] WindowCounts run_window(const viewer::ViewedObject& subject,
                                      const viewer::Settings& settings,
                                      const WindowOptions& options,
                                      const Progress& progress);

} // namespace heddle::window
