#pragma once

#include <heddle/geom/bounds.h>
#include <heddle/lod/method.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/voxelize/voxelize_options.h>

#include <cstdint>
#include <optional>
#include <string>

namespace heddle::job {

/// What voxels are made from.
enum class Backend : std::uint8_t {
    Sample, ///< fibers and triangles, on the CPU or a CUDA device
    Raster  ///< slices of yarns and hair, drawn by OpenGL
};

/// Where Backend::Sample works; all give the same bits.
enum class DeviceChoice : std::uint8_t {
    Auto, ///< CUDA where there is a device and it does what is asked, else the CPU
    Cpu,
    Cuda
};

/// What is asked of a voxelization. Nothing is required.
struct VoxelizeJobOptions {
    std::optional<Vec3d> voxel_size{};    ///< scene units per axis
    std::optional<std::int64_t> voxels{}; ///< along the longest axis; with neither: 512
    bool fill_memory = false;             ///< instead of both: as many voxels as fit into memory
    std::optional<Bounds> bounds{};       ///< scene units; voxels that it touches are kept
    std::int32_t lobes = 3;               ///< most in a voxel, 1 to 8
    std::int32_t subvoxels = 8;           ///< per voxel axis: 1, 2, 4 or 8
    CoverageMode coverage = CoverageMode::Columns;
    std::int64_t samples = 0; ///< per span, with CoverageMode::Mask; 0: two a subvoxel
    FitMode fit = FitMode::Moments;
    std::optional<std::int32_t>
        footprints{};         ///< cells per axis that are kept: 0, 4 or 8; none: 4 of
                              ///< yarn and hair, else 0
    bool correlation = false; ///< keeps how far neighbours hide the same
    bool keep_masks = false;  ///< keeps columns and sums, which levels are built from
    LodMethod lod = LodMethod::Moments;
    std::optional<int> levels{}; ///< above the finest, at most; none: all
    std::uint64_t seed = 0;
    std::optional<std::int64_t> memory_bytes{}; ///< kept to; none: half of what is free

    Backend backend = Backend::Sample;
    std::optional<raster::Composition> composition{}; ///< these three: of Backend::Raster
    std::optional<double> slice_spacing{};            ///< scene units, at most
    std::optional<raster::RasterPath> raster_path{};
    DeviceChoice device = DeviceChoice::Auto;
    std::optional<std::int64_t> device_memory_bytes{}; ///< kept to; none: 9/10 of what is free

    std::optional<std::string> spool_dir{}; ///< for a temporary file; none: where the output goes
    std::string command{};                  ///< is kept in the result
};

/// @throws OptionError  options that do not go together
void check_voxelize_options(const VoxelizeJobOptions& options);

/// The voxelizer's own options.
/// @param curves_alone  the geometry has no mesh
/// @throws OptionError  as check_voxelize_options
[[nodiscard]] VoxelizeOptions voxelizer_options(const VoxelizeJobOptions& options,
                                                bool curves_alone);

/// What says how slices are drawn.
[[nodiscard]] raster::RasterOptions raster_options(const VoxelizeJobOptions& options);

} // namespace heddle::job
