#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/render/camera.h>

#include <vector>

namespace heddle::viewer {

/// What the artist changes of a kind of yarn, or of plain fibers.
struct YarnEdit {
    double radius = 1.0;          ///< times what the file says, > 0
    double twist = 0.0;           ///< radians per unit of the yarn model, added to the yarn's
    Vec3f tint{1.0f, 1.0f, 1.0f}; ///< linear RGB, multiplies the colour
    bool operator==(const YarnEdit&) const = default;
};

/// Kinds that edits are for: the yarns in their order, then plain fibers where some set has no
/// yarn.
[[nodiscard]] std::vector<std::string> names_of_kinds(const Geometry& geometry);

/// @param edits  one a kind
[[nodiscard]] Geometry edited(const Geometry& geometry, const std::vector<YarnEdit>& edits);

/// `factor` times as many fibers stand for each slice, one at least: what SliceLook::opacity is to
/// a picture.
void multiply_fibers(Geometry& geometry, double factor);

/// A box around the control points that a camera sees, grown by the yarns' radius; empty where it
/// sees none.
/// @param aspect  width over height of the picture
[[nodiscard]] Bounds seen_bounds(const Geometry& geometry, const CameraView& camera, double aspect);

} // namespace heddle::viewer
