#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxelize/plan.h>

#include <memory>

namespace heddle {

/// Voxelizes `geometry`. The result has the same bits for any thread count, memory limit and batch
/// size. A region (`options.bounds`) has the same voxels as the whole. [Fabre26, 3;
/// docs/voxelizer.md]
/// @param geometry  unchanged since `plan` was made
/// @param options   may differ from those of `plan`, but lattice, voxel range and batches are the
///                  plan's
/// @param plan      result of plan_voxelize()
/// @param visitor   receives each finished block; may be null
/// @return          level 0
/// @throws Error    as plan_voxelize(); Cancelled
[[nodiscard]] std::unique_ptr<VoxelLevel> voxelize(const Geometry& geometry,
                                                   const VoxelizeOptions& options,
                                                   const VoxelizePlan& plan,
                                                   Progress& progress,
                                                   BlockVisitor* visitor = nullptr);

} // namespace heddle
