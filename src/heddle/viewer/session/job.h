#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxel/voxel_level.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace heddle::viewer {

/// The result of a job.
struct JobResult {
    std::string message;                       ///< one line
    std::shared_ptr<const VoxelLevels> levels; ///< new voxels; null: none, or it failed
};

/// Work on a thread of its own.
class Job final : public Progress {
public:
    /// @param run  the text of an Error that it throws becomes the message
    explicit Job(std::function<JobResult(Progress&)> run);
    /// Stops the job.
    ~Job() override;
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    /// The current phase, and the fraction of it that is done, up to 1.
    [[nodiscard]] std::string stage() const;
    [[nodiscard]] double part() const;
    /// Returns the result, once, when it is there.
    [[nodiscard]] std::optional<JobResult> poll();

    void begin(std::string_view stage, std::string_view unit, std::int64_t total) override;
    void advance(std::int64_t units) override { done_ += units; }

private:
    mutable std::mutex naming_;
    std::string stage_;
    std::atomic<std::int64_t> total_{0};
    std::atomic<std::int64_t> done_{0};
    JobResult result_;
    std::atomic<bool> finished_{false};
    std::thread thread_; ///< last member: it uses the others
};

} // namespace heddle::viewer
