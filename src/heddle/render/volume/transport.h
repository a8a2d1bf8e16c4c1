#pragma once

#include <heddle/render/volume/traversal_level.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// How the extinctions of voxels along a ray are combined. docs/transport.md compares the choices.
enum class Transport : std::uint8_t {
    Automatic, ///< Sheet if the file has slabs, Footprint for fibers if it has footprints, else
               ///< Product
    Product,   ///< independent voxels: optical depths add up          [Fabre26, LopezMoreno17]
    Threshold, ///< neighbours share a random threshold as far as their faces correlate; Product
               ///< if the file has no correlation
    Footprint, ///< by the cells of the faces that a ray crosses; Product without footprints
    Sheet,     ///< surfaces are sheets within their plane slabs; Product without slabs
    /// a FlakeMedium instead of a VolumeInstance: one SGGX per voxel, interpolated [Heitz15]
    Flakes
};

/// Returns the names on the command line, in the order of Transport.
[[nodiscard]] const std::vector<std::string>& transport_names();

/// Returns the transport of that name; Automatic if the name is empty.
/// @throws Error  InvalidArgument: the name is unknown
[[nodiscard]] Transport transport_from(const std::string& name);

/// Returns the transport for a level, whose data may not allow the one that is asked for.
[[nodiscard]] inline Transport resolve(Transport asked, const TraversalLevel& level) {
    if (asked == Transport::Threshold) {
        return level.has_correlation() ? asked : Transport::Product;
    }
    if (asked == Transport::Sheet || (asked == Transport::Automatic && level.has_sheets())) {
        return level.has_sheets() ? Transport::Sheet : Transport::Product;
    }
    const bool wants =
        asked == Transport::Footprint || (asked == Transport::Automatic && level.fibers_only());
    return wants && level.has_footprints() ? Transport::Footprint : Transport::Product;
}

/// Combines three optical depths along the axes into one: the root of the sum of squares.
///
/// Exact for rays along an axis, for parallel fibers, and for isotropic fibers; crossed sheets
/// would need the sum. Closer to traced geometry than the sum or their mean (docs/transport.md).
[[nodiscard]] inline float combine_depths(Vec3f depth) {
    return std::sqrt(dot(depth, depth));
}

/// Returns a voxel's optical depths along the axes.
[[nodiscard]] inline Vec3f depths_of(const TraversalVoxel& voxel) {
    return Vec3f{static_cast<float>(voxel.depth[0]), static_cast<float>(voxel.depth[1]),
                 static_cast<float>(voxel.depth[2])} *
           kDepthUnit;
}

} // namespace heddle
