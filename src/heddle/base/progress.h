#pragma once

#include <heddle/base/error.h>

#include <atomic>
#include <cstdint>
#include <string_view>

namespace heddle {

/// The interface by which long work reports progress and is cancelled. This one reports nothing.
///
/// `advance` and `cancelled` are called from any thread; all else from one thread, between phases.
class Progress {
public:
    Progress() = default;
    virtual ~Progress() = default;
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Starts a phase: `total` units of `unit` ("steps", "voxels") are to be done.
    virtual void begin(std::string_view stage, std::string_view unit, std::int64_t total);
    /// Reports that another `units` units are done.
    virtual void advance(std::int64_t units);
    /// Starts a part of the work ("frame 2 of 24"): the phases that follow belong to it.
    virtual void begin_part(std::string_view name);
    /// Tells the user one sentence while the work goes on.
    virtual void note(std::string_view sentence);

    /// Asks the work to stop: it throws Error{Cancelled} at its next check. Signal-safe.
    void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool cancelled() const noexcept {
        return cancelled_.load(std::memory_order_relaxed) ||
               (outer_ != nullptr && outer_->cancelled());
    }
    /// @throws Error  Cancelled, once cancel() was called
    void check() const;

protected:
    /// For a Progress that passes everything on to `outer`: it is cancelled when `outer` is.
    explicit Progress(const Progress* outer) : outer_(outer) {}

private:
    const Progress* outer_ = nullptr;
    std::atomic<bool> cancelled_{false};
    static_assert(std::atomic<bool>::is_always_lock_free, "cancel() runs in signal handlers");
};

} // namespace heddle
