#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/geometry.h>
#include <heddle/voxelize/voxelize.h>

#include <cstdint>
#include <memory>
#include <string>

namespace heddle::raster {

/// How the fragments of slices in a voxel are combined to its density.        [LopezMoreno17, 3.5]
enum class Composition : std::uint8_t {
    Last,      ///< alpha of the last slice's last subvoxel: as in the paper, but reproducible
    Average,   ///< mean alpha of all fragments, including transparent ones
    Max,       ///< largest alpha
    Accumulate ///< columns of the fibers themselves, as in the sampling voxelizer
};

/// How slices are drawn. Both ways give the same voxels.
enum class RasterPath : std::uint8_t {
    Auto,     ///< the faster one: known for software drivers, timed on others
    Fragment, ///< quads with one fragment per pixel
    Compute   ///< compute shaders that loop over the quads' pixels
};

/// The options of the rasterizing voxelizer in addition to VoxelizeOptions.
struct RasterOptions {
    Composition composition = Composition::Accumulate;
    double slice_spacing = 0.0; ///< largest spacing, scene units; 0: half of the yarn's radius
    RasterPath path = RasterPath::Auto;
};

/// Counts and times of a run of the rasterizing voxelizer.
struct RasterCounts {
    std::int64_t slices = 0;
    std::int64_t bricks = 0;  ///< number of touched bricks of 8 x 8 x 8 voxels
    std::int64_t batches = 0; ///< number of batches, each as many bricks as one buffer holds
    std::string driver;
    RasterPath path = RasterPath::Auto; ///< the path that was used; Auto if nothing was drawn
    double setup_seconds = 0.0;         ///< sections, slices and occupied bricks
    double draw_seconds = 0.0;          ///< three passes and reading their sums
    double fit_seconds = 0.0;           ///< fitting voxels and building levels
};

/// Voxelizes yarns and hair by OpenGL, one geometry after another. The context, the programs, the
/// memory of sums and, if the yarn types stay the same, their sections are reused. Not thread-safe.
class SliceVoxelizer {
public:
    /// The context is opened at the first use.
    explicit SliceVoxelizer(const RasterOptions& raster);
    ~SliceVoxelizer();
    SliceVoxelizer(const SliceVoxelizer&) = delete;
    SliceVoxelizer& operator=(const SliceVoxelizer&) = delete;

    /// Voxelizes a geometry. Slices are drawn along three axes, one column of subvoxels per pixel,
    /// into integer sums, so the result is independent of draw order and of earlier draws.
    ///   [LopezMoreno17, 3; docs/raster.md]
    /// @param plan     result of plan_voxelize(); sets lattice, region and spool
    /// @param visitor  as for heddle::voxelize()
    /// @throws Error   Device, OutOfMemory: see Context; Unsupported: meshes, a procedural yarn,
    ///                 more bricks than a buffer's table holds; as plan_voxelize(); Cancelled
    [[nodiscard]] std::unique_ptr<VoxelLevel> voxelize(const Geometry& geometry,
                                                       const VoxelizeOptions& options,
                                                       const VoxelizePlan& plan,
                                                       Progress& progress,
                                                       BlockVisitor* visitor = nullptr,
                                                       RasterCounts* counts = nullptr);

    /// Returns the bytes of host memory for drawing in addition to `plan`: the sums that are read
    /// back, and if the driver uses host memory, also its sums, the slices and the driver itself.
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

/// Voxelizes one geometry by a SliceVoxelizer.
[[nodiscard]] std::unique_ptr<VoxelLevel> voxelize_slices(const Geometry& geometry,
                                                          const VoxelizeOptions& options,
                                                          const RasterOptions& raster,
                                                          const VoxelizePlan& plan,
                                                          Progress& progress,
                                                          BlockVisitor* visitor = nullptr,
                                                          RasterCounts* counts = nullptr);

} // namespace heddle::raster
