#include <heddle/voxelize/test_leaf.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace heddle {
namespace {

using namespace heddle::test;

std::vector<std::vector<Vec3d>> turned_often(const DirectionSet& set, int turns) {
    CounterRandom random{9, 4};
    std::vector<std::vector<Vec3d>> voxels;
    for (int i = 0; i < turns; ++i) voxels.push_back(turned(set.directions, random));
    return voxels;
}

TEST(LeafFit, ALeafsFitKeepsThePooledMoment) {
    for (const DirectionSet& set : direction_sets()) {
        for (const std::vector<Vec3d>& directions : turned_often(set, 20)) {
            const SymmetricMatrix M = pool(directions);
            EXPECT_LT(difference(second_moment_of(fit_sggx(M)), M), 1e-4) << set.name;
        }
    }
}

TEST(LeafFit, AVoxelStoresThePackedFitOfItsDirections) {
    for (const DirectionSet& set : direction_sets()) {
        const std::vector<std::vector<Vec3d>> voxels = turned_often(set, 20);
        const std::vector<Lobe> lobes = voxelize_directions(voxels);
        for (std::size_t i = 0; i < lobes.size(); ++i) {
            const SggxMatrix stored = unpack(lobes[i].sggx);
            EXPECT_GT(decompose(stored).value[2], 0.0) << set.name;
            // sums in fixed point may round a byte the other way: no more than that
            const SggxMatrix expected = unpack(pack(fit_sggx(pool(voxels[i]))));
            EXPECT_LT(difference(stored, expected), 0.012) << set.name;
        }
    }
}

/// Two crossed bundles in one voxel.
Geometry crossing() {
    CurveSet curves;
    curves.basis = Basis::Linear;
    curves.default_radius = 0.01f;
    for (int i = 0; i < 6; ++i) {
        const float at = 0.2f + 0.1f * static_cast<float>(i);
        add_curve(curves, {{0.1f, at, 0.4f}, {0.9f, at, 0.4f}});
        add_curve(curves, {{at, 0.1f, 0.6f}, {at, 0.9f, 0.6f}});
    }
    return geometry_of(curves);
}

TEST(LeafFit, FitLastKeepsOneDirection) {
    VoxelizeOptions options;
    options.voxel_size = {1.0, 1.0, 1.0};
    const auto middle_sigma = [&](FitMode fit) {
        options.fit = fit;
        double found = -1.0;
        for_each_voxel(*voxelize_now(crossing(), options), [&](const BlockVoxel& v) {
            EXPECT_EQ(v.lobes().size(), 1u);
            found = std::sqrt(decompose(unpack(v.lobes()[0].sggx)).value[1]);
        });
        return found;
    };
    EXPECT_GT(middle_sigma(FitMode::Moments), 0.5);
    EXPECT_LT(middle_sigma(FitMode::Last), 0.01);
}

} // namespace
} // namespace heddle
