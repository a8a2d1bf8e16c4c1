#pragma once

#include <heddle/voxelize/voxelize.h>

#include <cstdint>
#include <functional>

namespace heddle::job {

/// Voxels along the longest axis: as many as fit into memory without a temporary file, to 2 %, as
/// [LopezMoreno17, 3.4] chooses its resolution.
/// @param options  its memory, else half of what is free; its voxels are not looked at
/// @param plan_of  the plan for options, with all that will take memory
/// @throws Error   OutOfMemory: not even 16 fit; as `plan_of`
[[nodiscard]] std::int64_t
resolution_for_memory(const VoxelizeOptions& options,
                      const std::function<VoxelizePlan(const VoxelizeOptions&)>& plan_of);

} // namespace heddle::job
