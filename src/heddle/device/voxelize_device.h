#pragma once

#include <heddle/base/progress.h>
#include <heddle/executor/device.h>
#include <heddle/lod/build_levels.h>
#include <heddle/voxelize/voxelize.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace heddle {

/// The costs of a run on the device.
struct DeviceReport {
    std::int64_t peak_bytes = 0; ///< peak of the device memory in use
    std::int64_t batches = 0;
    double upload_seconds = 0.0;                        ///< placing fibers, uploading geometry
    double count_seconds = 0.0;                         ///< counting primitives by block
    double batch_seconds = 0.0;                         ///< the rest
    std::vector<std::pair<std::string, double>> stages; ///< seconds of launches, with time_phases
};

/// How the device is used. All options have defaults.
struct DeviceOptions {
    /// limit of the device memory in use; 0: 9/10 of the free memory
    std::int64_t memory_bytes = 0;
    int streams = 2;          ///< batches that are processed at once, each by a thread of the host
    std::int64_t batches = 0; ///< smallest number of batches; 0: as memory requires
    bool time_phases = false; ///< wait for each launch and time it; the run is slower
    DeviceReport* report = nullptr; ///< receives the costs of the run; may be null
};

/// Returns why the device does not support the options, which are CoverageMode::Mask or
/// FitMode::Last; empty if it does.
[[nodiscard]] std::string device_limitation(const VoxelizeOptions& options);

/// Voxelizes on a CUDA device. Voxels and levels have the same bits as those of voxelize().
/// @param levels  builder of the levels above 0; may be null
/// @throws Error  as voxelize(); Unsupported: device_limitation(); OutOfMemory: `memory_bytes` is
///                too small for one block; Device: there is no device, or it failed
[[nodiscard]] std::unique_ptr<VoxelLevel> voxelize_on_cuda(const Geometry& geometry,
                                                           const VoxelizeOptions& options,
                                                           const VoxelizePlan& plan,
                                                           const DeviceOptions& device,
                                                           Progress& progress,
                                                           LevelBuilder* levels = nullptr);

/// Does the same on the threads of the host, for tests on machines without a GPU. It is slower than
/// voxelize().
[[nodiscard]] std::unique_ptr<VoxelLevel> voxelize_on_host_executor(const Geometry& geometry,
                                                                    const VoxelizeOptions& options,
                                                                    const VoxelizePlan& plan,
                                                                    const DeviceOptions& device,
                                                                    Progress& progress,
                                                                    LevelBuilder* levels = nullptr);

} // namespace heddle
