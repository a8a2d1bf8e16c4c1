#pragma once

#include <heddle/geom/generate.h>
#include <heddle/viewer/volume/voxel_renderer.h>
#include <heddle/viewer/volume/voxel_tables.h>
#include <heddle/voxel/test_grid.h>
#include <heddle/voxelize/test_voxelize.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

// Small volumes and pictures of them, for the tests of VoxelRenderer.

namespace heddle::viewer::test {

inline constexpr std::int32_t kSize = 128;
using Sources = std::vector<const VoxelLevel*>;
using Rgb = std::array<int, 3>;

inline VoxelLook at_eye(VoxelColor color = VoxelColor::Shaded) {
    return {.color = color, .light = std::nullopt, .level = 0};
}

/// Voxels of one material, coverage c on every axis.
inline MemoryLevel
make_voxels(const std::vector<Vec3i>& at, double c, Vec3f direction = {1.0f, 0.0f, 0.0f}) {
    heddle::testing::VoxelMap voxels;
    const auto u = static_cast<std::uint16_t>(std::lround(c * 65535.0));
    for (const Vec3i i : at) {
        voxels[{i.x, i.y, i.z}] = {{u, u, u, u}, {{heddle::testing::needle(direction), 255, 0}}};
    }
    MemoryLevel grid;
    grid.info().materials.resize(1);
    grid.info().materials[0].kind = MaterialKind::Fiber;
    grid.blocks = heddle::testing::make_blocks(voxels);
    heddle::testing::count_voxels(grid);
    return grid;
}

inline std::vector<Vec3i> box(Vec3i lo, Vec3i size) {
    std::vector<Vec3i> at;
    for (int x = 0; x < size.x; ++x) {
        for (int y = 0; y < size.y; ++y) {
            for (int z = 0; z < size.z; ++z) at.push_back(lo + Vec3i{x, y, z});
        }
    }
    return at;
}

/// A knit of solid yarns, as levels whose voxels double.
inline VoxelLevels knit(int levels, Vec3d finest = {0.05, 0.05, 0.05}) {
    const Geometry geometry = generate({.kind = GenerateKind::Knit, .nx = 4, .ny = 4});
    VoxelLevels out;
    for (int level = 0; level < levels; ++level) {
        const Vec3d h = finest * std::ldexp(1.0, level);
        VoxelizeOptions options;
        options.voxel_size = h;
        out.push_back(heddle::test::voxelize_now(geometry, options));
    }
    return out;
}

inline std::unique_ptr<VoxelLevel> blades() {
    const Geometry grass = generate({.kind = GenerateKind::Grass, .nx = 30, .ny = 4});
    VoxelizeOptions options;
    options.voxels = 90;
    return heddle::test::voxelize_now(grass, options);
}

inline RgbImage picture(const VoxelRenderer& renderer,
                        const CameraParameters& camera,
                        const VoxelLook& look,
                        std::int32_t size = kSize) {
    const RenderTarget target(size, size);
    target.clear();
    renderer.draw(target, camera, look);
    return target.image();
}

inline std::vector<float>
floats(const VoxelRenderer& renderer, const CameraParameters& camera, const VoxelLook& look) {
    const RenderTarget target(kSize, kSize);
    target.clear();
    renderer.draw(target, camera, look);
    return target.read();
}

inline CameraParameters
around(const VoxelRenderer& renderer, Vec3d from, double angle, double zoom = 1.0) {
    Orbit orbit{.from = from, .view_angle = angle};
    orbit.frame(renderer.ball(), 1.0);
    orbit.zoom(zoom);
    return orbit.camera();
}

inline Rgb pixel(const RgbImage& image, std::int32_t x, std::int32_t y) {
    const std::uint8_t* p = &image.rgb[3 * static_cast<std::size_t>(y * image.width + x)];
    return {p[0], p[1], p[2]};
}

/// The sums of colour and of alpha.
inline std::array<double, 2> sums(const std::vector<float>& rgba) {
    std::array<double, 2> out{};
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        out[0] += static_cast<double>(rgba[i] + rgba[i + 1] + rgba[i + 2]);
        out[1] += static_cast<double>(rgba[i + 3]);
    }
    return out;
}

} // namespace heddle::viewer::test
