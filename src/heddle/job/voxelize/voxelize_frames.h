#pragma once

#include <heddle/job/voxelize/voxelize.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle::job {

/// One file of a sequence.
struct AnimationFrame {
    std::int64_t number = 0; ///< for messages
    std::string input{}, output{};
};

/// voxelize_to_file() for each frame, in one run: what is set up for one serves the next. What was
/// written before a frame fails stays. Each frame is a part (Progress::begin_part).
/// @param geometry  of each frame
/// @return          one a frame
/// @throws OptionError  as voxelize_to_file
/// @throws Error        as voxelize_to_file, with the frame's number and file in the text
std::vector<VoxelizeReport> voxelize_frames(const std::vector<AnimationFrame>& frames,
                                            const GeometryOptions& geometry,
                                            const VoxelizeJobOptions& options,
                                            Progress& progress);

/// plan_voxelize() for each frame.
/// @throws Error  as voxelize_frames
[[nodiscard]] std::vector<VoxelizeReport> plan_frames(const std::vector<AnimationFrame>& frames,
                                                      const GeometryOptions& geometry,
                                                      const VoxelizeJobOptions& options,
                                                      Progress& progress);

} // namespace heddle::job
