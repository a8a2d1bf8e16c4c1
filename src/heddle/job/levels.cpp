#include <heddle/job/levels.h>

#include <heddle/io/vdb/predict_vdb.h>
#include <heddle/job/option_error.h>

#include <vector>

namespace heddle::job {

LevelCounts count_levels(const VoxelLevels& levels) {
    LevelCounts counts;
    counts.levels = static_cast<std::int64_t>(levels.size());
    counts.voxels = levels.front()->info().voxel_count;
    counts.lobes = levels.front()->info().lobe_count;
    for (const auto& level : levels) {
        counts.all_voxels += level->info().voxel_count;
        counts.all_lobes += level->info().lobe_count;
    }
    return counts;
}

LodOptions lod_options(LodMethod lod, const std::optional<int>& levels, std::uint64_t seed) {
    LodOptions options{.method = lod, .seed = seed};
    if (!levels) return options;
    if (*levels < 0 || *levels > kMaxLevel) {
        throw OptionError(str("`levels` is ", *levels, "; it must be 0 to ", kMaxLevel));
    }
    options.max_levels = *levels;
    return options;
}

std::int64_t predict_file_bytes(const VoxelizePlan& plan) {
    std::vector<LevelSize> levels{{plan.leaves, plan.voxels, plan.lobes}};
    levels.insert(levels.end(), plan.levels.begin(), plan.levels.end());
    return static_cast<std::int64_t>(predict_vdb_bytes(levels, plan.fields).file);
}

} // namespace heddle::job
