#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/phase_clock.h>
#include <heddle/preview/preview.h>

#include <cstdint>
#include <string>

namespace heddle::job {

/// What was drawn.
struct PreviewReport {
    std::int64_t voxels = 0; ///< of the level that is shown
    std::int32_t width = 0;  ///< px
    std::int32_t height = 0;
    PhaseTimes phases{};
};

/// Draws a quick picture of one level of a .vdb. For voxels in memory, call render_preview.
/// @param level   0: the finest
/// @throws Error  as read_vdb and render_preview; Cancelled
[[nodiscard]] PreviewImage preview_volume(const std::string& path,
                                          int level,
                                          const PreviewOptions& options,
                                          Progress& progress);

/// Draws one level of a .vdb and writes a .png.
/// @throws OptionError  `output` has another suffix
/// @throws Error        as preview_volume; CannotWrite
PreviewReport preview_volume_to_file(const std::string& path,
                                     const std::string& output,
                                     int level,
                                     const PreviewOptions& options,
                                     Progress& progress);

} // namespace heddle::job
