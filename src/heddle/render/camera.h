#pragma once

#include <heddle/base/trig.h>
#include <heddle/geom/bounds.h>
#include <heddle/render/volume/ray.h>

#include <array>
#include <cstdint>

namespace heddle {

/// The position, direction and lens of a camera.
struct CameraParameters {
    bool orthographic = false;
    Vec3d eye{0, 0, 10};
    Vec3d target{};
    Vec3d up{0, 1, 0};
    double view_angle = 0.6;     ///< perspective: radians across the picture's height, in (0, pi)
    double view_height = 1.0;    ///< orthographic: the picture's height, scene units
    double lens_radius = 0.0;    ///< scene units; 0: everything is in focus
    double focus_distance = 0.0; ///< scene units along the view; 0: the target's distance
};

/// A pinhole, thin-lens or parallel camera.
class Camera {
public:
    /// @param width, height  px
    Camera(const CameraParameters& parameters, std::int32_t width, std::int32_t height);

    /// Returns the ray through a point of the picture.
    /// @param x, y  px from the upper left corner
    /// @param lens  two numbers in [0, 1)
    /// @return      its width and spread are those of one pixel
    [[nodiscard]] Ray ray(float x, float y, std::array<float, 2> lens) const;

private:
    CameraParameters parameters_;
    Vec3d forward_, right_, down_; ///< right_, down_: a pixel (perspective: at distance 1)
    double center_x_, center_y_;
};

/// Returns a camera that sees all of a box from one direction.
/// @param from  towards the camera, any length > 0
[[nodiscard]] CameraParameters frame(const Bounds& box, Vec3d from, Vec3d up, double aspect);

} // namespace heddle
