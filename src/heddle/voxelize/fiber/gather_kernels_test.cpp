#include <heddle/voxelize/chord/chord_op.h>
#include <heddle/voxelize/fiber/gather_kernels.h>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

namespace heddle {
namespace {

#if HEDDLE_WITH_AVX2
bool has_avx2() {
    return __builtin_cpu_supports("avx2") != 0;
}
bool has_avx512() {
    return __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0;
}
#else
bool has_avx2() {
    return false;
}
#endif

/// Random chords in and around a block.
struct RandomChords {
    static constexpr int kCount = 256;
    std::array<std::vector<float>, 9> reals;
    std::vector<float> length, before, after, radius;
    std::array<std::vector<std::int32_t>, 3> anchor;
    std::vector<std::uint32_t> color;

    explicit RandomChords(std::uint32_t seed) {
        std::mt19937 random(seed);
        const auto uniform = [&](float lo, float hi) {
            return std::uniform_real_distribution<float>(lo, hi)(random);
        };
        for (int i = 0; i < kCount; ++i) {
            Vec3f d = normalize(Vec3f{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
            if (i % 16 == 0) d = {0.0f, 0.0f, i % 32 == 0 ? 1.0f : -1.0f}; // along an axis
            const Vec3f start{uniform(-20, 20), uniform(-20, 20), uniform(-20, 20)};
            for (int a = 0; a < 3; ++a) {
                reals[static_cast<std::size_t>(a)].push_back(start[a]);
                reals[static_cast<std::size_t>(3 + a)].push_back(d[a]);
                reals[static_cast<std::size_t>(6 + a)].push_back(uniform(-0.3f, 0.3f));
                anchor[static_cast<std::size_t>(a)].push_back(
                    static_cast<std::int32_t>(random() % 36) - 2);
            }
            length.push_back(i % 11 == 0 ? 0.0f : uniform(0.1f, 25.0f));
            before.push_back(uniform(0.0f, 0.2f));
            after.push_back(uniform(0.0f, 0.2f));
            radius.push_back(uniform(0.02f, 2.0f));
            color.push_back(0xffffff);
        }
    }
    [[nodiscard]] ChordArrays arrays() const {
        return {{reals[0].data(), reals[1].data(), reals[2].data()},
                {reals[3].data(), reals[4].data(), reals[5].data()},
                {reals[6].data(), reals[7].data(), reals[8].data()},
                length.data(),
                before.data(),
                after.data(),
                radius.data(),
                {anchor[0].data(), anchor[1].data(), anchor[2].data()},
                color.data(),
                kCount};
    }
};

void expect_same_sums(const BlockSums& a, const BlockSums& b) {
    ASSERT_EQ(a.count(), b.count());
    ASSERT_GT(a.count(), 100);
    for (int x = 0; x < kBlockVoxels; ++x) {
        for (int y = 0; y < kBlockVoxels; ++y) {
            for (int z = 0; z < kBlockVoxels; ++z) {
                const VoxelSums* p = a.find(x, y, z);
                const VoxelSums* q = b.find(x, y, z);
                ASSERT_EQ(p == nullptr, q == nullptr);
                if (p == nullptr) continue;
                ASSERT_EQ(std::memcmp(p, q, sizeof(VoxelSums)), 0);
            }
        }
    }
}

#if HEDDLE_WITH_AVX2
/// Expects that `gather` gives the same sums as plain code for random chords. The last three chords
/// are past `count` and must be ignored.
void expect_bits_of_plain_code(void (*gather)(const ChordArrays&, const GatherTarget&)) {
    const RandomChords chords(7);
    ChordArrays most = chords.arrays();
    most.count -= 3;
    for (const Vec3d voxel : {Vec3d{0.1, 0.1, 0.1}, Vec3d{0.1, 0.25, 0.4}}) {
        for (const int subvoxels : {8, 2}) {
            const LatticeUnits units(Lattice{.voxel_size = voxel, .subvoxels = subvoxels});
            const auto plain = std::make_unique<BlockSums>(false);
            const auto wide = std::make_unique<BlockSums>(false);
            const Vec3i size{kBlockVoxels, kBlockVoxels, 19};
            const int shift = subvoxels == 8 ? 3 : 1;
            plain->reset({0, 0, 0}, size);
            wide->reset({0, 0, 0}, size);
            portable::gather(most, {*plain, units, shift, size, {}});
            gather(most, {*wide, units, shift, size, {}});
            expect_same_sums(*plain, *wide);
        }
    }
}

TEST(GatherKernels, Avx2GivesTheBitsOfPlainCode) {
    if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
    expect_bits_of_plain_code(avx2::gather);
}

TEST(GatherKernels, Avx512GivesTheBitsOfPlainCode) {
    if (!has_avx512()) GTEST_SKIP() << "no AVX-512 here";
    expect_bits_of_plain_code(avx512::gather);
}
#endif

/// The chords, one by one.
void gather_each(const ChordArrays& c, const GatherTarget& target) {
    const ChordSpace space(target.units, target.size);
    const FiberSums sums{target.block, target.paint};
    for (int i = 0; i < c.count; ++i) {
        const auto vec = [&](const auto* const(&of)[3]) {
            return Vec3{of[0][i], of[1][i], of[2][i]};
        };
        gather_chord_op({vec(c.start), vec(c.dir), vec(c.bend), c.length[i], c.before[i],
                         c.after[i], c.radius[i]},
                        vec(c.anchor), space, sums);
    }
}

TEST(GatherKernels, OneChordAtATimeGivesTheBitsOfEight) {
    const RandomChords chords(11);
    for (const Vec3d voxel : {Vec3d{0.1, 0.1, 0.1}, Vec3d{0.1, 0.25, 0.4}}) {
        for (const int subvoxels : {1, 2, 4, 8}) {
            const LatticeUnits units(Lattice{.voxel_size = voxel, .subvoxels = subvoxels});
            const Vec3i size{kBlockVoxels, 17, kBlockVoxels};
            const auto eight = std::make_unique<BlockSums>(false);
            const auto each = std::make_unique<BlockSums>(false);
            eight->reset({0, 0, 0}, size);
            each->reset({0, 0, 0}, size);
            const int shift = std::countr_zero(static_cast<unsigned>(subvoxels));
            portable::gather(chords.arrays(), {*eight, units, shift, size, {}});
            gather_each(chords.arrays(), {*each, units, shift, size, {}});
            ASSERT_EQ(eight->count(), each->count());
            ASSERT_GT(eight->count(), 100);
            for (int cell = 0; cell < BlockSums::kVoxels; ++cell) {
                const int x = cell / (kBlockVoxels * kBlockVoxels);
                const int y = cell / kBlockVoxels % kBlockVoxels;
                const VoxelSums* p = eight->find(x, y, cell % kBlockVoxels);
                const VoxelSums* q = each->find(x, y, cell % kBlockVoxels);
                ASSERT_EQ(p == nullptr, q == nullptr);
                ASSERT_TRUE(p == nullptr || std::memcmp(p, q, sizeof(VoxelSums)) == 0);
            }
        }
    }
}

TEST(GatherKernels, PlainCodeAndAvx2ExpandTheSameFibers) {
    if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
    YarnType yarn;
    yarn.model = YarnModel::Procedural;
    yarn.plies = 3;
    yarn.fibers_per_ply = 37;
    const FiberTable table = place_fibers(yarn, 5, 0);
    ASSERT_EQ(table.size(), 111u);
    std::vector<PlyFrame> frames;
    for (int j = 0; j < 7; ++j) {
        const float t = 0.3f * static_cast<float>(j);
        frames.push_back({{t, t * t, 1.0f},
                          {1.0f, 0.1f * t, 0.0f},
                          {0.0f, 1.0f, 0.2f * t},
                          sincos_turns(0.03 * j),
                          sincos_turns(0.11 * j)});
    }
    const std::vector<PlyPart> parts{
        {0, 37, frames.data()}, {37, 74, frames.data()}, {74, 111, frames.data()}};
    const auto expand = [&](auto function) {
        auto tile = std::make_unique<FiberTile>();
        std::memset(static_cast<void*>(tile.get()), 0, sizeof(FiberTile));
        tile->fibers = 111;
        tile->chords = 4;
        for (float& r : tile->radius) r = 0.4f;
        function(*tile, std::span<const PlyPart>(parts), PlySection{1.0f, 2.0f, 3.0f, 0.8f, 0.2f},
                 table);
        return tile;
    };
    const auto plain = expand(portable::expand);
    EXPECT_GT(plain->length[3][110], 0.0f);
    EXPECT_EQ(plain->length[3][111], 0.0f) << "lanes past the last fiber are no chords";
#if HEDDLE_WITH_AVX2
    const auto wide = expand(avx2::expand);
    for (int f = 0; f < 111; ++f) {
        for (int c = 0; c < 4; ++c) {
            ASSERT_EQ(plain->length[c][f], wide->length[c][f]);
            ASSERT_EQ(plain->dx[c][f], wide->dx[c][f]);
            ASSERT_EQ(plain->bz[c][f], wide->bz[c][f]);
            ASSERT_EQ(plain->before[c][f], wide->before[c][f]);
        }
    }
#endif
}

} // namespace
} // namespace heddle
