#pragma once

#include <heddle/sggx/moment_lobes.h>
#include <heddle/sggx/wasserstein.h>

#include <cstdint>
#include <span>

// Methods of merging, applied to lobes alone, for tests and benchmarks. The voxelizer and the
// levels merge lobes together with their maps (voxel/lobe_pool.h).

namespace heddle::test {

/// Reduces pooled lobes to at most `keep` by the method `moments`, and further while two are closer
/// than `same`. Lobes of different materials merge only if no two of one material are left.
///
/// @param lobes   0 .. kMaxPool, weights > 0; those left are at the front, in order
/// @param keep    1 or more
/// @param merges  receives size - return value merges, with the numbers of `lobes` before the call
/// @param same    0: merges down to `keep` and no further
/// @return        how many are left
inline int
reduce_lobes(std::span<DirectionSums> lobes, int keep, LobeMerge* merges, float same = kSameLobe) {
    const int count = static_cast<int>(lobes.size());
    if (count < 2) return count;
    MomentLobes policy(lobes);
    return compact_lobes(lobes, merges, agglomerate(count, keep, policy, merges, same));
}

/// Reduces pooled lobes to at most `keep` by the method `wasserstein`, as reduce_lobes does.
///
/// Takes about 15 ms for 24 lobes.
/// @param seed  seed of the samples
inline int reduce_lobes_by_wasserstein(std::span<DirectionSums> lobes,
                                       int keep,
                                       std::uint64_t seed,
                                       LobeMerge* merges) {
    const int count = static_cast<int>(lobes.size());
    if (count <= keep) return count;
    WassersteinLobes policy(lobes, seed);
    return compact_lobes(lobes, merges, agglomerate(count, keep, policy, merges));
}

} // namespace heddle::test
