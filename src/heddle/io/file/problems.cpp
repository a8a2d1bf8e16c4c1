#include <heddle/io/file/problems.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <tuple>

namespace heddle {

std::string to_string(const FileLocation& location) {
    return location.line > 0 ? str(location.path, ":", location.line) : location.path;
}

void Problems::add(const FileLocation& location, const std::string& what, const std::string& fix) {
    const auto at = std::find(files_.begin(), files_.end(), location.path);
    const auto file = static_cast<std::size_t>(at - files_.begin());
    if (at == files_.end()) files_.push_back(location.path);
    problems_.push_back(
        {file, location.line, str(to_string(location), ": ", what, fix.empty() ? "" : "; ", fix)});
}

void Problems::throw_if_any() {
    if (problems_.empty()) return;
    constexpr std::size_t kMax = 100; // a file with more is of another kind
    std::stable_sort(problems_.begin(), problems_.end(), [](const Problem& a, const Problem& b) {
        const bool a_whole = a.line <= 0, b_whole = b.line <= 0;
        return std::tie(a.file, a_whole, a.line) < std::tie(b.file, b_whole, b.line);
    });
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < std::min(kMax, problems_.size()); ++i) {
        lines.push_back(problems_[i].text);
    }
    if (problems_.size() > kMax) lines.push_back(str("and ", problems_.size() - kMax, " more"));
    throw Error::of_lines(ErrorCode::BadFile, lines);
}

} // namespace heddle
