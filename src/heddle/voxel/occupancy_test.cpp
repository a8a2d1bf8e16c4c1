#include <heddle/voxel/occupancy.h>

#include <heddle/base/random.h>
#include <heddle/voxel/spool.h>

#include <gtest/gtest.h>

#include <array>

namespace heddle {
namespace {

constexpr std::uint64_t cell_bit(int x, int y, int z) {
    return std::uint64_t{1} << ((x * 4 + y) * 4 + z);
}

bool has_subvoxel(const std::array<std::uint64_t, 8>& sub, int n, int x, int y, int z) {
    const int bit = (x * n + y) * n + z;
    return (sub[static_cast<std::size_t>(bit / 64)] >> (bit % 64) & 1) != 0;
}

TEST(Occupancy, ACellIsSetIfASubvoxelInItIsOccupied) {
    CounterRandom random{5, 1};
    for (const int n : {1, 2, 4, 8}) {
        for (int round = 0; round < 200; ++round) {
            std::array<std::uint64_t, 8> sub{};
            for (int k = 0; k < 1 + round / 4; ++k) {
                const auto bit = static_cast<int>(random.next() % static_cast<unsigned>(n * n * n));
                sub[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{1} << (bit % 64);
            }
            std::uint64_t expected = 0;
            for (int i = 0; i < 64; ++i) { // with few subvoxels, the one that contains the cell
                for (int x = i / 16 * n / 4; x < (i / 16 * n + n + 3) / 4; ++x) {
                    for (int y = i / 4 % 4 * n / 4; y < (i / 4 % 4 * n + n + 3) / 4; ++y) {
                        for (int z = i % 4 * n / 4; z < (i % 4 * n + n + 3) / 4; ++z) {
                            if (has_subvoxel(sub, n, x, y, z)) {
                                expected |= cell_bit(i / 16, i / 4 % 4, i % 4);
                            }
                        }
                    }
                }
            }
            ASSERT_EQ(cells_of_subvoxels(sub.data(), n), expected) << n << " subvoxels";
        }
    }
}

/// Returns how many of four points of a face's cell (p, q) are in covered columns.
int covered_columns(std::uint64_t columns, int n, int p, int q) {
    int count = 0;
    for (int i = 0; i < 4; ++i) { // of four points in the cell
        const int a = (4 * p + 1 + 2 * (i & 1)) * n / 16;
        const int b = (4 * q + 1 + 2 * (i >> 1)) * n / 16;
        count += static_cast<int>(columns >> (b * n + a) & 1);
    }
    return count;
}

/// Returns the position of cell (x, y, z) on the face along an axis.
std::array<int, 2> on_face(int axis, int x, int y, int z) {
    return {axis == 0 ? y : x, axis == 2 ? y : z};
}

TEST(Occupancy, WhatOnlyColumnsSeeIsSetToo) {
    CounterRandom random{9, 1};
    for (const int n : {1, 2, 4, 8}) {
        for (int round = 0; round < 300; ++round) {
            std::array<std::uint64_t, 8> sub{};
            std::array<std::uint64_t, 3> columns{};
            const std::uint64_t bits =
                n == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << (n * n)) - 1;
            for (std::uint64_t& c : columns) {
                c = random.next() & bits;
                if (round % 3 == 0) c &= random.next();
            }
            const auto bit = static_cast<int>(random.next() % static_cast<unsigned>(n * n * n));
            sub[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{1} << (bit % 64);
            const std::uint64_t before = cells_of_subvoxels(sub.data(), n);
            std::uint64_t expected = before;
            for (int i = 0; i < 64; ++i) {
                const int x = i / 16, y = i / 4 % 4, z = i % 4;
                bool hole = false, seen = true;
                for (int axis = 0; axis < 3; ++axis) {
                    const auto [p, q] = on_face(axis, x, y, z);
                    const std::uint64_t face = columns[static_cast<std::size_t>(axis)];
                    bool behind = false;
                    for (int k = 0; k < 64; ++k) {
                        behind |= on_face(axis, k / 16, k / 4 % 4, k % 4) == std::array{p, q} &&
                                  (before >> k & 1) != 0;
                    }
                    hole |= covered_columns(face, n, p, q) >= 2 && !behind;
                    seen &= face == 0 || covered_columns(face, n, p, q) > 0;
                }
                if (hole && seen) expected |= cell_bit(x, y, z);
            }
            ASSERT_EQ(cells_of_voxel(sub.data(), columns.data(), n), expected) << n << " subvoxels";
        }
    }
}

TEST(Occupancy, AParentsCellIsSetIfAChildsCellInItIs) {
    for (int octant = 0; octant < 8; ++octant) {
        EXPECT_EQ(cells_in_parent(0, octant), 0u);
        for (int i = 0; i < 64; ++i) {
            const int x = i / 16, y = i / 4 % 4, z = i % 4;
            const int ox = octant / 4, oy = octant / 2 % 2, oz = octant % 2;
            EXPECT_EQ(cells_in_parent(cell_bit(x, y, z), octant),
                      cell_bit(2 * ox + x / 2, 2 * oy + y / 2, 2 * oz + z / 2));
        }
    }
}

TEST(Occupancy, CellsOfAParentDoNotDependOnTheOrderOfJoining) {
    CounterRandom random{6, 1};
    for (int round = 0; round < 100; ++round) {
        const std::uint64_t a = random.next() & random.next() & random.next();
        const std::uint64_t b = random.next() & random.next() & random.next();
        for (int octant = 0; octant < 8; ++octant) {
            EXPECT_EQ(cells_in_parent(a | b, octant),
                      cells_in_parent(a, octant) | cells_in_parent(b, octant));
        }
    }
    std::uint64_t all = 0;
    for (int octant = 0; octant < 8; ++octant) all |= cells_in_parent(1, octant);
    EXPECT_EQ(all, cell_bit(0, 0, 0) | cell_bit(0, 0, 2) | cell_bit(0, 2, 0) | cell_bit(0, 2, 2) |
                       cell_bit(2, 0, 0) | cell_bit(2, 0, 2) | cell_bit(2, 2, 0) |
                       cell_bit(2, 2, 2));
}

TEST(Spool, EveryArrayOfABlockComesBackAsItWas) {
    VoxelBlock block;
    std::size_t n = 3;
    VoxelBlock::for_each_array(block, [&](auto& array) { array.resize(n++); });
    block.occupancy.front() = 17;
    SpooledLevel level(".");
    level.resize(1);
    level.store(0, block);
    VoxelBlock scratch;
    const VoxelBlock& back = level.block(0, scratch);
    n = 3;
    VoxelBlock::for_each_array(back, [&](const auto& array) { EXPECT_EQ(array.size(), n++); });
    EXPECT_EQ(back.occupancy, block.occupancy);
}

} // namespace
} // namespace heddle
