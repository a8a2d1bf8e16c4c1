#pragma once

#include <heddle/base/progress.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace heddle::cli {

/// Shows the running phase on stderr, with its rate and the time left, at most ten times a second.
class ProgressBar final : public Progress {
public:
    /// @param on_note  is called with each note; may be empty
    explicit ProgressBar(bool visible, std::function<void(const std::string&)> on_note = {})
        : visible_(visible), on_note_(std::move(on_note)) {}

    void begin(std::string_view phase, std::string_view unit, std::int64_t total) override;
    void advance(std::int64_t units) override;
    /// The name of the part is shown in front of the name of the phase.
    void begin_part(std::string_view name) override;
    void note(std::string_view sentence) override;
    /// Ends the running phase and erases the line.
    void finish();

private:
    using Clock = std::chrono::steady_clock;
    void draw(double seconds) const;
    void wipe() const;

    bool visible_;
    std::function<void(const std::string&)> on_note_;
    std::string part_; ///< ends with a space, or is empty
    std::string phase_;
    std::string unit_;
    std::int64_t total_ = 0;
    std::atomic<std::int64_t> done_{0};
    std::atomic<std::int64_t> next_draw_ms_{0}; ///< since the phase began
    Clock::time_point start_;
    std::mutex drawing_;
};

/// Lets SIGINT and SIGTERM cancel `progress`. A second signal ends the program at once.
/// @param progress  must live until the program ends
void cancel_on_signals(Progress& progress);

} // namespace heddle::cli
