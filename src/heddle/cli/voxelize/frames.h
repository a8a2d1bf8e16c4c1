#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/job/voxelize/voxelize_frames.h>

#include <cstdint>
#include <string>
#include <vector>

namespace heddle::cli {

/// The row that asks for a sequence: --frames.
[[nodiscard]] std::vector<Option> frame_rows();

/// The numbers of "A-B" or "A-B:STEP".
/// @throws UsageError  it is neither, or holds more than a million
[[nodiscard]] std::vector<std::int64_t> parse_frames(const std::string& text);

/// `pattern` with `number` in place of its one %0Nd, which is N digits or more.
/// @param option  that gave the pattern, for the message
/// @throws UsageError  none, more than one, or another %
[[nodiscard]] std::string
frame_path(const std::string& pattern, std::int64_t number, const std::string& option);

/// The files that --frames, FILE and --output name.
/// @throws UsageError  as above
[[nodiscard]] std::vector<job::AnimationFrame> frames_from(const Arguments& arguments);

} // namespace heddle::cli
