#include <heddle/cli/rows/level_rows.h>

#include <heddle/base/error.h>
#include <heddle/cli/terminal/text.h>

#include <string>

namespace heddle::cli {
namespace {

std::vector<std::string> method_names() {
    return {kLodMethodNames.begin(), kLodMethodNames.end()};
}

} // namespace

std::vector<Option> level_rows() {
    return grouped(
        "Levels of detail",
        {
            {"--levels", "N", "all", any_text(), "",
             "Maximum number of levels above the finest; all: until at most two voxels per axis are left."},
            {"--lod", "METHOD", "moments", one_of(method_names()), "",
             "Method of merging lobes into the next level; moments and wasserstein keep up to --lobes per voxel."},
        });
}

LodMethod lod_method_from(const Arguments& arguments) {
    return lod_method_of(arguments.text("lod")).value();
}

std::optional<int> level_count_from(const Arguments& arguments) {
    const std::string levels = arguments.text("levels");
    if (levels == "all") return std::nullopt;
    const std::optional<std::int64_t> count = parse_integer(levels);
    if (!count || *count < 0 || *count > kMaxLevel) {
        throw UsageError(str("--levels: '", levels, "' is not all or 0 to ", kMaxLevel));
    }
    return static_cast<int>(*count);
}

} // namespace heddle::cli
