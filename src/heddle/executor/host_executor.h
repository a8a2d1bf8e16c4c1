#pragma once

#include <heddle/base/parallel.h>
#include <heddle/executor/executor.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>

namespace heddle::executor {

/// Runs on the host's threads what CudaExecutor (cuda_executor.cuh) runs on a device, with the same
/// calls and the same bits. A machine without a GPU tests all but the launches with it.
///
/// A call may return before it is done: results are there after wait(), read() or download().
class HostExecutor : public Executor<HostExecutor> {
public:
    explicit HostExecutor(Budget& budget) : Executor(budget) {}

    /// An array of n objects with all bits 0.
    template <typename T>
    [[nodiscard]] Array<T> make_zero(std::size_t n) {
        Array<T> out(*this, n);
        if (n > 0) std::memset(static_cast<void*>(out.data()), 0, n * sizeof(T));
        return out;
    }
    template <typename T>
    void upload(T* to, std::span<const T> from) {
        if (!from.empty()) std::memcpy(static_cast<void*>(to), from.data(), from.size_bytes());
    }
    template <typename T>
    void download(std::span<T> to, const T* from) {
        if (!to.empty()) std::memcpy(static_cast<void*>(to.data()), from, to.size_bytes());
    }
    void wait() {}

    /// Calls op(i) for every std::size_t i in [0, n), in any order; `op` is a HEDDLE_HD functor of
    /// values.
    template <typename Op>
    void for_each(std::size_t n, const Op& op) {
        const PhaseTimer timer(times_, stage());
        const std::size_t share = n / (static_cast<std::size_t>(thread_count()) * 8);
        parallel_chunks(n, std::clamp<std::size_t>(share, 1, 1024),
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t i = begin; i < end; ++i) op(i);
                        });
    }
    /// first[i] = count[0] + ... + count[i - 1] for i in [0, n]: n + 1 numbers.
    template <typename In, typename Out>
    void offsets(const In* count, Out* first, std::size_t n) {
        const PhaseTimer timer(times_, stage());
        Out sum{};
        for (std::size_t i = 0; i < n; ++i) {
            first[i] = sum;
            sum += static_cast<Out>(count[i]);
        }
        first[n] = sum;
    }

private:
    // each array is its own allocation, so that a sanitizer sees an access past its end
    void* allocate(std::size_t bytes) override {
        return ::operator new (bytes, std::align_val_t{64});
    }
    void release(void* data) noexcept override { ::operator delete (data, std::align_val_t{64}); }
};

} // namespace heddle::executor
