#pragma once

#include <heddle/opengl/shader.h>
#include <heddle/render/camera.h>
#include <heddle/viewer/orbit.h>

#include <cstdint>

namespace heddle::viewer {

/// A camera for shaders: points are in the driver's units, relative to the eye, along its axes.
struct ShaderCamera {
    CameraAxes axes;
    Vec3d eye; ///< units
    bool parallel = true;
    double pixel = 1.0; ///< width of a pixel: units; in perspective at distance 1
    std::int32_t width = 1, height = 1;

    /// @param unit  scene units
    /// @throws Error  InvalidArgument: the eye is at its target
    ShaderCamera(const CameraParameters& camera,
                 std::int32_t width,
                 std::int32_t height,
                 double unit);
    /// Parallel rays from a distant light; a ball fits a square map.
    /// @param light  from the ball to the light, of nonzero length
    ShaderCamera(const Ball& ball, Vec3d light, std::int32_t size, double unit);

    /// @param point  units
    [[nodiscard]] Vec3f seen(Vec3d point) const { return to_float(axes.of(point - eye)); }
    bool operator==(const ShaderCamera&) const = default;
    /// Sets the uniforms of kEyeGlsl.
    void set_uniforms(const opengl::Program& program) const;
};

} // namespace heddle::viewer
