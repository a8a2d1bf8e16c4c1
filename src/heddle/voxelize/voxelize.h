#pragma once

#include <heddle/base/progress.h>
#include <heddle/voxelize/plan.h>

#include <memory>

namespace heddle {

/// Voxelizes `geometry`: same bits for any thread count, memory limit and batch size; a region
/// (`options.bounds`) gives the same voxels as the whole.      [Fabre26, 3; docs/voxelizer.md]
/// @param geometry  as it was when `plan` was made
/// @param plan      of plan_voxelize(); other options than those that it was made for are followed,
///                  but for what the plan has itself: lattice, range of voxels, batches
/// @throws Error  as plan_voxelize; Cancelled
[[nodiscard]] std::unique_ptr<VoxelLevel> voxelize(const Geometry& geometry,
                                                   const VoxelizeOptions& options,
                                                   const VoxelizePlan& plan,
                                                   Progress& progress,
                                                   BlockVisitor* visitor = nullptr);

} // namespace heddle
