#pragma once

#include <heddle/render/volume/traversal_level.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// How voxels of one ray are put together. docs/transport.md compares them.
enum class Transport : std::uint8_t {
    Automatic, ///< Footprint for fibers where the file has footprints, else Product
    Product,   ///< each voxel on its own: extinctions add up          [Fabre26, LopezMoreno17]
    Threshold, ///< a ray keeps what it drew from voxel to voxel as their faces correlate; Product
               ///< where the file has no correlation
    Footprint, ///< where a ray crosses the voxels' faces decides; Product without footprints
    /// a FlakeMedium in place of the VolumeInstance: one SGGX a voxel, interpolated [Heitz15]
    Flakes
};

/// Names on the command line, in the order of Transport.
[[nodiscard]] const std::vector<std::string>& transport_names();

/// The transport of that name; Automatic where it is empty.
/// @throws Error  InvalidArgument: no such name
[[nodiscard]] Transport transport_from(const std::string& name);

/// The transport that a level's data allow.
[[nodiscard]] inline Transport resolve(Transport asked, const TraversalLevel& level) {
    if (asked == Transport::Threshold) {
        return level.has_correlation() ? asked : Transport::Product;
    }
    const bool wants =
        asked == Transport::Footprint || (asked == Transport::Automatic && level.fibers_only());
    return wants && level.has_footprints() ? Transport::Footprint : Transport::Product;
}

/// One optical depth of three along the axes: the root of the sum of squares.
///
/// Exact on the axes, for fibers of one direction, and for fibers of all; crossed sheets would need
/// the sum instead. Nearer to traced geometry than the sum or their mean (docs/transport.md).
[[nodiscard]] inline float combine_depths(Vec3f depth) {
    return std::sqrt(dot(depth, depth));
}

/// A voxel's depths along the axes.
[[nodiscard]] inline Vec3f depths_of(const TraversalVoxel& voxel) {
    return Vec3f{static_cast<float>(voxel.depth[0]), static_cast<float>(voxel.depth[1]),
                 static_cast<float>(voxel.depth[2])} *
           kDepthUnit;
}

} // namespace heddle
