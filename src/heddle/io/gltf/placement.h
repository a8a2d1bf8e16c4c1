#pragma once

#include <heddle/geom/mesh.h>

namespace heddle {

/// An affine map: p -> x p.x + y p.y + z p.z + origin.
struct Placement {
    Vec3d x{1.0, 0.0, 0.0};
    Vec3d y{0.0, 1.0, 0.0};
    Vec3d z{0.0, 0.0, 1.0};
    Vec3d origin{};

    /// Maps a direction.
    [[nodiscard]] Vec3d turn(Vec3d d) const { return x * d.x + y * d.y + z * d.z; }
};

/// The map that applies `inner`, then `outer`.
[[nodiscard]] Placement operator*(const Placement& outer, const Placement& inner);

/// Scale, then rotation, then translation, as in a glTF node.
/// @param rotation  quaternion x, y, z, w; is normalized; all zero: no rotation
[[nodiscard]] Placement
placement_from(Vec3d translation, const std::array<double, 4>& rotation, Vec3d scale);

/// Appends `local`, transformed by `place`, to `world`, which has the same arrays as `local`.
/// Normals follow the inverse transpose; a mirroring map flips windings and handedness.
void append_placed(const Mesh& local, const Placement& place, Mesh& world);

} // namespace heddle
