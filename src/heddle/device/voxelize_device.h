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

/// What a run on the device took.
struct DeviceReport {
    std::int64_t peak_bytes = 0; ///< of device memory
    std::int64_t batches = 0;
    double upload_seconds = 0.0;                        ///< geometry to the device, fibers placed
    double count_seconds = 0.0;                         ///< primitives counted by block
    double batch_seconds = 0.0;                         ///< the rest
    std::vector<std::pair<std::string, double>> stages; ///< seconds of launches, with time_phases
};

/// How the device is used. Nothing is required.
struct DeviceOptions {
    /// of the device that may be in use at once; 0: 9/10 of what is free
    std::int64_t memory_bytes = 0;
    int streams = 2; ///< batches that are on their way at once, each by a thread of the host
    std::int64_t batches = 0;       ///< at least so many; 0: as memory needs
    bool time_phases = false;       ///< each launch is waited for: slower as a whole
    DeviceReport* report = nullptr; ///< gets what the run took
};

/// Why the device does not do what is asked, though the CPU does: CoverageMode::Mask,
/// FitMode::Last.
/// Empty: it does.
[[nodiscard]] std::string device_limitation(const VoxelizeOptions& options);

/// voxelize() by the pipeline of the device, on a CUDA device: the same voxels and levels, bit for
/// bit.
/// @param levels  built above level 0 too; null: none
/// @throws Error  as voxelize(); Unsupported: device_limitation(); OutOfMemory: `memory_bytes` is
///                below what one block takes; Device: there is none, or it failed
[[nodiscard]] std::unique_ptr<VoxelLevel> voxelize_on_cuda(const Geometry& geometry,
                                                           const VoxelizeOptions& options,
                                                           const VoxelizePlan& plan,
                                                           const DeviceOptions& device,
                                                           Progress& progress,
                                                           LevelBuilder* levels = nullptr);

/// The same pipeline on the threads of the host: what machines without a GPU test. Slower than
/// voxelize().
[[nodiscard]] std::unique_ptr<VoxelLevel> voxelize_on_host_executor(const Geometry& geometry,
                                                                    const VoxelizeOptions& options,
                                                                    const VoxelizePlan& plan,
                                                                    const DeviceOptions& device,
                                                                    Progress& progress,
                                                                    LevelBuilder* levels = nullptr);

} // namespace heddle
