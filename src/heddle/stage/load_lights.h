#pragma once

#include <heddle/render/light.h>
#include <heddle/scene/scene.h>

#include <vector>

namespace heddle {

/// A scene's lights, environment maps read; where the scene has none, a grey sky and a sun.
/// @param up  of environment maps
/// @throws Error  NotFound; BadFile: not an image, or not twice as wide as high
[[nodiscard]] std::vector<Light> load_lights(const Scene& scene, Vec3d up);

} // namespace heddle
