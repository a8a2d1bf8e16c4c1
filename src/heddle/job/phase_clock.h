#pragma once

#include <heddle/base/progress.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace heddle::job {

/// Name and seconds of each phase of a job, in order; phases of the same name are added up.
using PhaseTimes = std::vector<std::pair<std::string, double>>;

/// Forwards all calls to another Progress and measures how long each phase takes.
class PhaseClock final : public Progress {
public:
    /// @param outer  must outlive this object
    explicit PhaseClock(Progress& outer);

    void begin(std::string_view phase, std::string_view unit, std::int64_t total) override;
    void advance(std::int64_t units) override { outer_.advance(units); }
    void begin_part(std::string_view name) override { outer_.begin_part(name); }
    void note(std::string_view sentence) override { outer_.note(sentence); }

    /// Ends the running phase.
    void finish();
    /// Returns the phases that have ended.
    [[nodiscard]] const PhaseTimes& phases() const { return phases_; }
    /// Returns the seconds since construction.
    [[nodiscard]] double seconds() const;

private:
    using Clock = std::chrono::steady_clock;

    Progress& outer_;
    Clock::time_point made_;
    Clock::time_point begun_; ///< start of the running phase
    std::string phase_;       ///< name of the running phase; empty: none
    PhaseTimes phases_;
};

/// Appends sentences to the notes of a report, and reports each to `progress` at once.
void take_notes(std::vector<std::string>& kept,
                const std::vector<std::string>& sentences,
                Progress& progress);

} // namespace heddle::job
