#include <heddle/cli/level_options.h>
#include <heddle/lod/rebuild_levels.h>

#include <heddle/base/error.h>
#include <heddle/cli/terminal/text.h>

#include <utility>

namespace heddle::cli {
namespace {

std::vector<std::string> method_names() {
    return {kLodMethodNames.begin(), kLodMethodNames.end()};
}

} // namespace

std::vector<Option> level_options() {
    return grouped(
        "Levels of detail",
        {
            {"--levels", "N", "all", any_text(), "",
             "Maximum number of levels above the finest; all: until at most two voxels per axis are left."},
            {"--lod", "METHOD", "moments", one_of(method_names()), "",
             "Method of merging lobes into the next level; moments and wasserstein keep up to --lobes per voxel."},
        });
}

LodOptions lod_options(const Arguments& arguments) {
    LodOptions options;
    options.method = lod_method_of(arguments.text("lod")).value();
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    const std::string levels = arguments.text("levels");
    if (levels != "all") {
        const std::optional<std::int64_t> count = parse_integer(levels);
        if (!count || *count < 0 || *count > kMaxLevel) {
            throw UsageError(str("--levels: '", levels, "' is not all or 0 to ", kMaxLevel));
        }
        options.max_levels = static_cast<int>(*count);
    }
    return options;
}

std::unique_ptr<LevelBuilder> level_builder(const Arguments& arguments) {
    const LodOptions options = lod_options(arguments);
    if (options.max_levels == 0 && !arguments.given("correlation")) return nullptr;
    return std::make_unique<LevelBuilder>(options); // it finds what level 0's neighbours share too
}

VoxelLevels
add_levels(std::unique_ptr<VoxelSource> level0, const Arguments& arguments, Progress& progress) {
    VoxelLevels levels;
    levels.push_back(std::move(level0));
    const LodOptions options = lod_options(arguments);
    if (options.max_levels == 0) return levels;
    return rebuild_levels(std::move(levels), options, false, progress);
}

VoxelLevels finish_levels(LevelBuilder* builder, std::unique_ptr<VoxelSource> level0) {
    if (builder != nullptr) return builder->finish(std::move(level0));
    VoxelLevels levels;
    levels.push_back(std::move(level0));
    return levels;
}

void report_levels(Report& report, const VoxelLevels& levels) {
    const VoxelGridInfo& finest = levels.front()->info();
    if (finest.voxel_count == 0) report.note("the volume is empty: no voxel is covered");
    report.count("voxels", finest.voxel_count);
    report.count("lobes", finest.lobe_count);
    std::int64_t voxels = 0;
    std::int64_t lobes = 0;
    for (const auto& level : levels) {
        voxels += level->info().voxel_count;
        lobes += level->info().lobe_count;
    }
    report.count("levels", static_cast<std::int64_t>(levels.size()),
                 str("(", show_count(static_cast<double>(voxels)), " voxels and ",
                     show_count(static_cast<double>(lobes)), " lobes in total)"));
}

} // namespace heddle::cli
