#include <heddle/executor/budget.h>

#include <heddle/base/error.h>

namespace heddle::executor {

void Budget::take(std::int64_t bytes, std::string_view stage) {
    const std::int64_t now = used_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
    if (now > limit_) {
        used_.fetch_sub(bytes, std::memory_order_relaxed);
        throw Error(ErrorCode::OutOfMemory,
                    str(stage, ": ", bytes, " bytes of device memory are needed beside ",
                        now - bytes, " in use, ", limit_, " may be used"),
                    "raise --device-memory");
    }
    std::int64_t peak = peak_.load(std::memory_order_relaxed);
    while (peak < now && !peak_.compare_exchange_weak(peak, now, std::memory_order_relaxed)) {
    }
}

} // namespace heddle::executor
