#pragma once

#include <heddle/job/voxelize/voxelize.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle::job {

/// One frame of an animation.
struct AnimationFrame {
    std::int64_t number = 0;       ///< for messages
    std::string input{}, output{}; ///< paths
};

/// Calls voxelize_to_file() for each frame with one Voxelizer. If a frame fails, the files of the
/// frames before it remain. Each frame is a part of the progress (Progress::begin_part).
/// @param geometry  options for the geometry of all frames
/// @return          one report per frame
/// @throws OptionError  as voxelize_to_file
/// @throws Error        as voxelize_to_file, with the frame's number and file in the text
std::vector<VoxelizeReport> voxelize_frames(const std::vector<AnimationFrame>& frames,
                                            const GeometryOptions& geometry,
                                            const VoxelizeJobOptions& options,
                                            Progress& progress);

/// Calls plan_voxelize() for each frame.
/// @throws Error  as voxelize_frames
[[nodiscard]] std::vector<VoxelizeReport> plan_frames(const std::vector<AnimationFrame>& frames,
                                                      const GeometryOptions& geometry,
                                                      const VoxelizeJobOptions& options,
                                                      Progress& progress);

} // namespace heddle::job
