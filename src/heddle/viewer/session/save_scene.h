#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/camera.h>

#include <cstdint>
#include <string>

namespace heddle::viewer {

/// A scene file for `heddle render` that shows a volume like the view: with its camera and a light
/// of the same direction and share: three quarters directional, one quarter from all directions.
/// [docs/scene.md]
/// @param volume         path of a .vdb, relative to the scene file's folder
/// @param light          towards the light, nonzero length
/// @param width, height  px
[[nodiscard]] std::string scene_text(const std::string& volume,
                                     const CameraParameters& camera,
                                     Vec3d light,
                                     std::int32_t width,
                                     std::int32_t height);

} // namespace heddle::viewer
