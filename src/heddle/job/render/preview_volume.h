#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/stage_clock.h>
#include <heddle/preview/preview.h>

#include <cstdint>
#include <string>

namespace heddle::job {

struct PreviewReport {
    std::int64_t voxels = 0; ///< of the level
    std::int32_t width = 0;  ///< px
    std::int32_t height = 0;
    StageTimes stages{};
};

/// A picture of one level of a .vdb; of voxels in memory: render_preview.
/// @param level   0: the finest
/// @throws Error  as read_vdb and render_preview; Cancelled
[[nodiscard]] PreviewImage preview_volume(const std::string& path,
                                          int level,
                                          const PreviewOptions& options,
                                          Progress& progress);

/// The same into a .png.
/// @throws OptionError  another suffix
/// @throws Error        as preview_volume; CannotWrite
PreviewReport preview_volume_to_file(const std::string& path,
                                     const std::string& output,
                                     int level,
                                     const PreviewOptions& options,
                                     Progress& progress);

} // namespace heddle::job
