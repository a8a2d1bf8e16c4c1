#pragma once

#include <heddle/base/progress.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace heddle::cli {

/// Draws the running stage on stderr, at most ten times a second, with rate and time left, and keeps
/// how long each stage took.
class ProgressBar final : public Progress {
public:
    /// @param visible  draw; false: only keep the stages' times
    explicit ProgressBar(bool visible) : visible_(visible) {}

    void begin(std::string_view stage, std::string_view unit, std::int64_t total) override;
    void advance(std::int64_t units) override;
    /// A part of the work starts ("frame 2 of 24"): its name stands before the stages', and their times are
    /// counted anew.
    void begin_part(const std::string& name);
    /// Ends the running stage and wipes the line.
    void finish();
    /// Name and seconds of each ended stage, in order; stages of one name are added up.
    [[nodiscard]] const std::vector<std::pair<std::string, double>>& stages() const {
        return stages_;
    }

private:
    using Clock = std::chrono::steady_clock;
    void draw(double seconds) const;

    bool visible_;
    std::string part_; ///< with a space behind it, or empty
    std::string stage_;
    std::string unit_;
    std::int64_t total_ = 0;
    std::atomic<std::int64_t> done_{0};
    std::atomic<std::int64_t> next_draw_ms_{0}; ///< since the stage began
    Clock::time_point start_;
    std::mutex drawing_;
    std::vector<std::pair<std::string, double>> stages_;
};

/// From now on SIGINT and SIGTERM cancel `progress`; a second one ends the program at once.
/// @param progress  lives until the program ends
void cancel_on_signals(Progress& progress);

} // namespace heddle::cli
