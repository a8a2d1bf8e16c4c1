#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/preview/preview.h>
#include <heddle/voxel/test_grid.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace heddle {
namespace {

using Pixel = std::array<int, 4>;

Pixel pixel(const PreviewImage& image, int x, int y) {
    const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(x)) *
                           4;
    return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2], image.rgba[at + 3]};
}

/// Voxels of one material, coverage c on every axis.
MemoryLevel
make_voxels(const std::vector<Vec3i>& at, double c, Vec3f direction = {1.0f, 0.0f, 0.0f}) {
    testing::VoxelMap voxels;
    const auto u = static_cast<std::uint16_t>(std::lround(c * 65535.0));
    for (const Vec3i i : at) {
        voxels[{i.x, i.y, i.z}] = {{u, u, u, u}, {{testing::needle(direction), 255, 0}}};
    }
    MemoryLevel grid;
    grid.info().materials.resize(1);
    grid.info().materials[0].kind = MaterialKind::Fiber;
    grid.blocks = testing::make_blocks(voxels);
    testing::count_voxels(grid);
    return grid;
}

std::vector<Vec3i> box(int nx, int ny, int nz) {
    std::vector<Vec3i> at;
    for (int x = 0; x < nx; ++x) {
        for (int y = 0; y < ny; ++y) {
            for (int z = 0; z < nz; ++z) at.push_back({x, y, z});
        }
    }
    return at;
}

PreviewOptions small(Vec3d from) {
    PreviewOptions options;
    options.width = options.height = 32;
    options.from = from;
    options.transparent = true;
    return options;
}

TEST(Preview, AVoxelSeenAlongAnAxisHidesItsCoverage) {
    Progress progress;
    for (const Vec3d from : {Vec3d{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}) {
        for (const double c : {0.1, 0.5, 0.9}) {
            std::vector<Vec3i> layer;
            for (Vec3i i : box(8, 8, 8)) {
                if (i.x * std::abs(from.x) + i.y * std::abs(from.y) + i.z * std::abs(from.z) ==
                    3.0) {
                    layer.push_back(i);
                }
            }
            const PreviewImage image = render_preview(make_voxels(layer, c), small(from), progress);
            EXPECT_NEAR(pixel(image, 16, 16)[3], c * 255.0, 3.0);
            EXPECT_EQ(pixel(image, 0, 0)[3], 0);
        }
    }
}

TEST(Preview, LayersMultiplyWhatTheyLetThrough) {
    Progress progress;
    const PreviewImage image =
        render_preview(make_voxels(box(16, 16, 3), 0.5), small({0, 0, 1}), progress);
    EXPECT_NEAR(pixel(image, 16, 16)[3], (1.0 - 0.125) * 255.0, 4.0);
}

TEST(Preview, NeighboursOfOneSheetAddUpWhatTheyHide) {
    Progress progress;
    MemoryLevel sheet = make_voxels(box(16, 16, 2), 0.5, {0.0f, 0.0f, 1.0f});
    sheet.info().materials[0].kind = MaterialKind::Surface; // the needle is of normals: flat
    EXPECT_GT(pixel(render_preview(sheet, small({0, 0, 1}), progress), 16, 16)[3], 250);
    // two sheets with air between them multiply, as all else does
    std::vector<Vec3i> apart = box(16, 16, 1);
    for (const Vec3i i : box(16, 16, 1)) apart.push_back({i.x, i.y, 3});
    MemoryLevel two = make_voxels(apart, 0.5, {0.0f, 0.0f, 1.0f});
    two.info().materials[0].kind = MaterialKind::Surface;
    const int alpha = pixel(render_preview(two, small({0, 0, 1}), progress), 16, 16)[3];
    EXPECT_GT(alpha, 184); // 0.75 and a little more: surfaces are to look closed
    EXPECT_LT(alpha, 245);
}

TEST(Preview, AMediumThatIsTheSameFromAllSidesIsSoAtAnAngle) {
    // a slab of 16 layers, c = 0.1: along z the depth is 16 k, at 60 degrees 32 k
    Progress progress;
    const double c = 0.02, k = -std::log(1.0 - c);
    const PreviewImage image = render_preview(make_voxels(box(64, 128, 16), c),
                                              small({0.0, std::sqrt(3.0), 1.0}), progress);
    EXPECT_NEAR(pixel(image, 16, 16)[3], (1.0 - std::exp(-32.0 * k)) * 255.0, 8.0);
}

TEST(Preview, TheNearerVoxelIsSeenFromEachSide) {
    testing::VoxelMap voxels;
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < 8; ++j) {
            for (const int x : {-20, 20}) {
                const auto material = static_cast<std::uint8_t>(x > 0 ? 1 : 0);
                voxels[{x, i, j}] = {{65535, 65535, 65535, 65535},
                                     {{testing::needle({0, 1, 0}), 255, material}}};
            }
        }
    }
    MemoryLevel grid;
    grid.info().materials.resize(2);
    grid.info().materials[0].albedo = {1.0f, 0.0f, 0.0f};
    grid.info().materials[1].albedo = {0.0f, 0.0f, 1.0f};
    grid.blocks = testing::make_blocks(voxels);
    Progress progress;
    const Pixel right = pixel(render_preview(grid, small({1, 0, 0}), progress), 16, 16);
    const Pixel left = pixel(render_preview(grid, small({-1, 0, 0}), progress), 16, 16);
    EXPECT_GT(right[2], right[0]);
    EXPECT_GT(left[0], left[2]);
}

