#pragma once

#include <heddle/base/random.h>
#include <heddle/render/volume/volume_instance.h>
#include <heddle/voxel/test_grid.h>

#include <cmath>
#include <memory>
#include <vector>

// Volumes, rays and statistics for this room's tests.

namespace heddle::testing {

/// Returns x in [0, 1] as 16 bits.
inline std::uint16_t share16(double x) {
    return static_cast<std::uint16_t>(std::lround(x * 65535.0));
}

/// Returns a voxel with the same coverage on all axes.
inline TestVoxel even_voxel(double coverage, const std::vector<Lobe>& lobes) {
    const std::uint16_t c = share16(coverage);
    return {{c, c, c, c}, lobes};
}

inline Vec3f random_direction(StreamRandom& random) {
    const float z = 2.0f * random.uniform() - 1.0f;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const float phi = 6.2831853f * random.uniform();
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Adds `count` voxels with indices in [lo, lo + extent), random coverages in [0, most] per axis
/// and one or two random needles each, of material 0.
inline void
add_random(VoxelMap& voxels, StreamRandom& random, Vec3i lo, int extent, int count, double most) {
    const auto index = [&](int from) {
        return from + static_cast<int>(random.next() % static_cast<std::uint64_t>(extent));
    };
    const auto cover = [&] { return share16(most * static_cast<double>(random.uniform())); };
    for (int i = 0; i < count; ++i) {
        const int x = index(lo.x), y = index(lo.y), z = index(lo.z);
        TestVoxel& v = voxels[{x, y, z}];
        v.coverage = {cover(), cover(), cover(), cover()};
        v.lobes = {{needle(random_direction(random)), 200, 0}};
        if (random.uniform() < 0.5f) v.lobes.push_back({needle(random_direction(random)), 55, 0});
    }
}

inline std::shared_ptr<const TraversalLevel> level_of(const VoxelMap& voxels,
                                                      Vec3d voxel_size = {1, 1, 1},
                                                      int level = 0,
                                                      MaterialKind kind = MaterialKind::Fiber) {
    MemoryLevel grid;
    grid.info().lattice = {voxel_size, 8 << level};
    grid.info().level = level;
    grid.info().materials.resize(1);
    grid.info().materials[0].kind = kind;
    grid.blocks = make_blocks(voxels);
    count_voxels(grid);
    return std::make_shared<const TraversalLevel>(grid);
}

/// Returns a level of fibers with cells.
/// @param cells        returns the cells of a voxel by its number
/// @param correlation  of all faces; < 0: none is stored
template <typename Cells>
std::shared_ptr<const TraversalLevel> level_with_cells(const VoxelMap& voxels,
                                                       float fiber_radius,
                                                       const Cells& cells,
                                                       int level = 0,
                                                       double correlation = -1.0) {
    MemoryLevel grid;
    grid.info().lattice = lattice_of_level({{1, 1, 1}, 8}, level);
    grid.info().level = level;
    grid.info().materials.resize(1);
    grid.info().materials[0].kind = MaterialKind::Fiber;
    grid.info().materials[0].fiber_radius = fiber_radius;
    grid.info().fields.occupancy = true;
    grid.info().fields.correlation = correlation >= 0.0;
    grid.blocks = make_blocks(voxels);
    count_voxels(grid);
    for (VoxelBlock& block : grid.blocks) {
        for (std::size_t v = 0; v < block.coverage.size(); ++v) {
            block.occupancy.push_back(cells(v));
            if (correlation < 0.0) continue;
            const auto rho = static_cast<std::uint8_t>(std::lround(255.0 * correlation));
            block.correlation.push_back({rho, rho, rho});
        }
    }
    return std::make_shared<const TraversalLevel>(grid);
}

/// Returns a volume of one level.
inline VolumeInstance volume_of(const VoxelMap& voxels,
                                const Affine& to_world = {},
                                Vec3d voxel_size = {1, 1, 1},
                                MaterialKind kind = MaterialKind::Fiber) {
    return {{level_of(voxels, voxel_size, 0, kind)}, to_world, {0}};
}

inline Ray ray_along(Vec3d origin, Vec3d direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = to_float(normalize(direction));
    return ray;
}

/// The mean of numbers and its standard error.
struct MeanOf {
    double sum = 0.0, square = 0.0;
    double count = 0.0;
    void add(double x) {
        sum += x;
        square += x * x;
        count += 1.0;
    }
    [[nodiscard]] double mean() const { return sum / count; }
    [[nodiscard]] double error() const {
        return std::sqrt(std::max(0.0, square / count - mean() * mean()) / (count - 1.0));
    }
};

/// Returns how far chi-squared is above its mean, in standard deviations (Wilson and Hilferty).
inline double chi_squared_z(const std::vector<double>& observed,
                            const std::vector<double>& expected) {
    double chi = 0.0;
    int degrees = -1;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] <= 0.0) {
            chi += 1e6 * observed[i]; // an impossible value was drawn
            continue;
        }
        chi += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
        ++degrees;
    }
    const double k = 2.0 / (9.0 * degrees);
    return (std::cbrt(chi / degrees) - (1.0 - k)) / std::sqrt(k);
}

} // namespace heddle::testing
