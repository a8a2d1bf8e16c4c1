#include <heddle/voxelize/triangle/gather_triangles.h>

#include <heddle/base/parallel.h>
#include <heddle/geom/generate.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/leaf_voxels.h>
#include <heddle/voxelize/voxelize.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace heddle {
namespace {

/// A voxel of the result.
struct Found {
    Coverage coverage;
    std::vector<Lobe> lobes;
    std::vector<LobeMaps> maps;
    std::vector<PackedSggx> tangents;
    PlaneSlab slab{};

    friend bool operator==(const Found& a, const Found& b) {
        const auto same = [](const PackedSggx& p, const PackedSggx& q) {
            return std::equal(p.sigma, p.sigma + 3, q.sigma) && std::equal(p.r, p.r + 3, q.r);
        };
        return a.coverage == b.coverage && a.slab == b.slab && a.lobes == b.lobes &&
               a.maps == b.maps &&
               std::equal(a.tangents.begin(), a.tangents.end(), b.tangents.begin(),
                          b.tangents.end(), same);
    }
};
using FoundVoxels = std::map<std::tuple<int, int, int>, Found>;

template <typename T>
std::vector<T> part(const std::vector<T>& all, std::size_t first, std::size_t count) {
    if (all.empty()) return {};
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

void collect(const VoxelBlock& block, FoundVoxels& out) {
    for_each_voxel(block, [&](const BlockVoxel& v) {
        const std::size_t n = v.lobe_count();
        out[{v.at.x, v.at.y, v.at.z}] = {v.coverage(), part(block.lobes, v.lobe, n),
                                         part(block.maps, v.lobe, n),
                                         part(block.tangents, v.lobe, n), v.slab()};
    });
}

FoundVoxels run(const Geometry& geometry, const VoxelizeOptions& options) {
    Progress progress;
    const VoxelizePlan plan = plan_voxelize(geometry, options);
    const auto source = voxelize(geometry, options, plan, progress);
    FoundVoxels out;
    VoxelBlock scratch;
    for (std::size_t i = 0; i < source->block_count(); ++i) collect(source->block(i, scratch), out);
    return out;
}

VoxelizeOptions voxels_of(double size, int subvoxels = 8) {
    VoxelizeOptions options;
    options.voxel_size = {size, size, size};
    options.subvoxels = subvoxels;
    return options;
}

/// Returns the sum of coverage x face area per axis.
Vec3d covered_area(const FoundVoxels& voxels, Vec3d h) {
    Vec3d sum;
    for (const auto& [at, v] : voxels) {
        sum = sum +
              Vec3d{v.coverage.x * h.y * h.z, v.coverage.y * h.z * h.x, v.coverage.z * h.x * h.y} *
                  (1.0 / 65535.0);
    }
    return sum;
}

Mesh quad(Vec3f corner, Vec3f u, Vec3f v, std::uint32_t material = 0) {
    Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = material;
    return mesh;
}

Mesh sphere(float radius, Vec3f center) {
    constexpr int kRings = 64;
    constexpr int kSides = 128;
    Mesh mesh;
    for (int i = 0; i <= kRings; ++i) {
        for (int j = 0; j < kSides; ++j) {
            const auto a = std::numbers::pi_v<float> * static_cast<float>(i) / kRings;
            const auto b = 2.0f * std::numbers::pi_v<float> * static_cast<float>(j) / kSides;
            mesh.positions.push_back(
                center +
                Vec3f{std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)} * radius);
        }
    }
    for (std::uint32_t i = 0; i < kRings; ++i) {
        for (std::uint32_t j = 0; j < kSides; ++j) {
            const std::uint32_t p = i * kSides + j;
            const std::uint32_t q = i * kSides + (j + 1) % kSides;
            mesh.triangles.push_back({p, p + kSides, q});
            mesh.triangles.push_back({q, p + kSides, q + kSides});
        }
    }
    return mesh;
}

Geometry geometry_of(std::vector<Mesh> meshes, std::size_t materials = 1) {
    Geometry g;
    g.name = "test";
    g.meshes = std::move(meshes);
    g.materials.resize(materials);
    return g;
}

/// Second moment of a stored lobe.
SymmetricMatrix moment_of(const PackedSggx& p) {
    return second_moment_of(unpack(p));
}

TEST(TriangleGatherer, ATriangleCoversItsProjectionAlongEveryAxis) {
    Mesh mesh;
    mesh.positions = {{0.13f, -0.22f, 0.41f}, {7.3f, 1.9f, 2.6f}, {2.2f, 6.8f, -3.1f}};
    mesh.triangles = {{0, 1, 2}};
    const Vec3d n = to_double(cross(mesh.positions[1] - mesh.positions[0],
                                    mesh.positions[2] - mesh.positions[0])) *
                    0.5;
    const Geometry g = geometry_of({mesh});
    for (const int subvoxels : {1, 2, 4, 8}) {
        const double size = 0.02 * subvoxels;
        const Vec3d area = covered_area(run(g, voxels_of(size, subvoxels)), {size, size, size});
        EXPECT_NEAR(area.x, std::abs(n.x), 0.002 * std::abs(n.x)) << subvoxels;
        EXPECT_NEAR(area.y, std::abs(n.y), 0.002 * std::abs(n.y)) << subvoxels;
        EXPECT_NEAR(area.z, std::abs(n.z), 0.002 * std::abs(n.z)) << subvoxels;
    }
}

TEST(TriangleGatherer, ASphereCoversTwiceItsDiscAndPointsEverywhere) {
    const Geometry g = geometry_of({sphere(1.0f, {0.31f, -0.17f, 0.05f})});
    const FoundVoxels voxels = run(g, voxels_of(0.05));
    const double disc = 2.0 * 64 * std::sin(2.0 * std::numbers::pi / 128) / 2.0; // of 128 sides
    const Vec3d area = covered_area(voxels, {0.05, 0.05, 0.05});
    EXPECT_NEAR(area.y, 2.0 * disc, 0.01 * disc);
    EXPECT_NEAR(area.x, area.y, 0.01 * disc);
    EXPECT_NEAR(area.z, area.y, 0.01 * disc);
    for (const auto& [at, v] : voxels) {
        const auto [x, y, z] = at;
        const Vec3d from{(x + 0.5) * 0.05 - 0.31, (y + 0.5) * 0.05 + 0.17, (z + 0.5) * 0.05 - 0.05};
        const Vec3f n = to_float(normalize(from));
        ASSERT_EQ(v.lobes.size(), 1u);
        const SymmetricMatrix m = moment_of(v.lobes[0].sggx);
        const float along = n.x * n.x * m.xx + n.y * n.y * m.yy + n.z * n.z * m.zz +
                            2 * (n.x * n.y * m.xy + n.x * n.z * m.xz + n.y * n.z * m.yz);
        EXPECT_GT(along, 0.97f);
    }
}

TEST(TriangleGatherer, AnAlignedPlateHasOneNarrowNormalLobe) {
    const Geometry g = geometry_of({quad({0, 0, 0.4f}, {4, 0, 0}, {0, 4, 0})});
    const FoundVoxels voxels = run(g, voxels_of(1.0));
    ASSERT_EQ(voxels.size(), 16u);
    for (const auto& [at, v] : voxels) {
        EXPECT_EQ(v.coverage, (Coverage{0, 0, 65535, 8192}));
        ASSERT_EQ(v.lobes.size(), 1u);
        EXPECT_EQ(v.lobes[0].weight, 255);
        EXPECT_GT(moment_of(v.lobes[0].sggx).zz, 0.99f);
    }
}

TEST(TriangleGatherer, APlateOnTheLastFaceIsKept) {
    const Geometry g =
        geometry_of({quad({0, 0, 0}, {4, 0, 0}, {0, 4, 0}), quad({0, 0, 4}, {4, 0, 0}, {0, 4, 0})});
    EXPECT_DOUBLE_EQ(covered_area(run(g, voxels_of(0.5)), {0.5, 0.5, 0.5}).z, 32.0);
}

/// 2 x 1 texels: left and right.
Texture two_texels(std::array<std::uint8_t, 4> left, std::array<std::uint8_t, 4> right) {
    Texture t;
    t.width = 2;
    t.height = 1;
    t.channels = 4;
    for (const std::uint8_t byte : left) t.texels.push_back(byte);
    for (const std::uint8_t byte : right) t.texels.push_back(byte);
    return t;
}

/// A ball with vertex normals and a texture, so that hits are shaded in runs.
Geometry textured_ball() {
    const Vec3f center{0.3f, -0.2f, 0.1f};
    Geometry g = geometry_of({sphere(1.0f, center)});
    Mesh& mesh = g.meshes[0];
    for (const Vec3f& p : mesh.positions) {
        mesh.normals.push_back(normalize(p - center));
        mesh.uvs.push_back({p.x, p.y});
    }
    g.textures = {two_texels({255, 10, 40, 255}, {0, 90, 200, 255})};
    g.materials[0].albedo_map = 0;
    return g;
}

/// Returns the number of voxels of `whole` inside `box`, and expects all of them in `region`.
std::size_t expect_same_inside(const FoundVoxels& whole,
                               const FoundVoxels& region,
                               const Bounds& box,
                               double size) {
    std::size_t inside = 0;
    for (const auto& [at, v] : whole) {
        const auto [x, y, z] = at;
        const int index[3] = {x, y, z};
        bool in = true;
        for (int a = 0; a < 3; ++a) {
            in = in && index[a] * size >= box.lo[a] && (index[a] + 1) * size <= box.hi[a];
        }
        if (!in) continue;
        ++inside;
        const auto found = region.find(at);
        EXPECT_TRUE(found != region.end() && found->second == v) << x << ' ' << y << ' ' << z;
    }
    return inside;
}

TEST(TriangleGatherer, ARegionHasTheVoxelsOfTheWhole) {
    for (const bool textured : {false, true}) {
        Geometry g = textured_ball();
        if (!textured) g.meshes[0].normals.clear(), g.meshes[0].uvs.clear();
        for (const FitMode fit : {FitMode::Moments, FitMode::Last}) {
            VoxelizeOptions options = voxels_of(0.025, 4);
            options.fit = fit;
            const FoundVoxels whole = run(g, options);
            options.bounds = Bounds{{-0.35, -0.9, 0.2}, {0.41, 0.3, 0.93}};
            const FoundVoxels region = run(g, options);
            EXPECT_GT(expect_same_inside(whole, region, *options.bounds, 0.025), 400u);
            EXPECT_LT(region.size(), whole.size() / 2);
        }
    }
}

TEST(TriangleGatherer, OneThreadAndTwoGiveTheSameVoxels) {
    const Geometry g = generate({.kind = GenerateKind::Grass, .nx = 12});
    VoxelizeOptions options;
    options.voxels = 100;
    set_thread_count(1);
    const FoundVoxels one = run(g, options);
    set_thread_count(2);
    options.fit = FitMode::Last;
    const FoundVoxels last_two = run(g, options);
    options.fit = FitMode::Moments;
    EXPECT_EQ(run(g, options), one);
    set_thread_count(1);
    options.fit = FitMode::Last;
    EXPECT_EQ(run(g, options), last_two);
    EXPECT_NE(one, last_two);
    set_thread_count(0);
}

TEST(TriangleGatherer, TwoMaterialsInAVoxelKeepALobeEach) {
    const Geometry g = geometry_of(
        {quad({0, 0, 0.3f}, {4, 0, 0}, {0, 4, 0}, 1), quad({0, 0.4f, 0}, {4, 0, 0}, {0, 0, 4}, 0)},
        2);
    const FoundVoxels voxels = run(g, voxels_of(1.0));
    const Found& v = voxels.at({1, 0, 0});
    ASSERT_EQ(v.lobes.size(), 2u);
    EXPECT_EQ(v.lobes[0].material + v.lobes[1].material, 1);
    for (const Lobe& lobe : v.lobes) {
        const SymmetricMatrix m = moment_of(lobe.sggx);
        EXPECT_GT(lobe.material == 1 ? m.zz : m.yy, 0.99f);
        EXPECT_NEAR(lobe.weight, 127.5, 1.0);
    }
}

TEST(TriangleGatherer, LastKeepsOneDirectionOfTwo) {
    const Geometry g = geometry_of(
        {quad({0, 0, 0.3f}, {4, 0, 0}, {0, 4, 0}), quad({0, 0.4f, 0}, {4, 0, 0}, {0, 0, 4})});
    VoxelizeOptions options = voxels_of(1.0);
    EXPECT_NEAR(moment_of(run(g, options).at({1, 0, 0}).lobes[0].sggx).zz, 0.5f, 0.01f);
    options.fit = FitMode::Last;
    EXPECT_GT(moment_of(run(g, options).at({1, 0, 0}).lobes[0].sggx).yy, 0.99f);
}

TEST(TriangleGatherer, ABrushedPlateKeepsItsBrushing) {
    Mesh mesh = quad({0, 0, 0.4f}, {4, 0, 0}, {0, 4, 0});
    mesh.normals.assign(4, {0, 0, 1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    Geometry g = geometry_of({mesh});
    g.materials[0].anisotropy = 0.8f;
    g.materials[0].anisotropy_rotation = std::numbers::pi_v<float> / 2;
    const FoundVoxels voxels = run(g, voxels_of(1.0));
    ASSERT_EQ(voxels.size(), 16u);
    for (const auto& [at, v] : voxels) {
        EXPECT_GT(moment_of(v.lobes[0].sggx).zz, 0.99f);
        ASSERT_EQ(v.tangents.size(), 1u);
        EXPECT_GT(moment_of(v.tangents[0]).yy, 0.99f);
    }
}

TEST(TriangleGatherer, AnAlphaMaskCutsHalfOfThePlateAway) {
    Geometry g = geometry_of({quad({0, 0, 0.4f}, {8, 0, 0}, {0, 8, 0})});
    g.textures = {two_texels({255, 255, 255, 255}, {255, 255, 255, 0})};
    g.materials[0].albedo_map = 0;
    EXPECT_NEAR(covered_area(run(g, voxels_of(1.0)), {1, 1, 1}).z, 64.0, 1e-9);
    g.materials[0].alpha_mode = AlphaMode::Mask;
    const FoundVoxels voxels = run(g, voxels_of(1.0));
    EXPECT_NEAR(covered_area(voxels, {1, 1, 1}).z, 32.0, 1.0);
    EXPECT_LT(voxels.size(), 48u);
}

TEST(TriangleGatherer, AMaterialWithoutMapsReadsOneBesideOneWithMaps) {
    Geometry g = geometry_of(
        {quad({0, 0, 0.4f}, {4, 0, 0}, {0, 4, 0}, 0), quad({0, 0, 2.4f}, {4, 0, 0}, {0, 4, 0}, 1)},
        2);
    g.textures = {two_texels({51, 102, 204, 255}, {51, 102, 204, 255})};
    g.materials[1].albedo_map = 0;
    const FoundVoxels voxels = run(g, voxels_of(1.0));
    EXPECT_EQ(voxels.at({1, 1, 0}).maps.at(0), LobeMaps{});
    EXPECT_EQ(voxels.at({1, 1, 2}).maps.at(0).albedo, (std::array<std::uint8_t, 3>{51, 102, 204}));
    EXPECT_EQ(voxels.at({1, 1, 2}).maps.at(0).roughness, 255);
}

TEST(TriangleGatherer, ADisplacedPlateMovesByItsHeightAcrossBlocks) {
    Geometry g = geometry_of({quad({0, 0, 0.4f}, {2, 0, 0}, {0, 2, 0})});
    g.textures = {two_texels({128, 128, 128, 255}, {128, 128, 128, 255})};
    g.materials[0].height_map = 0;
    g.materials[0].height_scale = 5.0f; // x 128 / 255
    const FoundVoxels voxels = run(g, voxels_of(0.08, 2));
    const double z = 0.4 + 5.0 * 128.0 / 255.0;
    for (const auto& [at, v] : voxels) EXPECT_EQ(std::get<2>(at), static_cast<int>(z / 0.08));
    EXPECT_NEAR(covered_area(voxels, {0.08, 0.08, 0.08}).z, 4.0, 0.04);
}

} // namespace
} // namespace heddle
