#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/raster/voxelize_slices.h>

#include <cstdint>
#include <string>

namespace heddle::cli {

/// What a file came to, or what is predicted of it.
struct VoxelizedFile {
    std::int64_t voxels = 0;
    std::int64_t bytes = 0;      ///< of the .vdb
    std::int64_t peak_bytes = 0; ///< predicted, of memory
    double seconds = 0.0;
};

/// Curves or meshes to a .vdb, as the rows of `voxelize` say; with --dry-run: to a plan of it.
/// @param drawer  draws with --backend raster, one file after another
/// @throws Error       as what reads, voxelizes and writes
/// @throws UsageError  rows that do not go together
VoxelizedFile voxelize_file(const Arguments& arguments,
                            const std::string& input,
                            const std::string& output,
                            raster::SliceVoxelizer& drawer,
                            Report& report,
                            ProgressBar& bar);

} // namespace heddle::cli
