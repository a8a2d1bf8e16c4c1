#pragma once

#include <heddle/base/random.h>
#include <heddle/base/vec.h>

#include <array>
#include <cstdint>

namespace heddle {

namespace detail {

[[nodiscard]] constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Scrambles x in base 2 (nested, uniform): each bit is flipped depending on the bits above it.
/// [Owen 1995; Burley 2020]
[[nodiscard]] constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
    x = reverse_bits(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}

/// Returns the second dimension of Sobol's sequence; the first is reverse_bits(i).
[[nodiscard]] constexpr std::uint32_t sobol_second(std::uint32_t i) {
    std::uint32_t out = 0;
    for (std::uint32_t v = 1u << 31; i != 0; i >>= 1, v ^= v >> 1) {
        if ((i & 1u) != 0) out ^= v;
    }
    return out;
}

} // namespace detail

/// The random numbers of one path: Owen-scrambled Sobol pairs, each shuffled independently
/// ("padded"), for the first dimensions; then a stream of hashes.                   [Burley 2020]
///
/// Deterministic in (seed, pixel, sample): pictures do not depend on threads.
class PathSampler {
public:
    PathSampler(std::uint64_t seed, std::uint64_t pixel, std::uint32_t sample)
        : pixel_(hash64(seed, pixel)),
          sample_(sample),
          stream_{hash64(seed ^ 0x5bd1e995u, pixel, sample)} {}

    /// Two numbers in [0, 1).
    [[nodiscard]] std::array<float, 2> pair() {
        if (pairs_ >= kPadded) return {stream_.uniform(), stream_.uniform()};
        const std::uint64_t keys = hash64(pixel_, pairs_++);
        const auto low = static_cast<std::uint32_t>(keys);
        const auto high = static_cast<std::uint32_t>(keys >> 32);
        // aligned runs of 2^k samples stay aligned runs, so each is a (0, k, 2) net
        const std::uint32_t index = detail::owen_scramble(sample_, low);
        return {to_float(detail::owen_scramble(detail::reverse_bits(index), high)),
                to_float(detail::owen_scramble(detail::sobol_second(index), high ^ 0x9e3779b9u))};
    }
    [[nodiscard]] float one() { return pair()[0]; }
    [[nodiscard]] Vec3f three() {
        const auto [a, b] = pair();
        return {a, b, one()};
    }
    /// Random numbers for loops whose length is not known beforehand.
    [[nodiscard]] StreamRandom& stream() { return stream_; }

private:
    static constexpr std::uint32_t kPadded = 16; ///< pairs for the pixel, the lens and three events
    [[nodiscard]] static float to_float(std::uint32_t bits) {
        return static_cast<float>(bits >> 8) * 0x1p-24f;
    }
    std::uint64_t pixel_;
    std::uint32_t sample_;
    std::uint32_t pairs_ = 0;
    StreamRandom stream_;
};

} // namespace heddle
