#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/scene/scene.h>

namespace heddle {

/// Reads or generates the explicit geometry of an object, in its own space, with its yarn.
/// @throws Error  as read_geometry, generate and apply_yarn; InvalidArgument: an object with only a
///                volume, or a yarn or radius for geometry without curves
[[nodiscard]] Geometry load_object_geometry(const SceneObject& object);

} // namespace heddle
