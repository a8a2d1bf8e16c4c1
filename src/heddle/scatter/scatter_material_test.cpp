#include <heddle/scatter/scatter_material.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

TEST(ScatterMaterialOf, AFiberIsLambertianAndASurfaceKeepsItsConstants) {
    Material m;
    m.albedo = {.1f, .2f, .3f};
    m.roughness = .4f;
    m.metalness = .6f;
    m.anisotropy = .7f;
    const ScatterMaterial surface = scatter_material_of(m);
    EXPECT_EQ(surface.model, ScatterModel::Surface);
    EXPECT_EQ(surface.albedo, m.albedo);
    EXPECT_EQ(surface.roughness, .4f);
    EXPECT_EQ(surface.metalness, .6f);
    EXPECT_EQ(surface.anisotropy, .7f);
    m.kind = MaterialKind::Fiber;
    EXPECT_EQ(scatter_material_of(m).model, ScatterModel::LambertFiber);
    EXPECT_EQ(scatter_material_of(m).albedo, m.albedo);
}

TEST(AbsorptionFromMelanin, AddsThePigmentsAndGrowsTowardsBlue) {
    const Vec3f brown = absorption_from_melanin(1.3f, 0.0f);
    EXPECT_NEAR(brown.x, .5447f, 1e-4f);
    EXPECT_LT(brown.x, brown.y);
    EXPECT_LT(brown.y, brown.z);
    EXPECT_NEAR(absorption_from_melanin(1.0f, 2.0f).y, .697f + .8f, 1e-5f);
    EXPECT_EQ(absorption_from_melanin(0.0f, 0.0f), Vec3f{});
}

TEST(AbsorptionFromColor, WhiteAbsorbsNothingAndDarkerMore) {
    const Vec3f a = absorption_from_color({1.0f, .5f, .1f}, .3f);
    EXPECT_EQ(a.x, 0.0f);
    EXPECT_GT(a.y, 0.0f);
    EXPECT_GT(a.z, a.y);
    // (ln 0.5 / 5.8884)^2: the polynomial at 0.3, by hand
    EXPECT_NEAR(a.y, .0138565f, 2e-6f);
    EXPECT_GT(absorption_from_color({0, 0, 0}, 1.0f).x, a.z); // clamped, finite
}

} // namespace
} // namespace heddle
