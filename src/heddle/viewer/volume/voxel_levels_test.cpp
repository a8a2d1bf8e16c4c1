#include <heddle/viewer/volume/test_voxels.h>

#include <heddle/base/error.h>
#include <heddle/opengl/buffer.h>
#include <heddle/opengl/shader.h>
#include <heddle/preview/preview_volume.h>
#include <heddle/viewer/volume/voxel_table_glsl.h>

#include <gtest/gtest.h>

namespace heddle::viewer {
namespace {

using namespace test;

TEST(VoxelLevels, FarAwayACoarserLevelIsTakenAndLooksAlike) {
    const opengl::Context context;
    Progress progress;
    const VoxelLevels levels = knit(5);
    const VoxelRenderer renderer(context, sources_of(levels), {}, progress);
    VoxelLook fine = at_eye();
    VoxelLook by_pixel = at_eye();
    by_pixel.level = -1;
    for (const double angle : {0.0, 0.6}) {
        for (const int level : {0, 1, 2, 3}) {
            // a pixel is slightly narrower than the level's voxels
            CameraParameters camera = around(renderer, {0.2, 0.1, 1.0}, angle);
            const double pixel = 0.93 * 0.05 * std::ldexp(1.0, level);
            camera.view_height = pixel * kSize;
            const double distance = 0.5 * pixel * kSize / std::tan(0.3);
            camera.eye = camera.target + normalize(camera.eye - camera.target) * distance;
            VoxelLook only = at_eye();
            only.level = level;
            const std::vector<float> shown = floats(renderer, camera, by_pixel);
            if (angle == 0.0) {
                EXPECT_EQ(shown, floats(renderer, camera, only)) << level;
            }
            const std::array<double, 2> coarse = sums(shown);
            const std::array<double, 2> truth = sums(floats(renderer, camera, fine));
            const double brightness = coarse[0] / coarse[1], finest = truth[0] / truth[1];
            EXPECT_NEAR(brightness / finest, 1.0, 0.07) << level << ' ' << angle;
            EXPECT_NEAR(coarse[1] / truth[1], 1.0, 0.14) << level << ' ' << angle;
        }
    }
    // an offset shifts by whole levels; in perspective the level changes along a ray
    VoxelLook offset = by_pixel;
    offset.level_offset = 2.0;
    VoxelLook two = at_eye();
    two.level = 2;
    CameraParameters camera = around(renderer, {0.2, 0.1, 1.0}, 0.0);
    camera.view_height = 0.9 * 0.05 * kSize;
    EXPECT_EQ(floats(renderer, camera, offset), floats(renderer, camera, two));
}

TEST(VoxelLevels, LevelsChangeAlongARayWithItsWidth) {
    const opengl::Context context;
    Progress progress;
    // twice and four times the largest depth of a byte: both block the same over the same length
    const double depth = 2.0 * double{preview::kMaxDepth} / 255.0;
    const MemoryLevel fine = make_voxels(box({0, 0, 0}, {8, 8, 64}), -std::expm1(-depth));
    MemoryLevel coarse = make_voxels(box({0, 0, 0}, {4, 4, 32}), -std::expm1(-2.0 * depth));
    coarse.info().lattice = lattice_of_level(fine.info().lattice, 1);
    const VoxelRenderer renderer(context, Sources{&fine, &coarse}, {}, progress);
    VoxelLook look = at_eye(VoxelColor::Level);
    look.level = -1;
    // the eye looks along z; a pixel is 1 wide at z = 32
    CameraParameters camera{.eye = {4.1, 4.1, -32.0}, .target = {4.1, 4.1, 0.0}};
    camera.view_angle = 2.0 * std::atan(0.5 * kSize / 64.0);
    const std::vector<float> both = floats(renderer, camera, look);
    const std::size_t middle = 4 * (kSize / 2 * kSize + kSize / 2);
    const auto only = [&](int level) {
        look.level = level;
        const std::vector<float> seen = floats(renderer, camera, look);
        return std::array<double, 2>{static_cast<double>(seen[middle] / seen[middle + 3]),
                                     static_cast<double>(seen[middle + 3])};
    };
    const std::array<double, 2> near = only(0), far = only(1);
    const double half = -std::expm1(-32.0 * depth), whole = -std::expm1(-64.0 * depth);
    EXPECT_NEAR(near[1], whole, 0.002);
    EXPECT_NEAR(far[1], whole, 0.002);
    EXPECT_NEAR(static_cast<double>(both[middle + 3]), whole, 0.002);
    const double red = (near[0] * half + far[0] * (whole - half)) / whole;
    EXPECT_GT(std::fabs(near[0] - far[0]), 0.1) << "this test tells them apart";
    EXPECT_NEAR(static_cast<double>(both[middle] / both[middle + 3]), red, 0.005);
}

TEST(VoxelLevels, LevelsThatAStorageBlockDoesNotHoldAreLeftOut) {
    const opengl::Context context;
    Progress progress;
    const VoxelLevels levels = knit(3);
    const VoxelRenderer whole(context, sources_of(levels), {}, progress);
    ASSERT_EQ(whole.tables().first_level(), 0);
    const auto bytes = whole.tables().bytes();
    EXPECT_EQ(bytes[0].voxels, 4 * levels[0]->info().voxel_count);
    VoxelTableBytes rest = bytes[1];
    rest += bytes[2];
    const VoxelRenderer part(context, sources_of(levels), {.storage_bytes = rest.largest()},
                             progress);
    EXPECT_EQ(part.tables().first_level(), 1);
    EXPECT_EQ(part.tables().level_count(), 3);
    EXPECT_EQ(part.tables().blocks().size(), whole.tables().blocks().size());
    VoxelLook one = at_eye();
    one.level = 1;
    const CameraParameters camera = around(whole, {0.2, 0.1, 1.0}, 0.4);
    EXPECT_EQ(picture(part, camera, at_eye()).rgb, picture(whole, camera, one).rgb);
    try {
        const VoxelRenderer none(context, sources_of(levels), {.storage_bytes = 1000}, progress);
        ADD_FAILURE() << "not even the coarsest level fits";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::OutOfMemory);
    }
}

TEST(VoxelLevels, VoxelAtGivesOtherShadersWhatTheGridHolds) {
    const opengl::Context context;
    Progress progress;
    MemoryLevel grid = make_voxels({{-5, 3, 200}}, 0.5, {0.6f, 0.0f, 0.8f});
    grid.info().lattice.voxel_size = {0.5, 1.0, 0.25};
    const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
    constexpr std::string_view kAsk = R"(
layout(std430, binding = 0) readonly buffer Places { vec4 places[]; };
layout(std430, binding = 1) writeonly buffer Found { vec4 found[]; };
void main() {
    if (item() >= uint(places.length())) return;
    vec3 axis;
    float density;
    bool there = voxel_at(places[item()].xyz, int(places[item()].w), axis, density);
    found[item()] = vec4(abs(axis), there ? density : -1.0);
}
)";
    using Four = std::array<float, 4>;
    const std::vector<Four> places{{-2.3f, 3.5f, 50.1f, 0.0f}, // inside
                                   {-2.3f, 3.5f, 50.1f, 7.0f}, // no such level
                                   {-1.9f, 3.5f, 50.1f, 0.0f}, // beside
                                   {900.0f, -900.0f, 0.0f, 0.0f}};
    const opengl::Buffer from("places", std::span<const Four>(places));
    const opengl::Buffer to("found", places.size() * sizeof(Four));
    const opengl::Program ask = opengl::Program::compute("ask", kVoxelTableGlsl, kAsk);
    from.bind_storage(0);
    to.bind_storage(1);
    renderer.bind_tables();
    ask.dispatch(places.size());
    std::vector<Four> found(places.size());
    to.read(std::as_writable_bytes(std::span(found)));
    for (const std::size_t i : {0, 1}) {
        EXPECT_NEAR(found[i][0], 0.6f, 0.03f);
        EXPECT_NEAR(found[i][1], 0.0f, 0.03f);
        EXPECT_NEAR(found[i][2], 0.8f, 0.03f);
        EXPECT_NEAR(found[i][3], 0.5f, 0.01f);
    }
    EXPECT_EQ(found[2][3], -1.0f);
    EXPECT_EQ(found[3][3], -1.0f);
}

} // namespace
} // namespace heddle::viewer
