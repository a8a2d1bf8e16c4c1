#pragma once

#include <heddle/base/random.h>
#include <heddle/render/volume_level.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// How voxels of one ray are put together. docs/transport.md compares them.
enum class Transport : std::uint8_t {
    Product, ///< each voxel on its own: extinctions add up                [Fabre26, LopezMoreno17]
    Flakes   ///< a FlakeMedium in place of the Volume: one SGGX a voxel, interpolated [Heitz15]
};

/// Names on the command line, in the order of Transport; the first is the default.
[[nodiscard]] const std::vector<std::string>& transport_names();

/// The transport of that name; the default where it is empty.
/// @throws Error  InvalidArgument: no such name
[[nodiscard]] Transport transport_from(const std::string& name);

/// Optical depth that a voxel shows per unit of t.
///
/// Half of sum_a d_a |w_a| and half of sqrt(sum_a (d_a w_a)^2), d the depths along the axes: each is
/// exact on the axes; off them one errs up and the other down (findings, docs/transport.md).
/// @param rate  |direction| of the ray in voxels per t, times kDepthUnit
[[nodiscard]] inline float extinction(const VolumeVoxel& voxel, Vec3f rate) {
    const float x = static_cast<float>(voxel.depth[0]) * rate.x;
    const float y = static_cast<float>(voxel.depth[1]) * rate.y;
    const float z = static_cast<float>(voxel.depth[2]) * rate.z;
    return 0.5f * (x + y + z + std::sqrt(x * x + y * y + z * z));
}

} // namespace heddle
