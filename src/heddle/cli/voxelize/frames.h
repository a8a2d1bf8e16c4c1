#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/voxelize/voxelize_frames.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle::cli {

/// Returns the row of --frames, which asks for a sequence.
[[nodiscard]] std::vector<Option> frame_rows();

/// Returns the numbers of "A-B" or "A-B:STEP".
/// @throws UsageError  the text has neither form, or gives more than a million numbers
[[nodiscard]] std::vector<std::int64_t> parse_frames(const std::string& text);

/// Replaces the %0Nd of a pattern by a number of at least N digits.
/// @param option       name of the option that gave the pattern, for the message
/// @throws UsageError  there is not exactly one %0Nd, or another %
[[nodiscard]] std::string
frame_path(const std::string& pattern, std::int64_t number, const std::string& option);

/// Returns the files that --frames, FILE and --output name.
/// @throws UsageError  as parse_frames and frame_path
[[nodiscard]] std::vector<job::AnimationFrame> frames_from(const Arguments& arguments);

} // namespace heddle::cli
