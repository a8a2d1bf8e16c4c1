#pragma once

#include <heddle/geom/bounds.h>
#include <heddle/lod/method.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/voxelize/voxelize_options.h>

#include <cstdint>
#include <optional>
#include <string>

namespace heddle::job {

/// How geometry is voxelized.
enum class Backend : std::uint8_t {
    Sample, ///< by sampling fibers and triangles, on the CPU or a CUDA device
    Raster  ///< by drawing slices of yarns and hair with OpenGL
};

/// Where Backend::Sample runs; all choices give the same bits.
enum class DeviceChoice : std::uint8_t {
    Auto, ///< CUDA if there is a device that supports the options, else the CPU
    Cpu,
    Cuda
};

/// How an object is voxelized. Nothing is required.
struct VoxelizeJobOptions {
    std::optional<Vec3d> voxel_size{};    ///< scene units per axis
    std::optional<std::int64_t> voxels{}; ///< along the longest axis; if neither is given: 512
    bool fill_memory = false;       ///< instead of both: the finest resolution that fits in memory
    std::optional<Bounds> bounds{}; ///< scene units; only voxels that touch it are stored
    std::int32_t lobes = 3;         ///< most per voxel, 1 to 8
    std::int32_t subvoxels = 8;     ///< per voxel axis: 1, 2, 4 or 8
    CoverageMode coverage = CoverageMode::Columns;
    std::int64_t samples = 0; ///< per span, for CoverageMode::Mask; 0: two per subvoxel
    FitMode fit = FitMode::Moments;
    std::int32_t footprints = 0; ///< stored cells per axis of a voxel's faces: 0, 4 or 8
    bool occupancy = true;       ///< stores which of 4 x 4 x 4 cells of a voxel contain geometry
    bool correlation = false;    ///< stores how much the occlusion of neighbours overlaps
    bool keep_masks = false;     ///< stores columns and sums, so that levels can be rebuilt exactly
    LodMethod lod = LodMethod::Moments;
    std::optional<int> levels{}; ///< most levels above the finest; none: all
    std::uint64_t seed = 0;
    std::optional<std::int64_t> memory_bytes{}; ///< limit; none: half of the free memory

    Backend backend = Backend::Sample;
    std::optional<raster::Composition>
        composition{};                     ///< this and the next two: for Backend::Raster
    std::optional<double> slice_spacing{}; ///< largest distance, scene units
    std::optional<raster::RasterPath> raster_path{};
    DeviceChoice device = DeviceChoice::Auto;
    std::optional<std::int64_t> device_memory_bytes{}; ///< limit; none: 9/10 of the free memory

    std::optional<std::string> spool_dir{}; ///< folder for the spool; none: that of the output
    std::string command{};                  ///< is stored in the result
};

/// Checks that the options can be used together and are in range.
/// @throws OptionError  they cannot, or are not
void check_voxelize_options(const VoxelizeJobOptions& options);

/// Returns the options of the function heddle::voxelize.
/// @throws OptionError  as check_voxelize_options
[[nodiscard]] VoxelizeOptions voxelizer_options(const VoxelizeJobOptions& options);

/// Returns the options of SliceVoxelizer.
[[nodiscard]] raster::RasterOptions raster_options(const VoxelizeJobOptions& options);

} // namespace heddle::job
