#include <heddle/base/progress.h>
#include <heddle/io/vdb/test_levels.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/test_grid.h>

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <filesystem>

namespace heddle {
namespace {

// The view of another program: OpenVDB, without Heddle's reader.

struct PlainGrids {
    openvdb::FloatGrid::Ptr density;
    openvdb::Vec3SGrid::Ptr tangent;
};

PlainGrids write_and_read(const MemoryLevel& grid) {
    const auto path = std::filesystem::temp_directory_path() / "heddle_plain_openvdb.vdb";
    Progress progress;
    write_vdb(grid, path.string(), progress);

    openvdb::initialize();
    openvdb::io::File file(path.string());
    file.open(/*delayLoad=*/false);
    PlainGrids grids;
    grids.density = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density"));
    grids.tangent = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.readGrid("tangentu"));
    file.close();
    std::filesystem::remove(path);
    return grids;
}

TEST(PlainOpenVdb, DensityAndTangentStandWhereTheVoxelsAre) {
    MemoryLevel grid = testing::make_helix(12.0, 2.0, 1);
    grid.info().lattice.voxel_size = {0.5, 0.25, 2.0};
    const auto [density, tangent] = write_and_read(grid);

    EXPECT_EQ(density->getGridClass(), openvdb::GRID_FOG_VOLUME);
    EXPECT_EQ(density->activeVoxelCount(), static_cast<openvdb::Index64>(grid.info().voxel_count));
    EXPECT_EQ(tangent->activeVoxelCount(), density->activeVoxelCount());
    const openvdb::Vec3d corner_voxel = density->indexToWorld(openvdb::Coord(0, 0, 0));
    EXPECT_EQ(corner_voxel, openvdb::Vec3d(0.25, 0.125, 1.0)); // the centre of [0, 0.5] x ...

    const double cap = 1.0 - 0.5 / 64.0;
    for (const VoxelBlock& block : grid.blocks) {
        std::size_t v = 0;
        for (const VoxelLeaf& leaf : block.leaves) {
            for (int i = 0; i < 512; ++i) {
                if (((leaf.active[static_cast<std::size_t>(i >> 6)] >> (i & 63)) & 1) == 0)
                    continue;
                const Vec3i at = leaf.origin + Vec3i{i >> 6, (i >> 3) & 7, i & 7};
                const openvdb::Coord xyz(at.x, at.y, at.z);
                const double c = std::min(block.coverage[v].x / 65535.0, cap);
                const double want = -std::log(1.0 - c) * (1 / 0.5 + 1 / 0.25 + 1 / 2.0) / 3.0;
                ASSERT_NEAR(density->tree().getValue(xyz), want, 1e-4);
                const openvdb::Vec3s d = tangent->tree().getValue(xyz);
                const Vec3f p = principal_direction(unpack(block.lobes[v].sggx));
                ASSERT_NEAR(std::abs(d.x() * p.x + d.y() * p.y + d.z() * p.z), 1.0, 2e-3);
                ++v;
            }
        }
    }
}

TEST(PlainOpenVdb, DensityOfLevelTwoStandsOnItsCoarserLattice) {
    const auto path = std::filesystem::temp_directory_path() / "heddle_plain_levels.vdb";
    const VoxelLevels levels = testing::make_levels(3);
    MemoryLevel& coarse = testing::grid_of(levels, 2);
    coarse.blocks[0].coverage[0] = {65535, 65535, 65535, 65535};
    Progress progress;
    write_vdb(levels, path.string(), progress);

    openvdb::initialize();
    openvdb::io::File file(path.string());
    file.open(/*delayLoad=*/false);
    const auto density = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density_level_2"));
    file.close();
    std::filesystem::remove(path);

    EXPECT_EQ(density->getGridClass(), openvdb::GRID_FOG_VOLUME);
    EXPECT_EQ(density->activeVoxelCount(),
              static_cast<openvdb::Index64>(coarse.info().voxel_count));
    const Vec3d h = levels[0]->info().lattice.voxel_size * 4.0;
    const openvdb::Vec3d at = density->indexToWorld(openvdb::Coord(3, -1, 0));
    EXPECT_EQ(at, openvdb::Vec3d(3.5 * h.x, -0.5 * h.y, 0.5 * h.z));
    const VoxelLeaf& leaf = coarse.blocks[0].leaves[0];
    int first = 0;
    while (((leaf.active[static_cast<std::size_t>(first >> 6)] >> (first & 63)) & 1) == 0) ++first;
    const Vec3i o = leaf.origin;
    const float full = density->tree().getValue(
        openvdb::Coord(o.x + (first >> 6), o.y + ((first >> 3) & 7), o.z + (first & 7)));
    const double cap = 0.5 / (16.0 * 16.0); // of 4 x 4 subvoxels at level 0
    EXPECT_NEAR(full, -std::log(cap) * (1 / h.x + 1 / h.y + 1 / h.z) / 3.0, 1e-4);
}

TEST(PlainOpenVdb, VoxelsOfMicrometresKeepTheirSize) {
    for (const Vec3d size : {Vec3d{2e-6, 2e-6, 2e-6}, Vec3d{2e-6, 1e-6, 4e-6}}) {
        MemoryLevel grid = testing::make_helix(4.0, 1.0, 1);
        grid.info().lattice.voxel_size = size;
        const auto density = write_and_read(grid).density;
        const openvdb::Vec3d at = density->indexToWorld(openvdb::Coord(10, 20, 30));
        EXPECT_DOUBLE_EQ(at.x(), 10.5 * size.x);
        EXPECT_DOUBLE_EQ(at.y(), 20.5 * size.y);
        EXPECT_DOUBLE_EQ(density->worldToIndex(at).z(), 30.0);
    }
}

} // namespace
} // namespace heddle
