#include <heddle/render/embree/test_trace.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

using namespace heddle::test;

/// The square [0, 1]^2 at z = 0, facing +z, uv = (x, y).
Geometry square() {
    Geometry geometry;
    geometry.materials.emplace_back();
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    geometry.meshes.push_back(mesh);
    return geometry;
}

/// 2 x 2 texels, RGBA, clamped.
Texture texels(std::vector<std::uint8_t> bytes, bool srgb = false) {
    Texture t;
    t.width = t.height = 2;
    t.channels = 4;
    t.srgb = srgb;
    t.wrap_u = t.wrap_v = Wrap::Clamp;
    t.texels = std::move(bytes);
    return t;
}

TracedHit hit_at(const SurfaceScene& scene, double x, double y, double from = 1.0) {
    TracedHit hit;
    EXPECT_TRUE(scene.intersect(ray_to({x, y, from}, {x, y, 0}), hit)) << x << ' ' << y;
    return hit;
}

TEST(EmbreeMesh, AMeshIsMetFromBothSidesWithItsNormalTowardsTheRay) {
    const auto scene = trace(square());
    const TracedHit above = hit_at(*scene, 0.3, 0.6, 2.0);
    EXPECT_FLOAT_EQ(above.t, 2.0f);
    EXPECT_EQ(above.normal, (Vec3f{0, 0, 1}));
    EXPECT_EQ(above.scatterer.axis, (Vec3f{0, 0, 1}));
    const TracedHit below = hit_at(*scene, 0.3, 0.6, -2.0);
    EXPECT_EQ(below.normal, (Vec3f{0, 0, -1}));
    EXPECT_EQ(below.scatterer.axis, (Vec3f{0, 0, -1}));
    EXPECT_FALSE(scene->occluded(ray_to({1.1, 0.5, 1}, {1.1, 0.5, 0})));
}

TEST(EmbreeMesh, AColourMapIsReadWhereTheUvSays) {
    Geometry geometry = square();
    geometry.textures.push_back(texels({255, 0, 0, 255, 0, 255, 0, 255, //
                                        0, 0, 255, 255, 188, 188, 188, 255},
                                       true));
    geometry.materials[0].albedo_map = 0;
    ScatterMaterial m;
    m.albedo = {0.5f, 0.5f, 0.5f};
    const auto scene = trace(geometry, m);
    EXPECT_EQ(hit_at(*scene, 0.2, 0.2).scatterer.material.albedo, (Vec3f{0.5f, 0, 0}));
    EXPECT_EQ(hit_at(*scene, 0.8, 0.2).scatterer.material.albedo, (Vec3f{0, 0.5f, 0}));
    EXPECT_EQ(hit_at(*scene, 0.2, 0.8).scatterer.material.albedo, (Vec3f{0, 0, 0.5f}));
    // 188 in sRGB is half the light
    EXPECT_NEAR(hit_at(*scene, 0.8, 0.8).scatterer.material.albedo.x, 0.25f, 0.002f);
    // bilinear between two texels, in linear light
    EXPECT_NEAR(hit_at(*scene, 0.5, 0.2).scatterer.material.albedo.x, 0.25f, 0.002f);
}

TEST(EmbreeMesh, MetalAndRoughnessMultiplyTheMaterials) {
    Geometry geometry = square();
    geometry.textures.push_back(texels({0, 51, 204, 255, 0, 51, 204, 255, //
                                        0, 51, 204, 255, 0, 51, 204, 255}));
    geometry.materials[0].metal_rough_map = 0;
    ScatterMaterial m;
    m.roughness = 0.5f;
    m.metalness = 0.5f;
    const auto scene = trace(geometry, m);
    const TracedHit hit = hit_at(*scene, 0.4, 0.4);
    EXPECT_NEAR(hit.scatterer.material.roughness, 0.1f, 1e-4f);
    EXPECT_NEAR(hit.scatterer.material.metalness, 0.4f, 1e-4f);
}

TEST(EmbreeMesh, ANormalMapTiltsTheAxisButNotTheGeometry) {
    Geometry geometry = square();
    // (0.6, 0, 0.8) as bytes
    geometry.textures.push_back(texels({204, 128, 230, 255, 204, 128, 230, 255, //
                                        204, 128, 230, 255, 204, 128, 230, 255}));
    geometry.materials[0].normal_map = 0;
    const auto scene = trace(geometry);
    const TracedHit hit = hit_at(*scene, 0.4, 0.4);
    EXPECT_EQ(hit.normal, (Vec3f{0, 0, 1}));
    EXPECT_NEAR(hit.scatterer.axis.x, 0.6f, 0.01f);
    EXPECT_NEAR(hit.scatterer.axis.z, 0.8f, 0.01f);
    EXPECT_NEAR(dot(hit.scatterer.axis, hit.scatterer.tangent), 0.0f, 1e-5f);
}

