#pragma once

#include <heddle/window/window.h>

#include <cstdint>
#include <functional>

namespace heddle::window {

/// run_window() that calls `shown(n)` after frame n, counted from 1 over all contexts. An exception
/// of `shown` acts like one of the frame.
[[nodiscard]] WindowCounts run_watched_window(const viewer::ViewedObject& subject,
                                              const viewer::Settings& settings,
                                              const WindowOptions& options,
                                              const Progress& progress,
                                              const std::function<void(std::int64_t)>& shown);

} // namespace heddle::window
