#include <heddle/viewer/volume/block_edges.h>
#include <heddle/viewer/volume/test_voxels.h>

#include <gtest/gtest.h>

namespace heddle::viewer {
namespace {

using namespace test;

TEST(VoxelLook, ShadowsDarkenWhatLiesBehindSeenFromTheLight) {
    const opengl::Context context;
    Progress progress;
    std::vector<Vec3i> at = box({0, 0, 0}, {64, 64, 2}); // a floor and a bar above it
    for (const Vec3i i : box({0, 28, 10}, {64, 8, 4})) at.push_back(i);
    const MemoryLevel grid = make_voxels(at, 1.0);
    const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
    VoxelLook look{.light = Vec3d{0.0, 1.0, 1.0}, .shadows = false};
    const CameraParameters camera = around(renderer, {0.0, 0.0, 1.0}, 0.0);
    const RgbImage without = picture(renderer, camera, look);
    look.shadows = true;
    const RgbImage with = picture(renderer, camera, look);
    // the light is above: the shadow of the bar is 10 voxels below it
    const double scale = kSize / (2.0 * renderer.ball().radius);
    const auto row = [&](double y) { return static_cast<std::int32_t>(kSize / 2 + y * scale); };
    EXPECT_LT(pixel(with, kSize / 2, row(10.0))[1], pixel(without, kSize / 2, row(10.0))[1] - 60);
    EXPECT_NEAR(pixel(with, kSize / 2, row(-16.0))[1], pixel(without, kSize / 2, row(-16.0))[1], 2);
    EXPECT_NEAR(pixel(with, kSize / 2, row(0.0))[1], pixel(without, kSize / 2, row(0.0))[1], 2);
}

TEST(VoxelLook, FibersAreBrightWhereLightComesFromTheirSide) {
    const opengl::Context context;
    Progress progress;
    const MemoryLevel grid = make_voxels(box({0, 0, 0}, {16, 16, 16}), 1.0, {1.0f, 0.0f, 0.0f});
    const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
    const CameraParameters camera = around(renderer, {0.0, 0.0, 1.0}, 0.0);
    const auto green = [&](Vec3d light) {
        const VoxelLook look{.light = light, .shadows = false};
        return pixel(picture(renderer, camera, look), kSize / 2, kSize / 2)[1];
    };
    EXPECT_GT(green({0.0, 1.0, 0.3}), green({1.0, 0.0, 0.3}) + 40);
}

TEST(VoxelLook, ASurfaceSeenFromItsDarkSideIsDarkWhereThereAreShadows) {
    const opengl::Context context;
    Progress progress;
    MemoryLevel sheet = make_voxels(box({0, 0, 0}, {16, 16, 1}), 1.0, {0.0f, 0.0f, 1.0f});
    sheet.info().materials[0].kind = MaterialKind::Surface;
    const VoxelRenderer renderer(context, Sources{&sheet}, {}, progress);
    const CameraParameters camera = around(renderer, {0.0, 0.0, 1.0}, 0.0);
    const auto green = [&](double z, bool shadows) {
        const VoxelLook look{.light = Vec3d{0.0, 0.3, z}, .shadows = shadows};
        return pixel(picture(renderer, camera, look), kSize / 2, kSize / 2)[1];
    };
    EXPECT_EQ(green(1.0, true), green(1.0, false));
    EXPECT_GT(green(-1.0, false), 180) << "the cosine has no sign";
    EXPECT_LT(green(-1.0, true), green(-1.0, false) - 60);
}

TEST(VoxelLook, DensityGoesFromBlueToRedAndItsScaleMakesThin) {
    const opengl::Context context;
    Progress progress;
    for (const double c : {0.05, 0.95}) {
        const MemoryLevel grid = make_voxels(box({0, 0, 0}, {16, 16, 16}), c);
        const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
        const CameraParameters camera = around(renderer, {0.0, 0.0, 1.0}, 0.0);
        VoxelLook look = at_eye(VoxelColor::Density);
        const Rgb p = pixel(picture(renderer, camera, look), kSize / 2, kSize / 2);
        EXPECT_EQ(p[0] > p[2], c > 0.5);
        const std::size_t alpha = 4 * (kSize / 2 * kSize + kSize / 2) + 3;
        const auto whole = static_cast<double>(floats(renderer, camera, look)[alpha]);
        look.density_scale = 0.01;
        const auto thin = static_cast<double>(floats(renderer, camera, look)[alpha]);
        const double depth = -16.0 * std::log1p(-c);
        EXPECT_NEAR(thin, 1.0 - std::exp(-0.01 * depth), 0.01);
        EXPECT_GT(whole, thin + 0.3);
    }
}

TEST(VoxelLook, LinesLieOnTheEdgesOfOccupiedBlocks) {
    const opengl::Context context;
    Progress progress;
    const MemoryLevel grid = make_voxels({{1, 1, 1}, {-1, 1, 1}, {40, 40, 20}}, 1.0);
    const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
    ASSERT_EQ(renderer.tables().blocks().size(), 3u);
    VoxelLook look = at_eye();
    look.blocks = true;
    // a pixel is a voxel: edges are at voxels -32, 0, 32, 64
    CameraParameters camera{
        .orthographic = true, .eye = {16.5, 16.5, 90.0}, .target = {16.5, 16.5, 0.0}};
    camera.view_height = kSize;
    const RgbImage image = picture(renderer, camera, look);
    const auto is_line = [&](int x, int y) { // voxels, y up
        const Rgb p = pixel(image, kSize / 2 - 17 + x, kSize / 2 + 16 - y);
        return p[0] > p[1] + 60;
    };
    for (const int at : {5, 20, 28}) {
        for (const int edge : {-32, 0, 32}) EXPECT_TRUE(is_line(edge, at)) << edge << ' ' << at;
        EXPECT_TRUE(is_line(at, 0) && is_line(at, 32) && is_line(-at, 0) && is_line(-at, 32));
        EXPECT_TRUE(is_line(32 + at, 64) && is_line(64, 32 + at));
        EXPECT_FALSE(is_line(at, 64) || is_line(64, at)) << "the empty block's";
        EXPECT_FALSE(is_line(at, at + 3) || is_line(at, 16));
    }
}

TEST(VoxelLook, BlocksThatTouchShareTheirEdges) {
    const std::vector<Vec3i> blocks{{-1, 0, 0}, {0, 0, 0}, {4, 4, 4}};
    EXPECT_EQ(edges_of_blocks(blocks, {1.0, 2.0, 3.0}, {}).size(), 12u + 12u + 12u - 4u);
}

TEST(VoxelLook, AHiddenLineIsDimmer) {
    const opengl::Context context;
    Progress progress;
    // in perspective the edges at z = 0, behind the voxels, are apart from those at z = 32
    const MemoryLevel wall = make_voxels(box({-32, -32, 20}, {96, 96, 4}), 1.0);
    const VoxelRenderer renderer(context, Sources{&wall}, {}, progress);
    CameraParameters camera{.eye = {16.0, 16.0, 120.0}, .target = {16.0, 16.0, 0.0}};
    camera.view_angle = 2.0 * std::atan(0.5 * kSize / 240.0); // a pixel is half a voxel at z = 0
    VoxelLook look = at_eye();
    const std::vector<float> plain = floats(renderer, camera, look);
    look.blocks = true;
    const std::vector<float> lines = floats(renderer, camera, look);
    const auto redder = [&](double x, double z) { // most red that a line adds near x at y = 16.25
        const double pixels = kSize / 2 + (x - 16.0) * 240.0 / (120.0 - z);
        double most = 0.0;
        for (int d = -1; d <= 1; ++d) {
            const auto column =
                static_cast<std::size_t>(pixels) + static_cast<std::size_t>(d + 1) - 1;
            const std::size_t p = 4 * (static_cast<std::size_t>(kSize / 2) * kSize + column);
            const float before = plain[p] - plain[p + 1], after = lines[p] - lines[p + 1];
            most = std::max(most, static_cast<double>(after - before));
        }
        return most;
    };
    EXPECT_GT(redder(32.0, 32.0), 0.4);
    EXPECT_GT(redder(32.0, 0.0), 0.05);
    EXPECT_LT(redder(32.0, 0.0), 0.2);
}

TEST(VoxelLook, BlockAtFindsTheFirstBlockUnderAPixel) {
    const opengl::Context context;
    Progress progress;
    MemoryLevel grid = make_voxels({{1, 1, 1}, {-1, 1, 1}, {1, 1, 70}}, 1.0);
    grid.info().lattice.voxel_size = {1.0, 0.5, 2.0};
    const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
    CameraParameters camera{
        .orthographic = true, .eye = {0.0, 8.0, 900.0}, .target = {0.0, 8.0, 0.0}};
    camera.view_height = 100.0;
    const auto at = [&](double x, double y) { // scene units from the middle
        return renderer.block_at(camera, 100, 100, 50.0 + x, 50.0 - y);
    };
    for (const bool orthographic : {true, false}) {
        camera.orthographic = orthographic;
        camera.view_angle = 2.0 * std::atan(50.0 / 900.0);
        EXPECT_EQ(at(10.0, 0.0), (Vec3i{0, 0, 2}));
        EXPECT_EQ(at(-10.0, 5.0), (Vec3i{-1, 0, 0}));
        EXPECT_FALSE(at(10.0, 20.0));
        EXPECT_FALSE(at(-45.0, 0.0));
    }
    camera.eye.z = 100.0; // in front of the far block, inside none
    EXPECT_EQ(at(1.0, 0.0), (Vec3i{0, 0, 0}));
    camera.eye.z = 30.0; // inside
    EXPECT_EQ(at(1.0, 0.0), (Vec3i{0, 0, 0}));
}

TEST(VoxelLook, TheWhiteBlockIsSolidWithDarkCellEdges) {
    const opengl::Context context;
    Progress progress;
    const MemoryLevel grid = make_voxels(box({24, 0, 0}, {16, 16, 1}), 0.3);
    const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
    VoxelLook look = at_eye();
    look.white_block = Vec3i{1, 0, 0};
    CameraParameters camera{
        .orthographic = true, .eye = {32.0, 8.0, 9.0}, .target = {32.0, 8.0, 0.0}};
    camera.view_height = 16.0; // 8 pixels per voxel
    const std::vector<float> seen = floats(renderer, camera, look);
    const auto at = [&](int voxel, int pixel) {
        const std::size_t x = static_cast<std::size_t>(8 * voxel + pixel);
        return 4 * (static_cast<std::size_t>(8 * 8 + 4) * kSize + x);
    };
    EXPECT_NEAR(seen[at(3, 4) + 3], 0.3f, 0.01f) << "the other block stays";
    for (const int voxel : {9, 12, 14}) {
        EXPECT_EQ(seen[at(voxel, 4) + 3], 1.0f);
        EXPECT_GT(seen[at(voxel, 4)], 0.8f) << voxel;
        EXPECT_LT(seen[at(voxel, 0)], 0.4f) << voxel;
    }
}

} // namespace
} // namespace heddle::viewer
