#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/sggx/test_lobe.h>
#include <heddle/voxelize/test_tube.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace heddle {
namespace {

using namespace heddle::test;

using Key = std::tuple<int, int, int>;
struct Content {
    Coverage coverage;
    std::vector<Lobe> lobes;
    friend bool operator==(const Content&, const Content&) = default;
};

VoxelizeOptions unit_voxels() {
    VoxelizeOptions options;
    options.voxel_size = {1.0, 1.0, 1.0};
    return options;
}

std::map<Key, Content> content_of(const CurveSet& set) {
    std::map<Key, Content> content;
    for_each_voxel(*voxelize_now(geometry_of(set), unit_voxels()), [&](const BlockVoxel& v) {
        content[{v.at.x, v.at.y, v.at.z}] = {v.coverage(), {v.lobes().begin(), v.lobes().end()}};
    });
    return content;
}

TEST(FiberCurves, AClosedCurveIsTheSameFromAnyStart) {
    for (const Basis basis : {Basis::Linear, Basis::CatmullRom, Basis::CubicBSpline}) {
        for (const float radius : {0.05f, 0.6f}) {
            CurveSet ring = scattered(circle(12, basis), 1);
            ring.default_radius = radius;
            CurveSet rotated = ring;
            std::rotate(rotated.points.begin(), rotated.points.begin() + 5, rotated.points.end());
            const std::map<Key, Content> content = content_of(ring);
            EXPECT_GT(content.size(), 30u);
            EXPECT_TRUE(content == content_of(rotated));
        }
    }
}

TEST(FiberCurves, TheFibersOfAClosedYarnCloseToo) {
    constexpr std::size_t kSectors = 90;
    CurveSet ring = circle(16, Basis::CatmullRom);
    ring.yarn = 0;
    Geometry geometry = geometry_of(ring);
    YarnType yarn;
    yarn.model = YarnModel::Procedural;
    yarn.radius = 1.0f;
    yarn.fiber_radius = 0.1f;
    yarn.fibers_per_ply = 1;
    yarn.ply_offset = 0.6f;
    yarn.ellipse_long = yarn.ellipse_short = 0.3f;
    yarn.ply_pitch = 11.3f; // 2.8 turns: must become whole ones
    yarn.fiber_pitch = 9.1f;
    geometry.yarns.push_back(yarn);
    VoxelizeOptions options;
    options.voxel_size = {0.125, 0.125, 0.125};
    std::array<std::array<double, 3>, kSectors> sum{}; // weight, distance from the axis, height
    for_each_voxel(*voxelize_now(geometry, options), [&](const BlockVoxel& v) {
        const Vec3d p = Vec3d{v.at.x + 0.5, v.at.y + 0.5, v.at.z + 0.5} * 0.125;
        const double turn = std::atan2(p.y, p.x) / (2.0 * kPi) + 0.5; // the seam is at 0.5
        auto& s = sum[static_cast<std::size_t>(turn * kSectors) % kSectors];
        s[0] += v.coverage().occupancy;
        s[1] += v.coverage().occupancy * std::hypot(p.x, p.y);
        s[2] += v.coverage().occupancy * p.z;
    });
    std::vector<double> step;
    for (std::size_t i = 0; i < kSectors; ++i) {
        const auto& a = sum[i];
        const auto& b = sum[(i + 1) % kSectors];
        ASSERT_GT(a[0], 0.0) << "a gap at sector " << i;
        step.push_back(std::hypot(b[1] / b[0] - a[1] / a[0], b[2] / b[0] - a[2] / a[0]));
    }
    const double at_seam = std::max(step[kSectors / 2 - 1], step[kSectors / 2]);
    std::sort(step.begin(), step.end());
    EXPECT_LT(at_seam, 1.5 * step[kSectors * 9 / 10]);
    EXPECT_LT(step.back(), 2.5 * step[kSectors / 2] + 0.02);
}

/// A straight line with phantom points, which linear curves do without.
CurveSet straight(Basis basis) {
    CurveSet set;
    set.basis = basis;
    set.default_radius = 0.05f;
    std::vector<Vec3f> points;
    const int more = basis == Basis::Linear ? 0 : 1;
    for (int i = -more; i <= 8 + more; ++i) {
        points.push_back(Vec3f{0.31f, -4.2f, 1.7f} +
                         static_cast<float>(i) * Vec3f{3.1f, 1.7f, -2.3f});
    }
    add_curve(set, points);
    return set;
}

TEST(FiberCurves, EveryBasisGivesTheSameStraightLine) {
    const std::map<Key, Content> linear = content_of(straight(Basis::Linear));
    EXPECT_GT(linear.size(), 40u);
    for (const Basis basis : {Basis::CatmullRom, Basis::CubicBSpline}) {
        const std::map<Key, Content> cubic = content_of(straight(basis));
        double sum = 0.0;
        double off = 0.0;
        for (const auto& [key, content] : linear) {
            const auto other = cubic.find(key);
            ASSERT_TRUE(other != cubic.end());
            for (int a = 0; a < 3; ++a) {
                sum += covered(content.coverage, a);
                off += std::fabs(covered(content.coverage, a) - covered(other->second.coverage, a));
            }
            EXPECT_LT(
                difference(unpack(content.lobes[0].sggx), unpack(other->second.lobes[0].sggx)),
                0.02);
        }
        EXPECT_EQ(cubic.size(), linear.size());
        EXPECT_LT(off, 0.002 * sum); // a column's centre may lie within rounding of the border
    }
}

TEST(FiberCurves, AStrandTapersAsItsRadiiSay) {
    // 120 voxels long, from 4 subvoxels' diameter to 1, within one layer of voxels seen along z
    CurveSet set;
    set.basis = Basis::Linear;
    const Vec3d d = normalize(Vec3d{1.0, 0.37, 0.002});
    add_curve(set, {to_float(Vec3d{0.2, 0.3, 0.4}), to_float(Vec3d{0.2, 0.3, 0.4} + d * 120.0)});
    set.radius = {0.25f, 0.0625f};
    std::array<double, 4> found{};
    for_each_voxel(*voxelize_now(geometry_of(set), unit_voxels()), [&](const BlockVoxel& v) {
        const Vec3d p{v.at.x + 0.3, v.at.y + 0.2, v.at.z + 0.1};
        const auto quarter = static_cast<std::size_t>(std::clamp(dot(p, d) / 30.0, 0.0, 3.0));
        found[quarter] += covered(v.coverage(), 2);
    });
    const double sine = std::sqrt(1.0 - d.z * d.z);
    for (std::size_t q = 0; q < 4; ++q) {
        const double diameter = 0.5 - 0.375 * (static_cast<double>(q) + 0.5) / 4.0;
        // a voxel lies in one quarter as a whole: half of one at either end of 28
        EXPECT_NEAR(found[q] / (30.0 * sine * diameter), 1.0, 0.04) << q;
    }
}

TEST(FiberCurves, VertexColoursArriveInAlbedo) {
    CurveSet set;
    set.basis = Basis::Linear;
    set.default_radius = 0.02f;
    add_curve(set, {{0.1f, 0.4f, 0.5f}, {4.0f, 0.4f, 0.5f}, {8.0f, 0.4f, 0.5f}});
    add_curve(set, {{4.0f, 0.6f, 0.5f}, {8.0f, 0.6f, 0.5f}}); // beside the first's second half
    set.color = {0x0000ff, 0x00ff00, 0x00ff00, 0xff0000, 0xff0000}; // red in bits 0-7
    std::map<int, LobeMaps> maps;
    for_each_voxel(*voxelize_now(geometry_of(set), unit_voxels()), [&](const BlockVoxel& v) {
        ASSERT_EQ(v.maps().size(), 1u);
        maps[v.at.x] = v.maps()[0];
    });
    using Color = std::array<std::uint8_t, 3>;
    EXPECT_EQ(maps.at(2).albedo, (Color{255, 0, 0}));
    const Color mixed = maps.at(6).albedo; // green and blue in equal parts
    EXPECT_EQ(mixed[0], 0);
    EXPECT_NEAR(mixed[1], 127.5, 1.0);
    EXPECT_NEAR(mixed[2], 127.5, 1.0);
}

} // namespace
} // namespace heddle
