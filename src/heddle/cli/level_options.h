#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/lod/build_levels.h>

#include <memory>
#include <vector>

namespace heddle::cli {

/// The rows that say which levels of detail are built: --levels, --lod.
[[nodiscard]] std::vector<Option> level_options();

/// What the rows of level_options(), and --seed, say.
/// @throws UsageError  a number of levels that cannot be
[[nodiscard]] LodOptions lod_options(const Arguments& arguments);

/// Builds what the rows of level_options() ask for; null with --levels 0 and no --correlation.
[[nodiscard]] std::unique_ptr<LevelBuilder> level_builder(const Arguments& arguments);

/// Level 0 and those that `builder` made over it; level 0 alone without one.
[[nodiscard]] VoxelLevels finish_levels(LevelBuilder* builder, std::unique_ptr<VoxelSource> level0);

/// Level 0 and those that the rows of level_options() ask for, built from its stored lobes.
[[nodiscard]] VoxelLevels
add_levels(std::unique_ptr<VoxelSource> level0, const Arguments& arguments, Progress& progress);

/// Rows on the voxels and lobes of level 0, and of the levels above it.
void report_levels(Report& report, const VoxelLevels& levels);

} // namespace heddle::cli
