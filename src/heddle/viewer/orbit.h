#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/camera.h>

#include <cstdint>

namespace heddle::viewer {

/// A ball around all objects that are shown, scene units.
struct Ball {
    Vec3d middle{};
    double radius = 0.0;
    bool operator==(const Ball&) const = default;
};

/// A camera that orbits a target.
struct Orbit {
    Vec3d target{};
    Vec3d from{0.3, -0.6, 1.0}; ///< from the target to the eye, nonzero length
    Vec3d up{0.0, 1.0, 0.0};    ///< stays vertical in the picture; may be along `from`
    double height = 1.0;        ///< height of the picture at the target, scene units, > 0
    double view_angle = 0.0;    ///< vertical field of view, radians, below pi; 0: parallel rays

    /// Frames a ball so that all of it is in the picture, from any side.
    /// @param aspect  width over height
    void frame(const Ball& ball, double aspect);
    /// Rotates the scene to the right, as a mouse drags it, then the eye upward, to at most
    /// straight above the target; radians.
    void turn(double right, double upward);
    /// Moves the target with the picture, as fractions of the picture's height.
    void pan(double right, double upward);
    /// Magnifies the picture at the target by `factor`, > 0.
    void zoom(double factor);
    /// The width of a pixel at the target, scene units.
    [[nodiscard]] double pixel(std::int32_t height_px) const {
        return height / static_cast<double>(height_px);
    }
    bool operator==(const Orbit&) const = default;
    /// @throws Error  InvalidArgument: a direction of length 0, a height or angle out of range
    [[nodiscard]] CameraParameters camera() const;
};

/// The axes of a picture, unit and perpendicular, as in Camera; `away` points away from the eye.
struct CameraAxes {
    Vec3d right, up, away;

    /// @param from    towards the eye, nonzero length
    /// @param upward  if it is along `from`, another direction is used
    CameraAxes(Vec3d from, Vec3d upward);
    bool operator==(const CameraAxes&) const = default;
    /// The components of `v` along these axes.
    [[nodiscard]] Vec3d of(Vec3d v) const { return {dot(right, v), dot(up, v), dot(away, v)}; }
};

} // namespace heddle::viewer
