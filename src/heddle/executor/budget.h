#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

namespace heddle::executor {

/// Counts the working memory in bytes of all executors that share it, up to a limit. Thread-safe.
class Budget {
public:
    /// @param limit_bytes  the most that may be in use at once
    explicit Budget(std::int64_t limit_bytes) : limit_(limit_bytes) {}

    /// @param stage  the phase that needs the bytes: named in the error
    /// @throws Error  OutOfMemory: more than the limit would be in use; then nothing is taken
    void take(std::int64_t bytes, std::string_view stage);
    void give(std::int64_t bytes) noexcept { used_.fetch_sub(bytes, std::memory_order_relaxed); }

    [[nodiscard]] std::int64_t limit() const { return limit_; }
    [[nodiscard]] std::int64_t used() const { return used_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::int64_t peak() const { return peak_.load(std::memory_order_relaxed); }

private:
    std::int64_t limit_;
    std::atomic<std::int64_t> used_{0};
    std::atomic<std::int64_t> peak_{0};
};

} // namespace heddle::executor
