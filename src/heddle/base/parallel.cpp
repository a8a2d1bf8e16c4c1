#include <heddle/base/parallel.h>

#include <algorithm>
#include <thread>

#if HEDDLE_PARALLEL_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>
#else
#include <atomic>
#include <exception>
#include <mutex>
#endif

namespace heddle {
namespace {

int wanted_threads = 0; // 0: all cores

int all_cores() {
    return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

} // namespace

int thread_count() {
    return wanted_threads > 0 ? wanted_threads : all_cores();
}

#if HEDDLE_PARALLEL_TBB

void set_thread_count(int threads) {
    wanted_threads = threads;
    // TBB's own limit also applies to libraries that use TBB internally (OpenVDB)
    static std::unique_ptr<tbb::global_control> ceiling;
    ceiling.reset();
    ceiling = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(thread_count()));
}

void parallel_chunks(std::size_t n,
                     std::size_t grain,
                     FunctionRef<void(std::size_t, std::size_t)> body) {
    const std::size_t chunks = (n + grain - 1) / grain;
    tbb::task_arena arena(thread_count()); // more threads than cores: for parity tests
    arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, chunks, 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                for (std::size_t c = range.begin(); c != range.end(); ++c) {
                    body(c * grain, std::min(n, (c + 1) * grain));
                }
            },
            tbb::simple_partitioner());
    });
}

#else

void set_thread_count(int threads) {
    wanted_threads = threads;
}

void parallel_chunks(std::size_t n,
                     std::size_t grain,
                     FunctionRef<void(std::size_t, std::size_t)> body) {
    const std::size_t chunks = (n + grain - 1) / grain;
    const std::size_t workers = std::min(chunks, static_cast<std::size_t>(thread_count()));
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr first;
    const auto work = [&] {
        for (std::size_t c = next.fetch_add(1); c < chunks; c = next.fetch_add(1)) {
            try {
                body(c * grain, std::min(n, (c + 1) * grain));
            } catch (...) {
                const std::scoped_lock lock(mutex);
                if (!first) first = std::current_exception();
                next.store(chunks);
            }
        }
    };
    {
        std::vector<std::jthread> pool;
        for (std::size_t i = 1; i < workers; ++i) pool.emplace_back(work);
        work();
    }
    if (first) std::rethrow_exception(first);
}

#endif

} // namespace heddle
