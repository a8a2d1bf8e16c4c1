#pragma once

#include <heddle/render/volume/traversal_level.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// How the extinctions of voxels along a ray are combined. docs/transport.md compares the choices.
enum class Transport : std::uint8_t {
    Automatic, ///< Sheet if the file has slabs, Cells if it has occupancy bits, else Product
    Product,   ///< independent voxels: optical depths add up          [Fabre26, LopezMoreno17]
    Cells,     ///< by the set ones of a voxel's 4 x 4 x 4 cells; Product if the file has none
    Sheet,     ///< surfaces are sheets within their plane slabs; Product if the file has none
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
    const bool any = asked == Transport::Automatic;
    if (level.has_sheets() && (any || asked == Transport::Sheet)) return Transport::Sheet;
    if (level.has_cells() && (any || asked == Transport::Cells)) return Transport::Cells;
    return Transport::Product;
}

/// Combines three optical depths along the axes into one: the root of the sum of squares.
///
/// Exact for rays along an axis, for parallel fibers, and for isotropic fibers; crossed sheets
/// would need the sum. Closer to traced geometry than the sum or their mean (docs/transport.md).
[[nodiscard]] inline float combine_depths(Vec3f depth) {
    return std::sqrt(dot(depth, depth));
}

} // namespace heddle
