#include <heddle/viewer/volume/test_voxels.h>

#include <heddle/base/error.h>
#include <heddle/preview/preview.h>
#include <heddle/preview/preview_volume.h>

#include <gtest/gtest.h>

#include <map>

namespace heddle::viewer {
namespace {

using namespace test;

/// The camera of render_preview for a square picture; as in preview.cpp.
CameraParameters preview_camera(const VoxelLevel& source, Vec3d from, double angle) {
    Progress progress;
    const preview::PreviewVolume scene(source, false, progress);
    const CameraAxes axes(from, {0.0, 1.0, 0.0});
    const Vec3d half = (scene.bounds_hi() - scene.bounds_lo()) * 0.5;
    CameraParameters out;
    out.orthographic = angle == 0.0;
    out.target = (scene.bounds_lo() + scene.bounds_hi()) * 0.5;
    out.view_angle = angle;
    double distance = 0.0;
    out.view_height = 0.0;
    for (int c = 0; c < 8; ++c) {
        const Vec3d p{(c & 1) != 0 ? half.x : -half.x, (c & 2) != 0 ? half.y : -half.y,
                      (c & 4) != 0 ? half.z : -half.z};
        const Vec3d seen = axes.of(p);
        const double need = 1.04 * std::max(std::fabs(seen.x), std::fabs(seen.y));
        out.view_height = std::max(out.view_height, 2.0 * need);
        if (angle > 0.0) distance = std::max(distance, need / std::tan(0.5 * angle) - seen.z);
    }
    out.eye = out.target - axes.away * (angle > 0.0 ? distance : 2.0 * length(half));
    return out;
}

/// The fraction of pixels that differ by more than 1 of 255 from render_preview, and its coverage.
std::array<double, 2> off_preview(const VoxelLevel& source, PreviewColor color, double angle) {
    constexpr Vec3d kFrom{0.6, 0.7, 1.0};
    Progress progress;
    const PreviewImage cpu = render_preview(source,
                                            {.width = kSize,
                                             .height = kSize,
                                             .color = color,
                                             .from = kFrom,
                                             .up_axis = 1,
                                             .field_of_view = angle},
                                            progress);
    const opengl::Context context;
    const VoxelRenderer renderer(context, Sources{&source}, {}, progress);
    const std::map<PreviewColor, VoxelColor> same{{PreviewColor::Albedo, VoxelColor::Shaded},
                                                  {PreviewColor::Tangent, VoxelColor::Tangent},
                                                  {PreviewColor::Width, VoxelColor::Width},
                                                  {PreviewColor::Material, VoxelColor::Material}};
    const RgbImage image =
        picture(renderer, preview_camera(source, kFrom, angle), at_eye(same.at(color)));
    double off = 0.0;
    double covered = 0.0;
    for (std::size_t p = 0; p < static_cast<std::size_t>(kSize) * kSize; ++p) {
        int apart = 0;
        int least = 255;
        for (std::size_t c = 0; c < 3; ++c) {
            apart = std::max(apart, std::abs(cpu.rgba[4 * p + c] - image.rgb[3 * p + c]));
            least = std::min<int>(least, cpu.rgba[4 * p + c]);
        }
        off += apart > 1 ? 1.0 : 0.0;
        covered += least < 250 ? 1.0 : 0.0;
    }
    return {off / (kSize * kSize), covered / (kSize * kSize)};
}

TEST(VoxelView, IsWhatRenderPreviewDrawsOnAllButOneInAThousandPixels) {
    const VoxelLevels levels = knit(1);
    const std::unique_ptr<VoxelLevel> grass = blades();
    for (const VoxelLevel* source : {levels[0].get(), grass.get()}) {
        for (const PreviewColor color : {PreviewColor::Albedo, PreviewColor::Tangent,
                                         PreviewColor::Width, PreviewColor::Material}) {
            for (const double angle : {0.0, 0.6}) {
                const std::array<double, 2> share = off_preview(*source, color, angle);
                EXPECT_LE(share[0], 0.001) << static_cast<int>(color) << ' ' << angle;
                EXPECT_GT(share[1], 0.05);
            }
        }
    }
}

TEST(VoxelView, VoxelsThatAreNotCubesAndNegativeIndicesAreAsThePreviewHasThem) {
    const VoxelLevels flat = knit(1, {0.03, 0.05, 0.08});
    EXPECT_LE(off_preview(*flat[0], PreviewColor::Albedo, 0.0)[0], 0.001);
    MemoryLevel negative =
        make_voxels(box({-300, -20, -140}, {30, 20, 10}), 0.4, {0.0f, 1.0f, 0.0f});
    negative.info().lattice.voxel_size = {0.5, 0.25, 1.0};
    const std::array<double, 2> share = off_preview(negative, PreviewColor::Albedo, 0.6);
    EXPECT_LE(share[0], 0.001);
    EXPECT_GT(share[1], 0.1);
}

TEST(VoxelView, OneVoxelHidesItsCoverageAndAnEmptyVolumeNothing) {
    const opengl::Context context;
    Progress progress;
    const MemoryLevel one = make_voxels({{-3, 70, 5}}, 0.5);
    const VoxelRenderer renderer(context, Sources{&one}, {}, progress);
    const std::vector<float> seen =
        floats(renderer, around(renderer, {0.0, 0.0, 1.0}, 0.0), at_eye());
    const std::size_t middle = 4 * (kSize / 2 * kSize + kSize / 2);
    EXPECT_NEAR(seen[middle + 3], 0.5, 0.01);
    EXPECT_EQ(seen[3], 0.0f);
    const double part = sums(seen)[1] / (kSize * kSize); // a square in its circle's square
    EXPECT_NEAR(part, 0.5 / 3.0, 0.01);
    const MemoryLevel none;
    for (const Sources& levels : {Sources{}, Sources{&none}}) {
        const VoxelRenderer empty(context, levels, {}, progress);
        EXPECT_TRUE(empty.tables().empty());
        VoxelLook look = at_eye();
        look.blocks = true;
        EXPECT_EQ(sums(floats(empty, {}, look))[1], 0.0);
        EXPECT_FALSE(empty.block_at({}, kSize, kSize, 5.0, 5.0));
    }
}

TEST(VoxelView, TheEyeMayBeInsideAndSeesNothingBehindIt) {
    const opengl::Context context;
    Progress progress;
    std::vector<Vec3i> at = box({0, 0, 0}, {16, 16, 1}); // two walls
    for (const Vec3i i : box({0, 0, 40}, {16, 16, 1})) at.push_back(i);
    const MemoryLevel grid = make_voxels(at, 0.5);
    const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
    const auto alpha = [&](const CameraParameters& camera) {
        return static_cast<double>(
            floats(renderer, camera, at_eye())[4 * (kSize / 2 * kSize + kSize / 2) + 3]);
    };
    CameraParameters camera{.eye = {8.01, 8.02, 20.0}, .target = {8.01, 8.02, 0.0}};
    EXPECT_NEAR(alpha(camera), 0.5, 0.01);
    camera.eye.z = 60.0;
    EXPECT_NEAR(alpha(camera), 0.75, 0.01);
    camera.eye.z = 40.5; // inside a wall
    EXPECT_NEAR(alpha(camera), 1.0 - 0.5 * std::sqrt(0.5), 0.01);
    camera.eye.z = 20.0;
    camera.orthographic = true; // rays have no start
    EXPECT_NEAR(alpha(camera), 0.75, 0.01);
}

TEST(VoxelView, AFarEyeSeesWhatParallelRaysSee) {
    const opengl::Context context;
    Progress progress;
    const VoxelLevels levels = knit(1);
    const VoxelRenderer renderer(context, sources_of(levels), {}, progress);
    constexpr Vec3d kAside{1.0, 0.4, 0.5};
    const RgbImage parallel = picture(renderer, around(renderer, kAside, 0.0), at_eye());
    const auto apart = [&](double angle) {
        const RgbImage image = picture(renderer, around(renderer, kAside, angle), at_eye());
        double count = 0.0;
        for (std::size_t i = 0; i < image.rgb.size(); ++i) {
            count += std::abs(image.rgb[i] - parallel.rgb[i]) > 6 ? 1.0 : 0.0;
        }
        return count / static_cast<double>(image.rgb.size());
    };
    EXPECT_LT(apart(2e-5), 0.002);
    EXPECT_GT(apart(1.0), 0.05) << "this test tells them apart";
}

TEST(VoxelView, FarFromTheOriginVoxelsLookTheSame) {
    const opengl::Context context;
    Progress progress;
    const Vec3i away{1 << 19, -(1 << 19), 1 << 18};
    std::vector<Vec3i> at; // a stair
    for (int i = 0; i < 40; ++i) at.push_back({i, i / 2, i / 3});
    const auto draw = [&](Vec3i by) {
        std::vector<Vec3i> moved = at;
        for (Vec3i& i : moved) i = i + by;
        const MemoryLevel grid = make_voxels(moved, 0.7);
        const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
        return picture(renderer, around(renderer, {0.3, -0.5, 1.0}, 0.6), at_eye()).rgb;
    };
    const std::vector<std::uint8_t> here = draw({}), there = draw(away);
    int off = 0;
    int dark = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        off += std::abs(here[i] - there[i]) > 3 ? 1 : 0;
        dark += here[i] < 250 ? 1 : 0;
    }
    EXPECT_LE(off, static_cast<int>(here.size() / 1000));
    EXPECT_GT(dark, 500);
}

TEST(VoxelView, BandsMakeTheSamePictureAsOneDraw) {
    const opengl::Context context;
    Progress progress;
    const VoxelLevels levels = knit(2);
    const VoxelRenderer renderer(context, sources_of(levels), {}, progress);
    const CameraParameters camera = around(renderer, {0.2, 0.1, 1.0}, 0.6);
    VoxelLook look;
    look.blocks = true;
    const RenderTarget target(kSize, kSize);
    target.clear();
    for (std::int32_t y = 0; y < kSize; y += 24) {
        target.limit(y, std::min(y + 24, kSize));
        renderer.draw(target, camera, look);
    }
    target.limit(0, kSize);
    EXPECT_EQ(target.image().rgb, picture(renderer, camera, look).rgb);
}

TEST(VoxelView, WhatCannotBeShownIsOneLine) {
    const opengl::Context context;
    Progress progress;
    const MemoryLevel grid = make_voxels({{0, 0, 0}}, 0.5);
    const auto code = [](auto&& run) {
        try {
            run();
        } catch (const Error& e) {
            return e.code();
        }
        return ErrorCode::Internal;
    };
    const auto make = [&](const Sources& levels) {
        return code([&] { const VoxelRenderer renderer(context, levels, {}, progress); });
    };
    EXPECT_EQ(make({&grid, &grid}), ErrorCode::InvalidArgument);
    MemoryLevel odd = make_voxels({{0, 0, 0}}, 0.5);
    odd.info().lattice.voxel_size = {2.0, 2.0, 3.0};
    EXPECT_EQ(make({&grid, &odd}), ErrorCode::InvalidArgument);
    const VoxelRenderer renderer(context, Sources{&grid}, {}, progress);
    const auto draw = [&](const CameraParameters& camera, const VoxelLook& look) {
        return code([&] { (void)picture(renderer, camera, look); });
    };
    EXPECT_EQ(draw({.eye = {}, .target = {}}, {}), ErrorCode::InvalidArgument);
    EXPECT_EQ(draw({}, {.light = Vec3d{}}), ErrorCode::InvalidArgument);
    EXPECT_EQ(draw({}, {.density_scale = 0.0}), ErrorCode::InvalidArgument);
    EXPECT_EQ(draw({}, {.level = -2}), ErrorCode::InvalidArgument);
    EXPECT_EQ(draw({}, {.level_offset = std::nan("")}), ErrorCode::InvalidArgument);
    const RenderTarget target(8, 8);
    EXPECT_EQ(code([&] { renderer.draw_blocks(target, {}, {.density_scale = -1.0}); }),
              ErrorCode::InvalidArgument);
    progress.cancel();
    EXPECT_EQ(make({&grid}), ErrorCode::Cancelled);
}

} // namespace
} // namespace heddle::viewer
