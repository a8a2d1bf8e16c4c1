#pragma once

#include <heddle/base/platform.h>

#include <cstdint>

namespace heddle {

/// A well-mixed 64-bit value of (seed, a, b): the same on every machine, in any order of calls.
/// Two rounds of the SplitMix64 finalizer over a Weyl combination.        [Steele 2014]
[[nodiscard]] HEDDLE_HD constexpr std::uint64_t
hash64(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0) {
    std::uint64_t z = seed + 0x9e3779b97f4a7c15u * (a + 1) + 0xd1b54a32d192ed03u * (b + 1);
    for (int round = 0; round < 2; ++round) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
    }
    return z;
}

/// Uniform in [0, 1), 24 bits, from a hash.
[[nodiscard]] HEDDLE_HD constexpr float to_unit_float(std::uint64_t hash) {
    return static_cast<float>(hash >> 40) * 0x1p-24f;
}

/// A stream of hashes: draw k of the stream (seed, id) is hash64(seed, id, k). Cheap to copy.
struct CounterRandom {
    std::uint64_t seed = 0;
    std::uint64_t id = 0;
    std::uint64_t k = 0;

    HEDDLE_HD constexpr std::uint64_t next() { return hash64(seed, id, k++); }
    /// Uniform in [0, 1).
    HEDDLE_HD constexpr float uniform() { return to_unit_float(next()); }
};

/// A fast stream for Monte Carlo: SplitMix64, one round per draw.                     [Steele 2014]
struct StreamRandom {
    std::uint64_t state = 0;

    HEDDLE_HD constexpr std::uint64_t next() {
        state += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }
    /// Uniform in [0, 1).
    HEDDLE_HD constexpr float uniform() { return to_unit_float(next()); }
};

} // namespace heddle
