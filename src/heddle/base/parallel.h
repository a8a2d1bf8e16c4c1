#pragma once

#include <heddle/base/function_ref.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace heddle {

/// Sets the number of threads of later parallel loops; 0: all cores. Do not call it inside a loop.
void set_thread_count(int threads);

/// The number of threads that a parallel loop will use, >= 1.
[[nodiscard]] int thread_count();

/// Calls body(begin, end) for disjoint chunks that cover [0, n), on `thread_count()` threads.
///
/// Chunk borders are multiples of `grain`: they depend on n and grain, never on the thread count.
/// @param grain    items per chunk, >= 1
/// @throws         the first exception that a body threw; chunks that have not started are skipped
void parallel_chunks(std::size_t n,
                     std::size_t grain,
                     FunctionRef<void(std::size_t, std::size_t)> body);

/// Folds chunk results in chunk order, so a float sum has the same bits on 1 thread and on 64.
///
/// @param map      T map(begin, end): the result of one chunk
/// @param combine  T combine(T left, T right): called serially, left to right
template <typename T, typename Map, typename Combine>
[[nodiscard]] T
reduce_chunks(std::size_t n, std::size_t grain, T init, const Map& map, const Combine& combine) {
    std::vector<T> part((n + grain - 1) / grain);
    parallel_chunks(n, grain, [&](std::size_t begin, std::size_t end) {
        part[begin / grain] = map(begin, end);
    });
    for (T& p : part) init = combine(std::move(init), std::move(p));
    return init;
}

} // namespace heddle
