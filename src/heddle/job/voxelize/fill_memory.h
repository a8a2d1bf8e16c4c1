#pragma once

#include <heddle/voxelize/voxelize.h>

#include <cstdint>
#include <functional>

namespace heddle::job {

/// Returns the resolution along the longest axis that fits into memory without a temporary file,
/// within 2 % [LopezMoreno17, 3.4].
/// @param options  gives the memory limit (0: half of the free memory); its resolution is unused
/// @param plan_of  returns the plan for options, including all memory that will be used
/// @throws Error   OutOfMemory: not even 16 voxels fit; as `plan_of`
[[nodiscard]] std::int64_t
resolution_for_memory(const VoxelizeOptions& options,
                      const std::function<VoxelizePlan(const VoxelizeOptions&)>& plan_of);

} // namespace heddle::job
