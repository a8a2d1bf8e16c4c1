#pragma once

#include <heddle/opengl/shader.h>
#include <heddle/render/camera.h>
#include <heddle/viewer/orbit.h>

#include <cstdint>

namespace heddle::viewer {

/// A camera as shaders take it: places in units of the driver's, from the eye, along its axes.
struct EyeFrame {
    PictureAxes axes;
    Vec3d eye; ///< units
    bool parallel = true;
    double pixel = 1.0; ///< its width: units; not parallel: at distance 1
    std::int32_t width = 1, height = 1;

    /// @param unit  scene units
    /// @throws Error  InvalidArgument: an eye at its target
    EyeFrame(const CameraView& camera, std::int32_t width, std::int32_t height, double unit);
    /// Parallel rays from a distant light: a ball fits a square map.
    /// @param light  from the ball to the light, any length but 0
    EyeFrame(const Ball& ball, Vec3d light, std::int32_t size, double unit);

    /// @param place  units
    [[nodiscard]] Vec3f seen(Vec3d place) const { return to_float(axes.of(place - eye)); }
    bool operator==(const EyeFrame&) const = default;
    /// Sets what kEyeGlsl reads.
    void set_uniforms(const opengl::Program& program) const;
};

} // namespace heddle::viewer
