#include <heddle/io/mesh/tangents.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace heddle {
namespace {

constexpr Vec3f kUp{0.0f, 0.0f, 1.0f};

/// The unit square in the plane z = 0 with uv as in an image seen from above: u right, v down.
Mesh square() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.normals.assign(4, kUp);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

void expect_tangent(const Tangent& t, Vec3f direction, float sign) {
    EXPECT_NEAR(t.x, direction.x, 1e-6f);
    EXPECT_NEAR(t.y, direction.y, 1e-6f);
    EXPECT_NEAR(t.z, direction.z, 1e-6f);
    EXPECT_EQ(t.w, sign);
}

TEST(Tangents, AnUprightImageHasTangentsToTheRightAndBitangentsUp) {
    Mesh mesh = square();
    set_tangents(mesh);
    ASSERT_EQ(mesh.tangents.size(), 4u);
    for (const Tangent& t : mesh.tangents) expect_tangent(t, {1, 0, 0}, 1.0f);
}

TEST(Tangents, AMirroredImageTurnsTheSign) {
    Mesh mesh = square();
    for (Uv& uv : mesh.uvs) uv.u = -uv.u;
    set_tangents(mesh);
    for (const Tangent& t : mesh.tangents) expect_tangent(t, {-1, 0, 0}, -1.0f);
}

TEST(Tangents, AMirrorSeamSplitsItsVertices) {
    Mesh mesh = square(); // and its mirror image to the left, sharing the edge x = 0
    mesh.positions.insert(mesh.positions.end(), {{-1, 0, 0}, {-1, 1, 0}});
    mesh.uvs.insert(mesh.uvs.end(), {{1, 1}, {1, 0}});
    mesh.normals.resize(6, kUp);
    mesh.triangles.insert(mesh.triangles.end(), {{0, 3, 5}, {0, 5, 4}});
    set_tangents(mesh);
    ASSERT_EQ(mesh.positions.size(), 8u);
    ASSERT_EQ(mesh.tangents.size(), 8u);
    ASSERT_EQ(mesh.normals.size(), 8u);
    ASSERT_EQ(mesh.uvs.size(), 8u);
    for (std::size_t t = 0; t < 4; ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) {
            const float side = t < 2 ? 1.0f : -1.0f;
            expect_tangent(mesh.tangents[v], {side, 0, 0}, side);
        }
    }
}

TEST(Tangents, AreWeightedByTheAngleAtTheVertex) {
    // Two triangles meet at the origin with 90 and 45 degrees; their tangents differ by 45 degrees.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, kUp);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    // first: u = x, v = -y; the second shares the uv of the edge between them
    mesh.uvs = {{0, 0}, {1, 0}, {0, -1}, {-1, -2}};
    // second: u = x, v = x - y: along u at constant v is (1, 1) / sqrt 2
    set_tangents(mesh);
    const double a = std::numbers::pi / 2.0;
    const double b = std::numbers::pi / 4.0;
    const Vec3d sum{a + b * std::numbers::sqrt2 / 2.0, b * std::numbers::sqrt2 / 2.0, 0.0};
    expect_tangent(mesh.tangents[0], to_float(normalize(sum)), 1.0f);
}

TEST(Tangents, LieInTheTangentPlaneOfTheVertexNormal) {
    Mesh mesh = square();
    const Vec3f tilted = normalize(Vec3f{0.6f, 0.2f, 0.7f});
    mesh.normals.assign(4, tilted);
    set_tangents(mesh);
    for (const Tangent& t : mesh.tangents) {
        EXPECT_NEAR(dot(tilted, Vec3f{t.x, t.y, t.z}), 0.0f, 1e-6f);
        EXPECT_NEAR(length(Vec3f{t.x, t.y, t.z}), 1.0f, 1e-6f);
        EXPECT_GT(t.x, 0.0f);
    }
}

TEST(Tangents, EqualVerticesShareATangentWhereverTheyStandInTheFile) {
    Mesh mesh = square();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5f}, {0, 1, 0}};
    Mesh apart = mesh; // the same surface with six vertices of its own
    set_tangents(mesh);
    apart.positions.clear();
    apart.normals.clear();
    apart.uvs.clear();
    apart.triangles.clear();
    for (const auto& triangle : mesh.triangles) {
        const auto base = static_cast<std::uint32_t>(apart.positions.size());
        for (const std::uint32_t v : triangle) {
            apart.positions.push_back(mesh.positions[v]);
            apart.normals.push_back(mesh.normals[v]);
            apart.uvs.push_back(mesh.uvs[v]);
        }
        apart.triangles.push_back({base, base + 1, base + 2});
    }
    set_tangents(apart);
    for (std::size_t t = 0; t < 2; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Tangent a = mesh.tangents[mesh.triangles[t][k]];
            const Tangent b = apart.tangents[apart.triangles[t][k]];
            expect_tangent(b, {a.x, a.y, a.z}, a.w);
        }
    }
}

TEST(Tangents, ATriangleWithoutUvAreaTakesItsNeighboursFrame) {
    Mesh mesh = square();
    mesh.positions.push_back({2, 0, 0});
    mesh.normals.push_back(kUp);
    mesh.uvs.push_back({1, 1}); // equal to the uv of vertex 1: no uv area
    mesh.triangles.push_back({1, 4, 2});
    set_tangents(mesh);
    EXPECT_EQ(mesh.positions.size(), 5u);
    expect_tangent(mesh.tangents[1], {1, 0, 0}, 1.0f);
    const Tangent lone = mesh.tangents[4]; // no neighbour: any unit vector in the plane
    EXPECT_NEAR(length(Vec3f{lone.x, lone.y, lone.z}), 1.0f, 1e-6f);
    EXPECT_NEAR(lone.z, 0.0f, 1e-6f);
}

TEST(Tangents, AMeshWithoutNormalsGetsFlatOnes) {
    Mesh mesh = square();
    mesh.normals.clear();
    set_tangents(mesh);
    ASSERT_EQ(mesh.positions.size(), 6u);
    for (const Vec3f n : mesh.normals) EXPECT_EQ(n, kUp);
    for (const Tangent& t : mesh.tangents) expect_tangent(t, {1, 0, 0}, 1.0f);
}

} // namespace
} // namespace heddle
