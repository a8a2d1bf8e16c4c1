#pragma once

#include <heddle/base/progress.h>
#include <heddle/io/vol/vol_layout.h>
#include <heddle/voxel/voxel_level.h>

#include <memory>
#include <string>
#include <vector>

namespace heddle {

/// How the samples of a medium become voxels. All fields are optional.
struct VolOptions {
    double density_scale = 0.0;     ///< extinction per scene unit at density 1 (Mitsuba's `scale`);
                                    ///< 0: default_density_scale
    Vec3f albedo{0.8f, 0.8f, 0.8f}; ///< linear RGB in [0, 1] of the one fiber material
    std::int32_t max_lobes = 3;     ///< K, for levels that are built from it
    bool occupancy = true;          ///< the voxels have VoxelFields::occupancy, with all cells set
    std::string command{};          ///< stored in the result
};

/// Level 0 made from a .vol, and notes for the user, one sentence each.
struct VolVolume {
    std::unique_ptr<VoxelLevel> grid;
    std::vector<std::string> notes;
};

/// Makes voxels of a Mitsuba 0.6 volume: each sample becomes a voxel.              [docs/import.md]
///
/// Voxels are as large as the distance of samples. The volume is moved by at most half a voxel per
/// axis, so that samples are at voxel centres of the lattice; a note says how far. If blocks share
/// a layer of samples and differ, the denser sample is used. VolMedium computes the values of a
/// voxel; voxels whose coverage is 0 on all axes are dropped.
///
/// All samples are read once, on all threads, to check and to count them. The source then reads a
/// block's samples again each time the block is requested: it keeps 12 bytes per block of 32^3
/// voxels and the names of the files, which must stay. Directions are not read where all samples
/// are empty. Any number of threads gives the same bits.
/// @throws Error  as VolFile; BadFile: a volume more than 2^30 voxels from the origin; Cancelled
[[nodiscard]] VolVolume
read_vol(const VolLayout& layout, const VolOptions& options, Progress& progress);

} // namespace heddle
