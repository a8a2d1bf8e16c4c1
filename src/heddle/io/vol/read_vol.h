#pragma once

#include <heddle/base/progress.h>
#include <heddle/io/vol/vol_layout.h>
#include <heddle/voxel/voxel_grid.h>

#include <memory>
#include <string>
#include <vector>

namespace heddle {

/// How a medium's samples become voxels. Nothing is required.
struct VolOptions {
    double density_scale = 0.0;     ///< extinction per scene unit at density 1 (Mitsuba's `scale`);
                                    ///< 0: default_density_scale
    Vec3f albedo{0.8f, 0.8f, 0.8f}; ///< linear RGB in [0, 1], of the one fiber material
    std::int32_t max_lobes = 3;     ///< K, for levels to be built from it
    std::string command{};          ///< kept in the result
};

/// Level 0 made of a .vol, and what the user should know of it, one sentence each.
struct VolVolume {
    std::unique_ptr<VoxelSource> grid;
    std::vector<std::string> notes;
};

/// Makes voxels of a Mitsuba 0.6 volume: a sample is a voxel.                       [docs/import.md]
///
/// Voxels are as large as samples are apart. The whole is moved by at most half a voxel per axis, so
/// that samples lie on centres of the lattice; a note says how far. Where blocks share a layer of
/// samples and differ, the denser counts. VolMedium says what a voxel holds; those whose coverage is 0
/// on all axes are left out.
///
/// All samples are read once, to check and to count them, on all threads. The source then reads a
/// block's samples again each time that the block is asked for: it holds 12 bytes a block of 32^3
/// voxels and the files' names, and needs them to stay. Directions where nothing is dense are not
/// read. Same bits for any thread count.
/// @throws Error  as VolFile; BadFile: a volume more than 2^30 voxels from the origin; Cancelled
[[nodiscard]] VolVolume
read_vol(const VolLayout& layout, const VolOptions& options, Progress& progress);

} // namespace heddle
