#pragma once

#include <heddle/base/error.h>

#include <atomic>
#include <cstdint>
#include <string_view>

namespace heddle {

/// What long work reports to and is stopped by. The default one reports nothing and never stops.
///
/// `advance` and `cancelled` are called from any thread; all else from one thread between stages.
class Progress {
public:
    Progress() = default;
    virtual ~Progress() = default;
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// A stage starts: `total` units of `unit` ("steps", "voxels") are ahead.
    virtual void begin(std::string_view stage, std::string_view unit, std::int64_t total);
    /// `units` more are done.
    virtual void advance(std::int64_t units);
    /// A part of the work starts ("frame 2 of 24"): the stages that follow are its own.
    virtual void begin_part(std::string_view name);
    /// A sentence that the user should see before the work goes on.
    virtual void note(std::string_view sentence);

    /// Asks the work to stop: it throws Error{Cancelled} at its next check. Safe in a signal handler.
    void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool cancelled() const noexcept {
        return cancelled_.load(std::memory_order_relaxed) ||
               (outer_ != nullptr && outer_->cancelled());
    }
    /// @throws Error  Cancelled, once cancel() was called
    void check() const;

protected:
    /// For one that passes everything on to `outer`: it is cancelled when that one is.
    explicit Progress(const Progress* outer) : outer_(outer) {}

private:
    const Progress* outer_ = nullptr;
    std::atomic<bool> cancelled_{false};
    static_assert(std::atomic<bool>::is_always_lock_free, "cancel() runs in signal handlers");
};

} // namespace heddle
