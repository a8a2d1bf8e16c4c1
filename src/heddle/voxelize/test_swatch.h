#pragma once

#include <heddle/base/random.h>
#include <heddle/geom/generate.h>
#include <heddle/voxelize/test_voxelize.h>

#include <gtest/gtest.h>

#include <map>
#include <tuple>

// A geometry whose voxels have all kinds of data, and functions to compare results.

namespace heddle::test {

/// A knitted swatch of plied yarn and tapered hair with colours, two materials.
inline const Geometry& swatch() {
    static const Geometry geometry = [] {
        GenerateOptions knit;
        knit.nx = 3;
        knit.ny = 3;
        Geometry g = generate(knit);
        g.materials.resize(2);
        for (Material& m : g.materials) m.kind = MaterialKind::Fiber;
        YarnType yarn;
        yarn.model = YarnModel::Procedural;
        yarn.fiber_radius = 0.05f;
        yarn.plies = 2;
        yarn.fibers_per_ply = 16;
        yarn.ply_offset = 0.5f;
        yarn.ellipse_long = yarn.ellipse_short = 0.45f;
        yarn.ply_pitch = 6.0f;
        yarn.fiber_pitch = 3.0f;
        g.yarns.push_back(yarn);
        g.curves[0].yarn = 0;
        GenerateOptions hair;
        hair.kind = GenerateKind::Hair;
        hair.nx = 200;
        hair.ny = 8;
        Geometry strands = generate(hair);
        strands.curves[0].material = 1;
        for (std::size_t i = 0; i < strands.curves[0].points.size(); ++i) {
            strands.curves[0].color.push_back(static_cast<std::uint32_t>(hash64(3, i) & 0xffffff));
        }
        g.curves.push_back(strands.curves[0]);
        return g;
    }();
    return geometry;
}

/// The swatch with flyaways: hairs and loops.
inline Geometry hairy_swatch() {
    Geometry g = swatch();
    YarnType& y = g.yarns[0];
    y.flyaways = true;
    y.migration = true;
    y.migration_min = 0.5f;
    y.migration_frequency = 1.5f;
    y.hair_density = 3.0f;
    y.hair_ze = {0.5f, 0.2f};
    y.hair_r0 = {0.3f, 0.1f};
    y.hair_re = {0.4f, 0.1f};
    y.hair_pe = {0.5f, 0.2f};
    y.loop_density = 2.0f;
    y.loop_r1 = {0.8f, 0.2f};
    return g;
}

using Key = std::tuple<int, int, int>;
/// All stored data of a voxel.
struct Content {
    Coverage coverage;
    std::vector<Lobe> lobes;
    std::vector<LobeMaps> maps;
    std::uint32_t merge_order = 0;
    std::array<std::uint64_t, 3> footprints{};
    std::array<std::uint8_t, 3> correlation{};
    std::uint64_t occupancy = 0;
    PlaneSlab slab{};
    friend bool operator==(const Content&, const Content&) = default;
};

inline std::map<Key, Content> content_of(const VoxelLevel& source) {
    std::map<Key, Content> content;
    for_each_voxel(source, [&](const BlockVoxel& v) {
        content[{v.at.x, v.at.y, v.at.z}] = {v.coverage(),
                                             {v.lobes().begin(), v.lobes().end()},
                                             {v.maps().begin(), v.maps().end()},
                                             v.merge_order(),
                                             v.footprints(),
                                             v.correlation(),
                                             v.occupancy(),
                                             v.slab()};
    });
    EXPECT_EQ(static_cast<std::int64_t>(content.size()), source.info().voxel_count);
    return content;
}

/// Expects that two blocks store the same, byte for byte.
inline void expect_same_block(const VoxelBlock& a, const VoxelBlock& b) {
    ASSERT_EQ(a.leaves.size(), b.leaves.size());
    for (std::size_t i = 0; i < a.leaves.size(); ++i) {
        ASSERT_EQ(a.leaves[i].origin, b.leaves[i].origin);
        ASSERT_EQ(a.leaves[i].active, b.leaves[i].active);
        ASSERT_EQ(a.leaves[i].first_voxel, b.leaves[i].first_voxel);
        ASSERT_EQ(a.leaves[i].first_lobe, b.leaves[i].first_lobe);
    }
    ASSERT_TRUE(a.coverage == b.coverage);
    ASSERT_TRUE(a.lobe_count == b.lobe_count);
    ASSERT_TRUE(a.lobes == b.lobes);
    ASSERT_TRUE(a.maps == b.maps);
    ASSERT_TRUE(a.tangents == b.tangents);
    ASSERT_TRUE(a.merge_order == b.merge_order);
    ASSERT_TRUE(a.columns == b.columns);
    ASSERT_TRUE(a.moments == b.moments);
    ASSERT_TRUE(a.map_sums == b.map_sums);
    ASSERT_TRUE(a.footprints == b.footprints);
    ASSERT_TRUE(a.correlation == b.correlation);
    ASSERT_TRUE(a.occupancy == b.occupancy);
    ASSERT_TRUE(a.slabs == b.slabs);
}

} // namespace heddle::test
