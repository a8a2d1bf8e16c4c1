#include <heddle/slice/section_layers.h>

#include <heddle/slice/test_slices.h>

#include <gtest/gtest.h>

namespace heddle::slice {
namespace {

using namespace heddle::slice::test;

TEST(SectionLayers, AreDrawnAnewOnlyWhereTheKindsOfYarnsChange) {
    Geometry yarn = straight_yarn({0.8f, 0.5f, 0.33f}, slice_yarn(0.06f));
    SectionLayers layers = build_sections(yarn, 1);
    for (Vec3f& p : yarn.curves[0].points) p.x += 1.0f;
    EXPECT_FALSE(update_sections(layers, yarn, 1));
    EXPECT_TRUE(update_sections(layers, yarn, 2)); // other positions of fibers
    yarn.yarns[0].slice.texels[3] ^= 1u;
    EXPECT_TRUE(update_sections(layers, yarn, 2));
    yarn.yarns[0].twist += 0.1f;
    EXPECT_TRUE(update_sections(layers, yarn, 2));
    EXPECT_EQ(layers.layers[0].distance, build_sections(yarn, 2).layers[0].distance);
    EXPECT_FALSE(update_sections(layers, yarn, 2));
}

} // namespace
} // namespace heddle::slice
