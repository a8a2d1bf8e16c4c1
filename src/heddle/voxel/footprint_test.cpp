#include <heddle/voxel/footprint.h>

#include <heddle/base/random.h>

#include <gtest/gtest.h>

#include <vector>

namespace heddle {
namespace {

/// Returns the words, in Z-order, of a face of n 2^level columns per axis, with the bits set for
/// which covered(p, q) is true.
template <typename Covered>
Footprint footprint_of(int level, int n, const Covered& covered) {
    Footprint face(level, n);
    for (std::uint64_t w = 0; w < (std::uint64_t{1} << (2 * level)); ++w) {
        int p0 = 0, q0 = 0;
        for (int b = 0; b < level; ++b) {
            p0 |= static_cast<int>(w >> (2 * b) & 1) << b;
            q0 |= static_cast<int>(w >> (2 * b + 1) & 1) << b;
        }
        std::uint64_t bits = 0;
        for (int q = 0; q < n; ++q) {
            for (int p = 0; p < n; ++p) {
                if (covered(p0 * n + p, q0 * n + q)) bits |= std::uint64_t{1} << (q * n + p);
            }
        }
        face.add(w, bits);
    }
    return face;
}

TEST(Footprint, AHalfCoveredFaceHasItsHalfOfTheCells) {
    for (const int n : {1, 2, 4, 8}) {
        for (int level = n == 1 ? 1 : 0; level < 6; ++level) {
            const int edge = n << level;
            const Footprint left = footprint_of(level, n, [&](int p, int) { return p < edge / 2; });
            EXPECT_EQ(left.bits(8), 0x0f0f0f0f0f0f0f0fu) << n << " level " << level;
            EXPECT_EQ(left.bits(4), 0x3333u) << n << " level " << level;
            const Footprint low = footprint_of(level, n, [&](int, int q) { return q < edge / 2; });
            EXPECT_EQ(low.bits(8), 0xffffffffu) << n << " level " << level;
            EXPECT_EQ(low.bits(4), 0xffu) << n << " level " << level;
        }
    }
}

TEST(Footprint, OfLevelZeroIsTheColumns) {
    const std::uint64_t columns = hash64(1, 2);
    Footprint face(0, 8);
    face.add(0, columns);
    EXPECT_EQ(face.bits(8), columns);
}

TEST(Footprint, KeepsTheCoveredShareToHalfACell) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const int level = static_cast<int>(seed % 5);
        std::int64_t set = 0;
        const Footprint face = footprint_of(level, 8, [&](int p, int q) {
            const bool on =
                hash64(seed, static_cast<std::uint64_t>(p), static_cast<std::uint64_t>(q)) % 64 <
                seed;
            set += on;
            return on;
        });
        const double share = static_cast<double>(set) / static_cast<double>(64 << (2 * level));
        EXPECT_NEAR(std::popcount(face.bits(8)) / 64.0, share, 0.5 / 64 + 1e-9);
        EXPECT_NEAR(std::popcount(face.bits(4)) / 16.0, share, 0.5 / 16 + 1e-9);
    }
}

} // namespace
} // namespace heddle
