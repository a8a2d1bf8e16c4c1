#pragma once

#include <heddle/render/light.h>
#include <heddle/scene/scene.h>

#include <vector>

namespace heddle {

/// Returns a scene's lights with their environment maps; a grey sky and a sun if there are none.
/// @param up      upward direction of environment maps
/// @throws Error  NotFound; BadFile: not an image, or not twice as wide as high
[[nodiscard]] std::vector<Light> load_lights(const Scene& scene, Vec3d up);

} // namespace heddle
