#pragma once

#include <heddle/base/vec.h>
#include <heddle/render/camera.h>

#include <cstdint>

namespace heddle::viewer {

/// A ball around all that is looked at, scene units.
struct Ball {
    Vec3d middle{};
    double radius = 0.0;
    bool operator==(const Ball&) const = default;
};

/// A camera that looks at a target from around it.
struct Orbit {
    Vec3d target{};
    Vec3d from{0.3, -0.6, 1.0}; ///< from the target to the eye, any length but 0
    Vec3d up{0.0, 1.0, 0.0};    ///< stays in the picture's upright plane; may be along `from`
    double height = 1.0;        ///< of the picture at the target, scene units, > 0
    double view_angle = 0.0;    ///< radians across the picture's height, below pi; 0: parallel rays

    /// All of a ball is in the picture, from any side.
    /// @param aspect  width over height
    void frame(const Ball& ball, double aspect);
    /// Turns what is seen to the right, as a mouse would drag it, then the eye upward, to at most
    /// straight above the target; radians.
    void turn(double right, double upward);
    /// Moves the target with the picture, in parts of the picture's height.
    void pan(double right, double upward);
    /// Makes what is seen at the target `factor` times as large, > 0.
    void zoom(double factor);
    /// Width of a pixel at the target, scene units.
    [[nodiscard]] double pixel(std::int32_t height_px) const {
        return height / static_cast<double>(height_px);
    }
    bool operator==(const Orbit&) const = default;
    /// @throws Error  InvalidArgument: a direction of no length, a height or angle out of range
    [[nodiscard]] CameraView camera() const;
};

/// Axes of a picture, unit and at right angles, as Camera has them; `away` from the eye.
struct PictureAxes {
    Vec3d right, up, away;

    /// @param from    to the eye, any length but 0
    /// @param upward  where along `from`, another is taken
    PictureAxes(Vec3d from, Vec3d upward);
    bool operator==(const PictureAxes&) const = default;
    /// `v` along these axes.
    [[nodiscard]] Vec3d of(Vec3d v) const { return {dot(right, v), dot(up, v), dot(away, v)}; }
};

} // namespace heddle::viewer
