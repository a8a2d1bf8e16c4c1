#include <heddle/viewer/session/job.h>

#include <exception>
#include <utility>

namespace heddle::viewer {

Job::Job(std::function<JobResult(Progress&)> run)
    : thread_([this, work = std::move(run)] {
          try {
              result_ = work(*this);
          } catch (const std::exception& e) {
              result_ = {e.what(), nullptr};
          }
          finished_ = true;
      }) {}

Job::~Job() {
    cancel();
    if (thread_.joinable()) thread_.join();
}

std::string Job::stage() const {
    const std::lock_guard lock(naming_);
    return stage_;
}

double Job::part() const {
    const std::int64_t total = total_;
    return total > 0 ? static_cast<double>(done_) / static_cast<double>(total) : 0.0;
}

std::optional<JobResult> Job::poll() {
    if (!finished_ || !thread_.joinable()) return std::nullopt;
    thread_.join();
    return std::move(result_);
}

void Job::begin(std::string_view stage, std::string_view, std::int64_t total) {
    const std::lock_guard lock(naming_);
    stage_ = stage;
    done_ = 0;
    total_ = total;
}

} // namespace heddle::viewer
