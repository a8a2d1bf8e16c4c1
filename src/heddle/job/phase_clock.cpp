#include <heddle/job/phase_clock.h>

#include <algorithm>

namespace heddle::job {

PhaseClock::PhaseClock(Progress& outer) : Progress(&outer), outer_(outer), made_(Clock::now()) {}

void PhaseClock::begin(std::string_view phase, std::string_view unit, std::int64_t total) {
    finish();
    outer_.begin(phase, unit, total);
    phase_ = phase;
    begun_ = Clock::now();
}

void PhaseClock::finish() {
    if (phase_.empty()) return;
    const std::chrono::duration<double> seconds = Clock::now() - begun_;
    const auto same = std::find_if(phases_.begin(), phases_.end(),
                                   [this](const auto& phase) { return phase.first == phase_; });
    if (same != phases_.end())
        same->second += seconds.count();
    else
        phases_.emplace_back(phase_, seconds.count());
    phase_.clear();
}

double PhaseClock::seconds() const {
    return std::chrono::duration<double>(Clock::now() - made_).count();
}

void take_notes(std::vector<std::string>& kept,
                const std::vector<std::string>& sentences,
                Progress& progress) {
    for (const std::string& sentence : sentences) {
        progress.note(sentence);
        kept.push_back(sentence);
    }
}

} // namespace heddle::job
