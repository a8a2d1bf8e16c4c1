#pragma once

#include <heddle/base/progress.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace heddle::job {

/// Name and seconds of each stage of a job, in order; stages of one name are added up.
using StageTimes = std::vector<std::pair<std::string, double>>;

/// Passes everything on to another Progress and keeps how long each stage took.
class StageClock final : public Progress {
public:
    /// @param outer  lives as long
    explicit StageClock(Progress& outer);

    void begin(std::string_view stage, std::string_view unit, std::int64_t total) override;
    void advance(std::int64_t units) override { outer_.advance(units); }
    void begin_part(std::string_view name) override { outer_.begin_part(name); }
    void note(std::string_view sentence) override { outer_.note(sentence); }

    /// Ends the running stage.
    void finish();
    /// The stages that have ended.
    [[nodiscard]] const StageTimes& stages() const { return stages_; }
    /// Since this was made.
    [[nodiscard]] double seconds() const;

private:
    using Clock = std::chrono::steady_clock;

    Progress& outer_;
    Clock::time_point made_;
    Clock::time_point begun_; ///< of the running stage
    std::string stage_;       ///< that runs; empty: none
    StageTimes stages_;
};

/// Keeps sentences for a report, and has the user told of each at once.
void take_notes(std::vector<std::string>& kept,
                const std::vector<std::string>& sentences,
                Progress& progress);

} // namespace heddle::job
