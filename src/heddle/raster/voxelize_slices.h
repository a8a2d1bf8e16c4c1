#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/geometry.h>
#include <heddle/voxelize/voxelize.h>

#include <cstdint>
#include <memory>
#include <string>

namespace heddle::raster {

/// How fragments of slices that meet in a voxel become its density.           [LopezMoreno17, 3.5]
enum class Composition : std::uint8_t {
    Last,      ///< alpha of the highest slice's highest subvoxel: the paper's, the same every run
    Average,   ///< mean alpha of all fragments, clear ones too
    Max,       ///< largest alpha
    Accumulate ///< columns of the fibers themselves, as the sampling voxelizer has them
};

/// What draws slices: both give the same voxels.
enum class RasterPath : std::uint8_t {
    Auto,     ///< the faster: known of software drivers, tried out on others
    Fragment, ///< quads, a fragment a pixel
    Compute   ///< compute shaders that walk over the quads' pixels
};

/// What the rasterizing voxelizer is asked for beside VoxelizeOptions.
struct RasterOptions {
    Composition composition = Composition::Accumulate;
    double slice_spacing = 0.0; ///< scene units, at most; 0: half of the yarn's radius
    RasterPath path = RasterPath::Auto;
};

/// What it did.
struct RasterCounts {
    std::int64_t slices = 0;
    std::int64_t bricks = 0;  ///< of 8 x 8 x 8 voxels, touched
    std::int64_t batches = 0; ///< of as many bricks as one buffer holds
    std::string driver;
    RasterPath path = RasterPath::Auto; ///< that was taken; Auto where nothing was drawn
    double setup_seconds = 0.0;         ///< sections, slices, occupied bricks
    double draw_seconds = 0.0;          ///< three passes, until their sums are read
    double fit_seconds = 0.0;           ///< sums to voxels, and levels
};

/// Voxelizes yarns and hair by OpenGL, one geometry after another: the driver's context, its
/// programs, the memory of sums and, where the kinds of yarns stay the same, their sections are
/// kept. To be used on one thread.
class SliceVoxelizer {
public:
    /// Opens nothing yet.
    explicit SliceVoxelizer(const RasterOptions& raster);
    ~SliceVoxelizer();
    SliceVoxelizer(const SliceVoxelizer&) = delete;
    SliceVoxelizer& operator=(const SliceVoxelizer&) = delete;

    /// Slices seen along three axes, one column of subvoxels a pixel, into integer sums that
    /// neither the order of drawing nor what was drawn before shows in.
    ///   [LopezMoreno17, 3; docs/raster.md]
    /// @param plan     of plan_voxelize; grid, region and spool are taken from it
    /// @param visitor  as for voxelize
    /// @throws Error   Device, OutOfMemory: see Context; Unsupported: meshes, a procedural yarn,
    ///                 more bricks than a buffer's table holds; as plan_voxelize; Cancelled
    [[nodiscard]] std::unique_ptr<VoxelLevel> voxelize(const Geometry& geometry,
                                                       const VoxelizeOptions& options,
                                                       const VoxelizePlan& plan,
                                                       Progress& progress,
                                                       BlockVisitor* visitor = nullptr,
                                                       RasterCounts* counts = nullptr);

    /// What drawing takes beside `plan`, bytes: sums on the driver and read back, slices, and the
    /// driver itself. All of it where the driver's memory is the host's; else what is read back.
    /// Opens the context.
    /// @throws Error  Device
    [[nodiscard]] std::int64_t predict_bytes(const Geometry& geometry,
                                             const VoxelizeOptions& options,
                                             const VoxelizePlan& plan);

private:
    struct Kept;
    Kept& open();
    RasterOptions raster_;
    std::unique_ptr<Kept> kept_;
};

/// A SliceVoxelizer's voxelize, for one geometry.
[[nodiscard]] std::unique_ptr<VoxelLevel> voxelize_slices(const Geometry& geometry,
                                                          const VoxelizeOptions& options,
                                                          const RasterOptions& raster,
                                                          const VoxelizePlan& plan,
                                                          Progress& progress,
                                                          BlockVisitor* visitor = nullptr,
                                                          RasterCounts* counts = nullptr);

} // namespace heddle::raster
