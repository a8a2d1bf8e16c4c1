#pragma once

#include <heddle/voxel/material_set.h>
#include <heddle/voxel/voxel_level.h>

namespace heddle {

/// How the sums of a level are converted to stored voxels, on the CPU and on the device.
struct FitOptions {
    int subvoxels = 8;               ///< per axis of a voxel of level 0: 1, 2, 4, 8
    int max_lobes = 3;               ///< K
    bool project_subvoxels = false;  ///< CoverageMode::Mask: coverage from the subvoxel mask
    VoxelFields fields;              ///< with `masks`, sums are stored too
    MaterialSet normals{};           ///< the materials whose lobes describe normals
    Vec3d voxel_size{1.0, 1.0, 1.0}; ///< of level 0, scene units
};

} // namespace heddle