TEST(Preview, UpInTheSceneIsUpInThePictureAndRightIsRight) {
    // an L in the plane z = 0: a bar along y at x = 0, a foot along x at y = 0
    std::vector<Vec3i> at;
    for (int i = 0; i < 64; ++i) {
        for (int w = 0; w < 8; ++w) {
            at.push_back({w, i, w});
            at.push_back({i, w, w});
        }
    }
    Progress progress;
    PreviewOptions options = small({0, 0, 1});
    options.up_axis = 1;
    const PreviewImage image = render_preview(make_voxels(at, 1.0), options, progress);
    EXPECT_GT(pixel(image, 2, 3)[3], 100);   // top of the bar, left
    EXPECT_GT(pixel(image, 28, 29)[3], 100); // end of the foot, right
    EXPECT_EQ(pixel(image, 28, 3)[3], 0);
}

TEST(Preview, TangentColourIsTheDirectionWithoutItsSign) {
    Progress progress;
    PreviewOptions options = small({0, 0, 1});
    options.color = PreviewColor::Tangent;
    const Pixel p =
        pixel(render_preview(make_voxels(box(8, 8, 8), 1.0, {0.0f, 1.0f, 0.0f}), options, progress),
              16, 16);
    EXPECT_LT(p[0], 20);
    EXPECT_GT(p[1], 250);
    EXPECT_LT(p[2], 20);
}

TEST(Preview, SameBytesOnOneAndManyThreads) {
    Progress progress;
    const MemoryLevel grid = testing::make_helix(12.0, 2.0, 2);
    PreviewOptions options;
    options.width = 61;
    options.height = 40;
    options.rays = 2;
    options.field_of_view = 0.7;
    set_thread_count(1);
    const PreviewImage one = render_preview(grid, options, progress);
    set_thread_count(7);
    const PreviewImage many = render_preview(grid, options, progress);
    set_thread_count(0);
    EXPECT_EQ(one.rgba, many.rgba);
}

TEST(Preview, EveryDirectionAndEmptyInputGiveAPicture) {
    Progress progress;
    const MemoryLevel grid = testing::make_helix(6.0, 1.5, 1);
    for (int i = 0; i < 27; ++i) {
        const Vec3d from{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
        if (length(from) == 0.0) continue;
        const PreviewImage image = render_preview(grid, small(from), progress);
        int seen = 0;
        for (std::size_t k = 3; k < image.rgba.size(); k += 4) seen += image.rgba[k] > 128 ? 1 : 0;
        EXPECT_GT(seen, 40) << from.x << ' ' << from.y << ' ' << from.z;
    }
    const PreviewImage none = render_preview(MemoryLevel{}, PreviewOptions{}, progress);
    EXPECT_EQ(pixel(none, 5, 5), (Pixel{255, 255, 255, 255}));
}

TEST(Preview, BadOptionsAndCancelAreErrors) {
    Progress progress;
    const MemoryLevel grid = make_voxels(box(2, 2, 2), 0.5);
    PreviewOptions options = small({0, 0, 0});
    EXPECT_THROW((void)render_preview(grid, options, progress), Error);
    options = small({0, 0, 1});
    options.width = 0;
    EXPECT_THROW((void)render_preview(grid, options, progress), Error);
    progress.cancel();
    EXPECT_THROW((void)render_preview(grid, small({0, 0, 1}), progress), Error);
}

} // namespace
} // namespace heddle
