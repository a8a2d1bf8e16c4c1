#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heddle::executor {

/// Seconds that launches took, per phase, over all executors that share it.
class PhaseTimes {
public:
    void add(std::string_view stage, double seconds) {
        const std::scoped_lock lock(mutex_);
        for (auto& [name, sum] : times_) {
            if (name != stage) continue;
            sum += seconds;
            return;
        }
        times_.emplace_back(stage, seconds);
    }
    /// All phases, in the order in which they first ran.
    [[nodiscard]] std::vector<std::pair<std::string, double>> all() const {
        const std::scoped_lock lock(mutex_);
        return times_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<std::pair<std::string, double>> times_;
};

/// Adds the time between its construction and destruction to a phase; if `times` is null, to none.
class PhaseTimer {
public:
    PhaseTimer(PhaseTimes* times, std::string_view stage) : times_(times), stage_(stage) {
        if (times_ != nullptr) start_ = std::chrono::steady_clock::now();
    }
    ~PhaseTimer() {
        if (times_ == nullptr) return;
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
        times_->add(stage_, spent.count());
    }
    PhaseTimer(const PhaseTimer&) = delete;
    PhaseTimer& operator=(const PhaseTimer&) = delete;

private:
    PhaseTimes* times_;
    std::string_view stage_;
    std::chrono::steady_clock::time_point start_;
};

} // namespace heddle::executor
