#pragma once

#include <heddle/base/error.h>

#include <atomic>
#include <cstdint>
#include <string_view>

namespace heddle {

/// What long work reports to and is stopped by. The default one reports nothing and never stops.
///
/// `advance` and `cancelled` are called from any thread; `begin` from one thread between stages.
class Progress {
public:
    virtual ~Progress() = default;

    /// A stage starts: `total` units of `unit` ("steps", "voxels") are ahead.
    virtual void begin(std::string_view stage, std::string_view unit, std::int64_t total);
    /// `units` more are done.
    virtual void advance(std::int64_t units);

    /// Asks the work to stop: it throws Error{Cancelled} at its next check. Safe in a signal handler.
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
