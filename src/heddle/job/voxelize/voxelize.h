#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/geometry_input.h>
#include <heddle/job/levels.h>
#include <heddle/job/stage_clock.h>
#include <heddle/job/voxelize/voxelize_options.h>
#include <heddle/voxelize/plan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// What a CUDA device took.
struct DeviceUse {
    std::string name{};
    std::int64_t peak_bytes = 0; ///< of its memory; this and the rest: 0 in a plan
    std::int64_t batches = 0;
    double upload_seconds = 0.0;
};

/// What a voxelization did, or would do: then all below `file_bytes` is empty but the notes.
struct VoxelizeReport {
    VoxelizePlan plan{};
    std::int64_t predicted_file_bytes = 0; ///< of a .vdb of all levels
    std::vector<std::string> notes{};      ///< what was assumed, one sentence each
    std::optional<DeviceUse> device{};     ///< none: not on a device
    std::optional<raster::RasterCounts> raster{};
    LevelCounts counts{};
    std::optional<double> levels_thread_seconds{}; ///< of all threads; none: no levels were built
    std::int64_t file_bytes = 0;                   ///< of the .vdb; 0: none was written
    StageTimes stages{};
    double seconds = 0.0;
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

struct VoxelizeResult {
    VoxelLevels levels{}; ///< finest first
    VoxelizeReport report{};
};

/// Voxelizes one input after another: what is set up for one, a driver's context and its programs,
/// serves the next. To be used on one thread, while nothing else uses OpenGL on it.
class Voxelizer {
public:
    /// Opens nothing yet.
    /// @throws OptionError  options that do not go together
    explicit Voxelizer(VoxelizeJobOptions options);
    ~Voxelizer();
    Voxelizer(const Voxelizer&) = delete;
    Voxelizer& operator=(const Voxelizer&) = delete;

    /// What voxelize_to_file() would do; writes nothing.
    [[nodiscard]] VoxelizeReport plan(GeometryInput input, Progress& progress);
    [[nodiscard]] VoxelizeResult voxelize(GeometryInput input, Progress& progress);
    VoxelizeReport
    voxelize_to_file(GeometryInput input, const std::string& output, Progress& progress);

private:
    struct Run;
    [[nodiscard]] std::unique_ptr<Run>
    prepare(GeometryInput input, const std::string& folder, bool writes, Progress& progress);
    [[nodiscard]] VoxelizePlan
    plan_of(const Run& run, const VoxelizeOptions& options, LevelBuilder* builder, Progress& clock);
    [[nodiscard]] std::unique_ptr<LevelBuilder> make_builder() const;
    [[nodiscard]] std::unique_ptr<VoxelLevel> make_voxels(Run& run);
    [[nodiscard]] VoxelLevels make_levels(Run& run);

    VoxelizeJobOptions options_;
    raster::SliceVoxelizer slice_voxelizer_;
};

/// Lattice, predicted voxels, bytes and time; with `fill_memory` the resolution that was found.
/// @throws OptionError  options that do not go together, or that the geometry has no use for
/// @throws Error        as load_geometry, plan_voxelize and SliceVoxelizer; Device: `device` cuda,
///                      and there is none; Unsupported: it does not do this; Cancelled
[[nodiscard]] VoxelizeReport
plan_voxelize(GeometryInput input, const VoxelizeJobOptions& options, Progress& progress);

/// Curves or meshes to voxels with their levels of detail, in memory.
/// @throws Error  as plan_voxelize
[[nodiscard]] VoxelizeResult
voxelize(GeometryInput input, const VoxelizeJobOptions& options, Progress& progress);

/// Curves or meshes to a .vdb, which appears whole or not at all.
/// @throws Error  as plan_voxelize; CannotWrite, said before the work starts where that is known
VoxelizeReport voxelize_to_file(GeometryInput input,
                                const std::string& output,
                                const VoxelizeJobOptions& options,
                                Progress& progress);

} // namespace heddle::job
