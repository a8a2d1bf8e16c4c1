#include <heddle/job/stage_clock.h>

#include <algorithm>

namespace heddle::job {

StageClock::StageClock(Progress& outer) : Progress(&outer), outer_(outer), made_(Clock::now()) {}

void StageClock::begin(std::string_view stage, std::string_view unit, std::int64_t total) {
    finish();
    outer_.begin(stage, unit, total);
    stage_ = stage;
    begun_ = Clock::now();
}

void StageClock::finish() {
    if (stage_.empty()) return;
    const std::chrono::duration<double> seconds = Clock::now() - begun_;
    const auto same = std::find_if(stages_.begin(), stages_.end(),
                                   [this](const auto& stage) { return stage.first == stage_; });
    if (same != stages_.end())
        same->second += seconds.count();
    else
        stages_.emplace_back(stage_, seconds.count());
    stage_.clear();
}

double StageClock::seconds() const {
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