TEST(EmbreeMesh, TheDirectionOfAnisotropyFollowsUvAndRotation) {
    Geometry geometry = square();
    EXPECT_NEAR(hit_at(*trace(geometry), 0.4, 0.4).scatterer.tangent.x, 1.0f, 1e-5f);
    geometry.materials[0].anisotropy_rotation = 1.5707963f;
    EXPECT_NEAR(hit_at(*trace(geometry), 0.4, 0.4).scatterer.tangent.y, 1.0f, 1e-5f);
    geometry.meshes[0].tangents.assign(4, {0.0f, 1.0f, 0.0f, 1.0f});
    EXPECT_NEAR(hit_at(*trace(geometry), 0.4, 0.4).scatterer.tangent.x, -1.0f, 1e-5f);
}

TEST(EmbreeMesh, AMaskCutsAHole) {
    Geometry geometry = square();
    geometry.textures.push_back(texels({255, 255, 255, 0, 255, 255, 255, 255, //
                                        255, 255, 255, 255, 255, 255, 255, 255}));
    geometry.materials[0].albedo_map = 0;
    geometry.materials[0].alpha_mode = AlphaMode::Mask;
    const auto scene = trace(geometry);
    TracedHit hit;
    const Ray through = ray_to({0.2, 0.2, 1}, {0.2, 0.2, 0});
    EXPECT_FALSE(scene->intersect(through, hit));
    EXPECT_FALSE(scene->occluded(through));
    EXPECT_TRUE(scene->occluded(ray_to({0.8, 0.2, 1}, {0.8, 0.2, 0})));
    EXPECT_EQ(hit_at(*scene, 0.8, 0.8).scatterer.material.albedo, (Vec3f{0.8f, 0.8f, 0.8f}));
}

TEST(EmbreeMesh, BlendedAlphaStopsItsShareOfRays) {
    Geometry geometry = square();
    geometry.materials[0].alpha_mode = AlphaMode::Blend;
    geometry.materials[0].alpha = 0.3f;
    const auto scene = trace(geometry);
    int hits = 0;
    for (int i = 0; i < 10000; ++i) {
        const double x = (i % 100 + 0.5) / 100.0, y = (i / 100 + 0.5) / 100.0;
        hits += scene->occluded(ray_to({x, y, 1}, {x, y, 0})) ? 1 : 0;
    }
    EXPECT_NEAR(hits, 3000, 200);
}

TEST(EmbreeMesh, FiberModelsOnTrianglesAreDiffuse) {
    ScatterMaterial m;
    m.model = ScatterModel::MicroflakeDiffuse;
    m.metalness = 1.0f;
    const auto scene = trace(square(), m);
    const TracedHit hit = hit_at(*scene, 0.4, 0.4);
    EXPECT_EQ(hit.scatterer.material.model, ScatterModel::Surface);
    EXPECT_EQ(hit.scatterer.material.metalness, 0.0f);
    EXPECT_EQ(hit.scatterer.material.specular, 0.0f);
}

void expect_refused(const Geometry& geometry, ErrorCode code) {
    try {
        const auto scene = trace(geometry);
        ADD_FAILURE() << "no error";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), code) << e.what();
    }
}

TEST(EmbreeMesh, BadMeshesAreRefused) {
    Geometry geometry = square();
    geometry.meshes[0].triangles[1][2] = 4;
    expect_refused(geometry, ErrorCode::InvalidArgument);
    geometry = square();
    geometry.meshes[0].uvs.pop_back();
    expect_refused(geometry, ErrorCode::InvalidArgument);
    geometry = square();
    geometry.materials[0].albedo_map = 0;
    expect_refused(geometry, ErrorCode::InvalidArgument);
    geometry = square();
    geometry.textures.push_back(texels(std::vector<std::uint8_t>(16, 0)));
    geometry.materials[0].height_map = 0;
    geometry.materials[0].height_scale = 0.1f;
    expect_refused(geometry, ErrorCode::Unsupported);
}

TEST(EmbreeMesh, TrianglesWithoutAreaDoNoHarm) {
    Geometry geometry = square();
    geometry.meshes[0].triangles.push_back({0, 0, 0});
    geometry.meshes[0].triangles.push_back({0, 1, 1});
    EXPECT_FLOAT_EQ(hit_at(*trace(geometry), 0.4, 0.4).t, 1.0f);
}

} // namespace
} // namespace heddle
