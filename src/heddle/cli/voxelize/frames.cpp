#include <heddle/cli/voxelize/frames.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace heddle::cli {
namespace {

constexpr std::int64_t kMaxFrames = 1'000'000;

/// Removes a number from the front of a text and returns it; -1: there is none, or it has more than
/// nine digits.
std::int64_t take_number(std::string_view& text) {
    std::int64_t number = -1;
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    const auto end = std::find_if_not(text.begin(), text.end(), digit);
    const auto digits = static_cast<std::size_t>(end - text.begin());
    if (digits == 0 || digits > 9) return number;
    std::from_chars(text.data(), text.data() + digits, number);
    text.remove_prefix(digits);
    return number;
}

bool take(std::string_view& text, char c) {
    if (text.empty() || text.front() != c) return false;
    text.remove_prefix(1);
    return true;
}

} // namespace

std::vector<Option> frame_rows() {
    return grouped(
        "Input and output",
        {{"--frames", "A-B[:STEP]", "(a single file)", any_text(), "",
          "Voxelizes a sequence: FILE and OUT.vdb contain the frame number as %04d. Give --voxel-size, or the voxel size differs between frames."}});
}

std::vector<std::int64_t> parse_frames(const std::string& text) {
    std::string_view rest = text;
    const std::int64_t first = take_number(rest);
    const std::int64_t last = take(rest, '-') ? take_number(rest) : -1;
    const std::int64_t step = take(rest, ':') ? take_number(rest) : 1;
    if (first < 0 || last < first || step < 1 || !rest.empty()) {
        throw UsageError(
            str("--frames: '", text,
                "' is not a range; give A-B or A-B:STEP with A <= B, for example 1-24:2"));
    }
    const std::int64_t count = (last - first) / step + 1;
    if (count > kMaxFrames) {
        throw UsageError(str("--frames: '", text, "' has ", count, " frames; the limit is 10^6"));
    }
    std::vector<std::int64_t> numbers;
    for (std::int64_t i = 0; i < count; ++i) numbers.push_back(first + i * step);
    return numbers;
}

std::string frame_path(const std::string& pattern, std::int64_t number, const std::string& option) {
    const std::size_t at = pattern.find('%');
    std::string_view rest = pattern;
    rest.remove_prefix(std::min(at, pattern.size()));
    const bool zero = take(rest, '%') && take(rest, '0');
    const std::int64_t width = zero ? take_number(rest) : -1;
    if (width < 1 || width > 9 || !take(rest, 'd') || rest.find('%') != std::string_view::npos) {
        throw UsageError(
            str(option, ": '", pattern,
                "' must contain the frame number exactly once, as %04d, with --frames"));
    }
    std::string digits = std::to_string(number);
    const auto least = static_cast<std::size_t>(width);
    if (digits.size() < least) digits.insert(0, least - digits.size(), '0');
    return pattern.substr(0, at) + digits + std::string(rest);
}

std::vector<job::AnimationFrame> frames_from(const Arguments& arguments) {
    std::vector<job::AnimationFrame> frames;
    for (const std::int64_t number : parse_frames(arguments.text("frames"))) {
        frames.push_back({number, frame_path(arguments.text("FILE"), number, "FILE"),
                          frame_path(arguments.text("output"), number, "--output")});
    }
    return frames;
}

} // namespace heddle::cli
