#pragma once

#include <heddle/base/error.h>

#include <atomic>
#include <cstdint>
#include <string_view>

namespace heddle {

/// The interface by which long work reports progress and is cancelled. This one reports nothing.
///
/// `advance` and `cancelled` are called from any thread; `begin` from one thread, between phases.
class Progress {
public:
    virtual ~Progress() = default;

    /// Starts a phase: `total` units of `unit` ("steps", "voxels") are to be done.
    virtual void begin(std::string_view stage, std::string_view unit, std::int64_t total);
    /// Reports that another `units` units are done.
    virtual void advance(std::int64_t units);

    /// Asks the work to stop: it throws Error{Cancelled} at its next check. Signal-safe.
    void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool cancelled() const noexcept {
        return cancelled_.load(std::memory_order_relaxed);
    }
    /// @throws Error  Cancelled, once cancel() was called
    void check() const;

private:
    std::atomic<bool> cancelled_{false};
    static_assert(std::atomic<bool>::is_always_lock_free, "cancel() runs in signal handlers");
};

} // namespace heddle
