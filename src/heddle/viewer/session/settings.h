#pragma once

#include <heddle/raster/voxelize_slices.h>
#include <heddle/viewer/orbit.h>
#include <heddle/viewer/session/yarn_edit.h>
#include <heddle/viewer/slice/slice_renderer.h>
#include <heddle/viewer/volume/voxel_renderer.h>

#include <string>
#include <vector>

namespace heddle::viewer {

enum class Show : std::uint8_t { Slices, Voxels };

/// How the visible part is voxelized.
struct VoxelSettings {
    bool raster = false; ///< from slices drawn by OpenGL; else from fibers
    raster::Composition composition = raster::Composition::Accumulate;
    double edge_px = 2.0;  ///< edge of a voxel, pixels at the target, > 0
    bool only_seen = true; ///< else all of the object
    bool operator==(const VoxelSettings&) const = default;
};

/// All settings of the user. A picture depends only on these, the object and its voxels.
struct Settings {
    Orbit orbit;
    bool framed = false; ///< the orbit is that of the unit ball, and will be moved to the objects,
    bool target_given = false; ///< except for its target
    Show show = Show::Slices;
    SliceLook slices; ///< its light is also that of voxels
    VoxelLook volume; ///< of voxels; its blocks and white block are also shown over slices
    std::vector<YarnEdit> yarns;
    VoxelSettings voxels;
};

} // namespace heddle::viewer
