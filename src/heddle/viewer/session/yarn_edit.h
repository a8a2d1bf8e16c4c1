#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/render/camera.h>

#include <vector>

namespace heddle::viewer {

/// The user's changes of a yarn type, or of plain fibers.
struct YarnEdit {
    double radius = 1.0;          ///< multiplies the radius in the file, > 0
    double twist = 0.0;           ///< radians per model unit, added to the yarn's twist
    Vec3f tint{1.0f, 1.0f, 1.0f}; ///< linear RGB, multiplies the colour
    bool operator==(const YarnEdit&) const = default;
};

/// The names of the kinds that edits are for: the yarns in order, then plain fibers if a set has no
/// yarn.
[[nodiscard]] std::vector<std::string> names_of_kinds(const Geometry& geometry);

/// @param edits  one per kind
[[nodiscard]] Geometry edited(const Geometry& geometry, const std::vector<YarnEdit>& edits);

/// Multiplies the number of fibers that represent each slice by `factor`, to at least one; this
/// corresponds to SliceLook::opacity of a picture.
void multiply_fibers(Geometry& geometry, double factor);

/// A box around the control points that a camera sees, enlarged by the yarns' radius; empty if it
/// sees none.
/// @param aspect  width over height of the picture
[[nodiscard]] Bounds
seen_bounds(const Geometry& geometry, const CameraParameters& camera, double aspect);

} // namespace heddle::viewer
