#include <heddle/render/volume/test_volume.h>
#include <heddle/render/volume/traversal_level.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::testing;

VoxelMap scattered_voxels() {
    VoxelMap voxels;
    StreamRandom random{5};
    add_random(voxels, random, {-20, -20, -20}, 40, 1500, 0.9);
    add_random(voxels, random, {1000, -3000, 64}, 20, 200, 0.9);
    add_random(voxels, random, {-70000, 70000, -8}, 8, 60, 0.9);
    return voxels;
}

const TraversalVoxel* find(const TraversalLevel& level, Vec3i at) {
    const TraversalLevel::LeafLookup place = level.find_leaf(at);
    if (place.leaf == nullptr) return nullptr;
    const std::int64_t v = place.leaf->find(at);
    return v < 0 ? nullptr : &level.voxel(v);
}

TEST(VolumeLevel, FindsEveryVoxelAndNoOther) {
    const VoxelMap voxels = scattered_voxels();
    const auto level = level_of(voxels);
    StreamRandom random{9};
    for (const auto& [at, voxel] : voxels) {
        const auto [x, y, z] = at;
        const TraversalVoxel* found = find(*level, {x, y, z});
        ASSERT_NE(found, nullptr) << x << ' ' << y << ' ' << z;
        const double c = voxel.coverage.y / 65535.0;
        EXPECT_NEAR(found->depth[1] * static_cast<double>(kDepthUnit), -std::log1p(-c),
                    static_cast<double>(kDepthUnit));
        const int nx = x + static_cast<int>(random.next() % 5) - 2;
        const int nz = z + static_cast<int>(random.next() % 5) - 2;
        EXPECT_EQ(find(*level, {nx, y, nz}) != nullptr, voxels.contains({nx, y, nz}));
    }
}

TEST(VolumeLevel, LobesOfAVoxelAreItsOwn) {
    const VoxelMap voxels = scattered_voxels();
    const auto level = level_of(voxels);
    for (const auto& [at, voxel] : voxels) {
        const auto [x, y, z] = at;
        const TraversalLeaf& leaf = *level->find_leaf({x, y, z}).leaf;
        const auto range = level->lobes_of(leaf, leaf.find({x, y, z}));
        ASSERT_EQ(range.count, voxel.lobes.size());
        for (std::size_t l = 0; l < range.count; ++l) {
            EXPECT_EQ(level->lobe(range.first + l), voxel.lobes[l]);
        }
    }
}

TEST(VolumeLevel, EmptyPlacesAreEmpty) {
    const VoxelMap voxels = scattered_voxels();
    const auto level = level_of(voxels);
    StreamRandom random{11};
    for (int i = 0; i < 300; ++i) {
        const auto index = [&] { return static_cast<int>(random.next() % 200) - 100; };
        const Vec3i at{index(), index(), index()};
        const TraversalLevel::LeafLookup place = level->find_leaf(at);
        if (place.leaf != nullptr) continue;
        const int mask = ~(place.size - 1);
        const Vec3i lo{at.x & mask, at.y & mask, at.z & mask};
        const auto from = voxels.lower_bound({lo.x, INT32_MIN, INT32_MIN});
        const auto to = voxels.upper_bound({lo.x + place.size - 1, INT32_MAX, INT32_MAX});
        for (auto v = from; v != to; ++v) {
            const auto [x, y, z] = v->first;
            const bool inside =
                y >= lo.y && y < lo.y + place.size && z >= lo.z && z < lo.z + place.size;
            EXPECT_FALSE(inside) << x << ' ' << y << ' ' << z;
        }
    }
}

TEST(VolumeLevel, BoundsAreThoseOfTheVoxels) {
    VoxelMap voxels;
    voxels[{-9, 4, 130}] = even_voxel(0.5, {{needle({1, 0, 0}), 255, 0}});
    voxels[{3, -77, 5}] = even_voxel(0.5, {{needle({1, 0, 0}), 255, 0}});
    const auto level = level_of(voxels);
    EXPECT_EQ(level->lo(), (Vec3i{-9, -77, 5}));
    EXPECT_EQ(level->hi(), (Vec3i{4, 5, 131}));
    EXPECT_EQ(level_of({})->lo(), level_of({})->hi());
}

TEST(VolumeLevel, FullCoverageIsHalfAColumnShortOfOpaque) {
    VoxelMap voxels;
    voxels[{0, 0, 0}] = even_voxel(1.0, {{needle({1, 0, 0}), 255, 0}});
    for (const int l : {0, 3}) {
        const double columns = std::pow(8 << l, 2);
        const auto level = level_of(voxels, {1, 1, 1}, l);
        EXPECT_NEAR(find(*level, {0, 0, 0})->depth[0] * static_cast<double>(kDepthUnit),
                    std::log(2.0 * columns), 1e-3);
    }
}

} // namespace
} // namespace heddle
