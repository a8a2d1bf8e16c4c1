#pragma once

#include <heddle/raster/voxelize_slices.h>
#include <heddle/viewer/orbit.h>
#include <heddle/viewer/session/yarn_edit.h>
#include <heddle/viewer/slice/slice_view.h>
#include <heddle/viewer/volume/voxel_view.h>

#include <string>
#include <vector>

namespace heddle::viewer {

enum class Show : std::uint8_t { Slices, Voxels };

/// How "voxelize what I see" works.
struct VoxelSettings {
    bool raster = false; ///< slices drawn by OpenGL; else fibers
    raster::Composition composition = raster::Composition::Accumulate;
    double edge_px = 2.0;  ///< of a voxel, pixels at the target, > 0
    bool only_seen = true; ///< else all of the object
    bool operator==(const VoxelSettings&) const = default;
};

/// All that the artist sets. A picture depends on this, the object and its voxels alone.
struct Settings {
    Orbit orbit;
    bool framed = false; ///< the orbit is about the unit ball, and is to be moved to what is there,
    bool target_given = false; ///< but for its target
    Show show = Show::Slices;
    SliceLook slices; ///< its light is that of voxels too
    VoxelLook volume; ///< of voxels; its blocks and white block are shown over slices too
    std::vector<YarnEdit> yarns;
    VoxelSettings voxels;
};

} // namespace heddle::viewer
