#pragma once

#include <heddle/base/random.h>
#include <heddle/io/file/test_files.h>
#include <heddle/voxel/test_grid.h>

#include <gtest/gtest.h>

#include <memory>

// Grids with all fields, and their comparison.

namespace heddle::testing {

/// A grid with 1 to 3 lobes, two kinds of material, all fields, negative indices and several nodes
/// of each size.
/// @param shifts  of clusters of 300 voxels, along all axes
inline MemoryLevel make_mixed(int block_voxels = 32,
                              const std::vector<int>& shifts = {-9000, -40, 0, 130, 5000}) {
    VoxelMap voxels;
    CounterRandom random{3, 1};
    for (const int shift : shifts) {
        for (int i = 0; i < 300; ++i) {
            const auto at = [&](int n) { return shift + static_cast<int>(random.next() % 40) * n; };
            const auto cover = [&] { return static_cast<std::uint16_t>(random.next()); };
            TestVoxel& v = voxels[{at(1), at(2), at(1)}];
            v.coverage = {cover(), cover(), cover(), cover()};
            v.lobes.clear();
            const int n = 1 + static_cast<int>(random.next() % 3);
            for (int l = 0; l < n; ++l) {
                const Vec3f d = normalize(Vec3f{random.uniform() - 0.5f, random.uniform() - 0.5f,
                                                random.uniform() - 0.5f});
                v.lobes.push_back({needle(d), static_cast<std::uint8_t>(200 - l * 60),
                                   static_cast<std::uint8_t>(random.next() % 2)});
            }
        }
    }
    MemoryLevel grid;
    grid.info().name = "mixed \"quoted\"";
    grid.info().lattice = {{0.1, 0.25, 0.3}, 4};
    grid.info().fields = {true, true, true};
    grid.info().materials.resize(2);
    grid.info().materials[0].name = "wool";
    grid.info().materials[0].kind = MaterialKind::Fiber;
    grid.info().materials[1].albedo = {0.1f, 0.2f, 0.3f};
    grid.info().yarns.resize(1);
    grid.info().yarns[0].plies = 3;
    grid.info().yarns[0].hair_ze = {0.1f, 0.7f};
    grid.info().command = "heddle voxelize a.bcc -o a.vdb";
    grid.blocks = make_blocks(voxels, block_voxels);
    add_fields(grid);
    count_voxels(grid);
    return grid;
}

/// Adds the arrays of levels to a grid whose `about` is complete: bytes that depend on the index of
/// the voxel or lobe, and valid merge orders.
inline void add_level_arrays(MemoryLevel& grid) {
    const VoxelFields& has = grid.info().fields;
    const bool masks = has.masks && grid.info().level == 0;
    CounterRandom random{11, static_cast<std::uint64_t>(grid.info().level)};
    const auto any = [&] { return static_cast<std::int64_t>(random.next()); };
    for (VoxelBlock& block : grid.blocks) {
        for (std::size_t v = 0; v < block.coverage.size(); ++v) {
            const std::uint64_t kept = has.footprints == 4 ? 0xffff : ~std::uint64_t{0};
            if (masks) block.columns.push_back({random.next(), random.next(), random.next()});
            if (has.footprints != 0) {
                block.footprints.push_back(
                    {random.next() & kept, random.next() & kept, random.next() & kept});
            }
            if (has.occupancy) block.occupancy.push_back(random.next());
            if (has.correlation) {
                const auto byte = [&] { return static_cast<std::uint8_t>(random.next()); };
                block.correlation.push_back({byte(), byte(), byte()});
            }
            if (has.slabs) {
                const auto lo = static_cast<std::uint8_t>(random.next() % 256);
                block.slabs.push_back({lo, static_cast<std::uint8_t>(lo + (255 - lo) / 2)});
            }
            block.merge_order.push_back(static_cast<std::uint32_t>(random.next() % 2));
        }
        for (std::size_t l = 0; l < block.lobes.size() && masks; ++l) {
            block.moments.push_back({{any(), any(), any(), any(), any(), any()}, any()});
            if (!has.map_sums()) continue;
            block.map_sums.push_back({{any(), any(), any(), any(), any(), any()},
                                      {any(), any(), any()},
                                      any(),
                                      any(),
                                      any()});
        }
    }
}

/// Levels with all fields. The coarser ones are not built from level 0.
inline VoxelLevels
make_levels(int count, std::int32_t footprints = 8, const std::vector<int>& shifts = {0}) {
    VoxelLevels levels;
    for (int level = 0; level < count; ++level) {
        auto grid = std::make_unique<MemoryLevel>(make_mixed(32, shifts));
        VoxelLevelInfo& about = grid->info();
        about.lattice = lattice_of_level(about.lattice, level);
        about.level = level;
        about.lod = "moments";
        about.fields.masks = about.fields.correlation = true;
        about.fields.slabs = true;
        about.fields.footprints = footprints;
        about.fields.occupancy = true;
        add_level_arrays(*grid);
        grid->blocks[0].coverage[0].x = static_cast<std::uint16_t>(level); // the levels differ
        levels.push_back(std::move(grid));
    }
    return levels;
}

inline MemoryLevel& grid_of(const VoxelLevels& levels, std::size_t i) {
    return dynamic_cast<MemoryLevel&>(*levels[i]);
}

using Leaves = std::map<std::tuple<int, int, int>, std::pair<const VoxelBlock*, const VoxelLeaf*>>;

inline Leaves leaves_of(const MemoryLevel& grid) {
    Leaves leaves;
    for (const VoxelBlock& b : grid.blocks) {
        for (const VoxelLeaf& l : b.leaves) {
            leaves[{l.origin.x, l.origin.y, l.origin.z}] = {&b, &l};
        }
    }
    return leaves;
}

template <typename T>
std::vector<T> slice(const std::vector<T>& all, std::size_t begin, std::size_t n) {
    if (all.empty()) return {};
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(begin);
    return std::vector<T>(from, from + static_cast<std::ptrdiff_t>(n));
}

/// Expects the same voxels in the same leaves, regardless of blocks.
inline void expect_same_voxels(const MemoryLevel& a, const MemoryLevel& b) {
    const Leaves left = leaves_of(a), right = leaves_of(b);
    ASSERT_EQ(left.size(), right.size());
    for (const auto& [origin, from] : left) {
        ASSERT_TRUE(right.contains(origin));
        const auto [p, l] = from;
        const auto [q, m] = right.at(origin);
        ASSERT_EQ(l->active, m->active);
        const std::size_t n = l->voxel_count();
        const auto counts = slice(p->lobe_count, l->first_voxel, n);
        EXPECT_EQ(slice(p->coverage, l->first_voxel, n), slice(q->coverage, m->first_voxel, n));
        ASSERT_EQ(counts, slice(q->lobe_count, m->first_voxel, n));
        std::size_t k = 0;
        for (const std::uint8_t c : counts) k += c;
        EXPECT_EQ(slice(p->lobes, l->first_lobe, k), slice(q->lobes, m->first_lobe, k));
        EXPECT_EQ(slice(p->maps, l->first_lobe, k), slice(q->maps, m->first_lobe, k));
        EXPECT_EQ(slice(p->tangents, l->first_lobe, k), slice(q->tangents, m->first_lobe, k));
        EXPECT_EQ(slice(p->moments, l->first_lobe, k), slice(q->moments, m->first_lobe, k));
        EXPECT_EQ(slice(p->map_sums, l->first_lobe, k), slice(q->map_sums, m->first_lobe, k));
        const auto of_voxels = [&](const auto& left_array, const auto& right_array) {
            return slice(left_array, l->first_voxel, n) == slice(right_array, m->first_voxel, n);
        };
        EXPECT_TRUE(of_voxels(p->columns, q->columns));
        EXPECT_TRUE(of_voxels(p->footprints, q->footprints));
        EXPECT_TRUE(of_voxels(p->correlation, q->correlation));
        EXPECT_TRUE(of_voxels(p->occupancy, q->occupancy));
        EXPECT_TRUE(of_voxels(p->slabs, q->slabs));
        for (std::size_t v = 0; v < n; ++v) {
            if (counts[v] < 3 || p->merge_order.empty()) continue;
            ASSERT_FALSE(q->merge_order.empty());
            EXPECT_EQ(p->merge_order[l->first_voxel + v], q->merge_order[m->first_voxel + v]);
        }
    }
}

} // namespace heddle::testing
