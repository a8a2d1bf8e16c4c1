#include <heddle/viewer/shader_camera.h>

#include <heddle/base/error.h>

#include <cmath>

namespace heddle::viewer {

ShaderCamera::ShaderCamera(const CameraParameters& camera,
                           std::int32_t w,
                           std::int32_t h,
                           double unit)
    : axes(camera.eye - camera.target, camera.up),
      eye(camera.eye * (1.0 / unit)),
      parallel(camera.orthographic),
      width(w),
      height(h) {
    if (!(length(camera.eye - camera.target) > 0.0)) {
        throw Error(ErrorCode::InvalidArgument, "view: the eye is at its target",
                    "give a direction of nonzero length");
    }
    const double whole =
        parallel ? camera.view_height / unit : 2.0 * std::tan(0.5 * camera.view_angle);
    pixel = whole / static_cast<double>(height);
}

ShaderCamera::ShaderCamera(const Ball& ball, Vec3d light, std::int32_t size, double unit)
    : axes(light, {0.0, 1.0, 0.0}),
      eye(ball.middle * (1.0 / unit)),
      pixel(2.0 * ball.radius / unit / static_cast<double>(size)),
      width(size),
      height(size) {}

void ShaderCamera::set_uniforms(const opengl::Program& program) const {
    program.set("screen", Vec3f{static_cast<float>(width), static_cast<float>(height),
                                static_cast<float>(pixel)});
    program.set("parallel", parallel ? 1 : 0);
}

} // namespace heddle::viewer
