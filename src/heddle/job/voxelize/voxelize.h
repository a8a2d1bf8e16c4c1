#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/geometry_input.h>
#include <heddle/job/levels.h>
#include <heddle/job/phase_clock.h>
#include <heddle/job/voxelize/voxelize_options.h>
#include <heddle/voxelize/plan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// What was used of a CUDA device. In a plan, all numbers are 0.
struct DeviceUse {
    std::string name{};
    std::int64_t peak_bytes = 0; ///< of device memory
    std::int64_t batches = 0;
    double upload_seconds = 0.0;
};

/// What a voxelization did, or what a plan predicts. In a plan, the results are empty.
struct VoxelizeReport {
    VoxelizePlan plan{};
    std::int64_t predicted_file_bytes = 0; ///< of a .vdb with all levels
    std::vector<std::string> notes{};      ///< what was assumed, one sentence each
    std::optional<DeviceUse> device{};     ///< none: the CPU voxelizes
    std::optional<raster::RasterCounts> raster{};
    LevelCounts counts{};
    std::optional<double>
        levels_thread_seconds{}; ///< summed over threads; none: no levels were built
    std::int64_t file_bytes = 0; ///< of the .vdb; 0: none was written
    PhaseTimes phases{};
    double seconds = 0.0;
    std::int64_t peak_bytes = 0; ///< peak resident memory of the process
};

/// Voxels in memory.
struct VoxelizeResult {
    VoxelLevels levels{}; ///< finest first
    VoxelizeReport report{};
};

/// Voxelizes one input after another and reuses what was set up: the OpenGL context and programs.
/// Must be used on one thread, while nothing else uses OpenGL on that thread.
class Voxelizer {
public:
    /// Checks the options. The OpenGL context is opened later, when it is needed.
    /// @throws OptionError  the options cannot be used together
    explicit Voxelizer(VoxelizeJobOptions options);
    ~Voxelizer();
    Voxelizer(const Voxelizer&) = delete;
    Voxelizer& operator=(const Voxelizer&) = delete;

    /// As job::plan_voxelize().
    [[nodiscard]] VoxelizeReport plan(GeometryInput input, Progress& progress);
    /// As job::voxelize().
    [[nodiscard]] VoxelizeResult voxelize(GeometryInput input, Progress& progress);
    /// As job::voxelize_to_file().
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

/// Returns the lattice and predicts voxels, bytes and seconds; writes nothing. With `fill_memory`,
/// finds the resolution.
/// @throws OptionError  options cannot be used together or do not apply to the geometry
/// @throws Error        as load_geometry, heddle::plan_voxelize, SliceVoxelizer and choose_device;
///                      Cancelled
[[nodiscard]] VoxelizeReport
plan_voxelize(GeometryInput input, const VoxelizeJobOptions& options, Progress& progress);

/// Voxelizes curves or meshes and builds their levels of detail, in memory.
/// @throws Error  as plan_voxelize
[[nodiscard]] VoxelizeResult
voxelize(GeometryInput input, const VoxelizeJobOptions& options, Progress& progress);

/// Voxelizes curves or meshes and writes a .vdb, which appears complete or not at all.
/// @throws OptionError  also: `output` does not end in .vdb
/// @throws Error        as plan_voxelize; CannotWrite, if possible before the work starts
VoxelizeReport voxelize_to_file(GeometryInput input,
                                const std::string& output,
                                const VoxelizeJobOptions& options,
                                Progress& progress);

} // namespace heddle::job
