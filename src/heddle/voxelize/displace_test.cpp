#include <heddle/voxelize/triangle/displace.h>

#include <heddle/base/random.h>
#include <heddle/surface/average_normals.h>

#include <gtest/gtest.h>

#include <map>
#include <tuple>

namespace heddle {
namespace {

constexpr SubvoxelBox kEverywhere{{-(1 << 30), -(1 << 30), -(1 << 30)},
                                  {1 << 30, 1 << 30, 1 << 30}};

// An octahedron's faces split n x n, pushed onto a sphere with random radii: triangles of all
// sizes.
Mesh bumpy_sphere(int n, float radius, std::uint64_t seed) {
    Mesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> index;
    CounterRandom random{seed, 1};
    const auto vertex = [&](int x, int y, int z) {
        const auto [at, fresh] =
            index.try_emplace({x, y, z}, static_cast<std::uint32_t>(mesh.positions.size()));
        if (fresh) {
            const Vec3f d = normalize(
                Vec3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
            const float r = radius * (0.7f + 0.6f * random.uniform());
            mesh.positions.push_back(d * r);
            mesh.uvs.push_back({d.x, d.y + 0.3f * d.z});
        }
        return at->second;
    };
    for (int face = 0; face < 8; ++face) {
        const int sx = face & 1 ? -1 : 1, sy = face & 2 ? -1 : 1, sz = face & 4 ? -1 : 1;
        const auto at = [&](int a, int b) { return vertex(sx * a, sy * b, sz * (n - a - b)); };
        const bool flip = sx * sy * sz < 0;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            mesh.triangles.push_back(flip ? std::array{a, c, b} : std::array{a, b, c});
        };
        for (int a = 0; a < n; ++a)
            for (int b = 0; a + b < n; ++b) {
                add(at(a, b), at(a + 1, b), at(a, b + 1));
                if (a + b + 1 < n) add(at(a + 1, b), at(a + 1, b + 1), at(a, b + 1));
            }
    }
    mesh.normals = average_normals(mesh);
    return mesh;
}

DisplaceTriangle triangle_of(const Mesh& mesh, std::size_t i) {
    DisplaceTriangle t;
    for (std::size_t v = 0; v < 3; ++v) {
        const std::uint32_t at = mesh.triangles[i][v];
        t.p[v] = mesh.positions[at];
        t.normal[v] = mesh.normals[at];
        t.uv[v] = mesh.uvs[at];
    }
    return t;
}

// A rough height in [-1.5, 1.5], without a useful derivative.
float rough_height(Uv uv) {
    const float x = 23.0f * uv.u + 1.7f * uv.v, y = 31.0f * uv.v - 2.0f * uv.u;
    return 1.5f * (std::abs(x - std::floor(x) - 0.5f) + std::abs(y - std::floor(y) - 0.5f)) - 0.75f;
}

template <typename Hit>
void scan_displaced(const DisplaceTriangle& t, Vec3d size, const SubvoxelBox& box, const Hit& hit) {
    DisplaceScratch scratch;
    displace_triangle(
        t, size, 1.5, box, rough_height,
        [&](const MicroTriangle& m) {
            scan_triangle(prepare_triangle(m.p[0], m.p[1], m.p[2]), box,
                          [&](int axis, std::int32_t i, std::int32_t j, std::int32_t k, float,
                              float, float) { hit(axis, i, j, k); });
        },
        scratch);
}

TEST(Displace, AClosedMeshStaysClosed) {
    for (const int n : {2, 7, 30}) {
        const Mesh mesh = bumpy_sphere(n, 20.0f, 5);
        const Vec3d size{1.0, 0.8, 1.3};
        std::map<std::tuple<int, int, int>, int> lines;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            scan_displaced(triangle_of(mesh, i), size, kEverywhere,
                           [&](int axis, std::int32_t x, std::int32_t y, std::int32_t z) {
                               const std::int32_t at[3] = {x, y, z};
                               ++lines[{axis, at[(axis + 1) % 3], at[(axis + 2) % 3]}];
                           });
        EXPECT_GT(lines.size(), 2000u);
        for (const auto& [line, count] : lines) ASSERT_EQ(count % 2, 0);
    }
}

TEST(Displace, BoxesThatTileSpaceShareOutTheSameHits) {
    const Mesh mesh = bumpy_sphere(3, 40.0f, 6);
    const Vec3d size{1.0, 0.8, 1.3};
    using Hit = std::array<std::int32_t, 4>;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 7) {
        std::vector<Hit> whole, parts;
        const auto into = [](std::vector<Hit>& hits) {
            return [&hits](int axis, std::int32_t x, std::int32_t y, std::int32_t z) {
                hits.push_back({axis, x, y, z});
            };
        };
        scan_displaced(triangle_of(mesh, i), size, kEverywhere, into(whole));
        constexpr int kEdge = 16;
        for (int x = -64; x < 64; x += kEdge)
            for (int y = -96; y < 96; y += kEdge)
                for (int z = -64; z < 64; z += kEdge)
                    scan_displaced(triangle_of(mesh, i), size,
                                   {{x, y, z}, {x + kEdge, y + kEdge, z + kEdge}}, into(parts));
        std::sort(whole.begin(), whole.end());
        std::sort(parts.begin(), parts.end());
        EXPECT_GT(whole.size(), 100u);
        ASSERT_EQ(whole, parts);
    }
}

TEST(Displace, MicroTrianglesAreNoLongerThanASubvoxelAndTileTheTriangle) {
    const DisplaceTriangle t{{Vec3f{0, 0, 0}, Vec3f{30.5f, 2, 0}, Vec3f{4, 11.3f, 0}},
                             {Vec3f{0, 0, 1}, Vec3f{0, 0, 1}, Vec3f{0, 0, 1}},
                             {}};
    double area = 0.0, longest = 0.0;
    std::int64_t count = 0;
    DisplaceScratch scratch;
    displace_triangle(
        t, {1, 1, 1}, 2.0, kEverywhere, [](Uv) { return 2.0f; },
        [&](const MicroTriangle& m) {
            for (std::size_t v = 0; v < 3; ++v) {
                longest = std::max(longest, length(m.p[(v + 1) % 3] - m.p[v]));
                ASSERT_EQ(m.p[v].z, 2.0);
                const Vec3f back = t.p[1] * m.b[v].y + t.p[2] * m.b[v].z;
                ASSERT_NEAR(back.x, m.p[v].x, 1e-4);
            }
            area += 0.5 * cross(m.p[1] - m.p[0], m.p[2] - m.p[0]).z;
            ++count;
        },
        scratch);
    const std::int64_t rows = displace_detail::Grid(t, {1, 1, 1}).rows();
    EXPECT_EQ(count, rows * rows);
    EXPECT_NEAR(area, 0.5 * (30.5 * 11.3 - 2.0 * 4.0), 1e-4);
    EXPECT_LE(longest, 1.5); // 1 inside; half an edge point's step more along the borders
}

TEST(Displace, HeightMovesAlongTheNormalByItsAmount) {
    const DisplaceTriangle t{{Vec3f{0, 0, 0}, Vec3f{16, 0, 0}, Vec3f{0, 16, 0}},
                             {Vec3f{0, 0, 1}, Vec3f{0, 0, 1}, Vec3f{0, 0, 1}},
                             {Uv{0, 0}, Uv{1, 0}, Uv{0, 1}}};
    DisplaceScratch scratch;
    std::size_t seen = 0;
    displace_triangle(
        t, {1, 1, 0.5}, 3.0, kEverywhere, [](Uv uv) { return 1.0f + 2.0f * uv.u; },
        [&](const MicroTriangle& m) {
            for (const Vec3d& p : m.p) ASSERT_NEAR(p.z, (1.0 + p.x / 8.0) / 0.5, 1e-5);
            ++seen;
        },
        scratch);
    EXPECT_GT(seen, 256u);
}

TEST(Displace, AverageNormalsJoinVerticesAtOnePlace) {
    Mesh mesh; // two sides of a roof with vertices of their own along the ridge
    mesh.positions = {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {2, 0, 0}, {1, 1, 1}, {1, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    const std::vector<Vec3f> n = average_normals(mesh);
    EXPECT_EQ(n[1], n[5]);
    EXPECT_EQ(n[2], n[4]);
    EXPECT_NEAR(std::abs(n[1].z), 1.0f, 1e-6f);
    EXPECT_NEAR(n[0].x, -n[3].x, 1e-6f);
}

} // namespace
} // namespace heddle
