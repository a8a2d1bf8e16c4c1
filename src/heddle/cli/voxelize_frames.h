#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>

namespace heddle::cli {

/// voxelize_file() for each frame of --frames, in one run: what is set up for one serves the next. What
/// was written before a frame fails stays.
/// @throws Error       as voxelize_file, with the frame's file in the text
/// @throws UsageError  as frames_from; a .vol
void voxelize_frames(const Arguments& arguments, Report& report, ProgressBar& bar);

} // namespace heddle::cli
