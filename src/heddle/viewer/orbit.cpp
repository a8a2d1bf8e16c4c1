#include <heddle/viewer/orbit.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <cmath>

namespace heddle::viewer {
namespace {

/// `v` rotated about the unit vector `axis`.
Vec3d turn_about(Vec3d v, Vec3d axis, double angle) {
    const Vec3d along = axis * dot(axis, v);
    const Vec3d across = v - along;
    return along + across * std::cos(angle) + cross(axis, across) * std::sin(angle);
}

} // namespace

CameraAxes::CameraAxes(Vec3d from, Vec3d upward) {
    away = normalize(from * -1.0);
    const Vec3d aside = cross(away, upward);
    right = length(aside) > 1e-9 * length(upward) ? normalize(aside)
                                                  : to_double(any_perpendicular(to_float(away)));
    up = cross(right, away);
}

void Orbit::frame(const Ball& ball, double aspect) {
    target = ball.middle;
    height = 2.0 * ball.radius / std::cos(0.5 * view_angle) / std::min(1.0, aspect);
}

void Orbit::turn(double right, double upward) {
    constexpr double kSteepest = 1.5707; // just below the zenith: `up` still defines a side
    const Vec3d pole = normalize(up);
    from = turn_about(from, pole, -right);
    const Vec3d unit = normalize(from);
    const double now = std::asin(std::clamp(dot(unit, pole), -1.0, 1.0));
    const double then = std::clamp(now + upward, -kSteepest, kSteepest);
    const CameraAxes axes(from, up);
    from = turn_about(from, axes.right, now - then);
}

void Orbit::pan(double right, double upward) {
    const CameraAxes axes(from, up);
    target = target - axes.right * (right * height) - axes.up * (upward * height);
}

void Orbit::zoom(double factor) {
    height /= factor;
}

CameraParameters Orbit::camera() const {
    if (!(length(from) > 0.0) || !(length(up) > 0.0)) {
        throw Error(ErrorCode::InvalidArgument, "view: a direction has no length",
                    "give one of nonzero length");
    }
    if (!(height > 0.0) || !(view_angle >= 0.0 && view_angle < 3.1)) {
        throw Error(ErrorCode::InvalidArgument,
                    str("view: a picture of height ", height, " and ", view_angle, " radians"),
                    "use a zoom above 0 and an angle from 0 to 177 degrees");
    }
    CameraParameters out;
    const CameraAxes axes(from, up);
    out.orthographic = view_angle == 0.0;
    out.target = target;
    out.up = axes.up;
    out.view_angle = view_angle;
    out.view_height = height;
    const double distance =
        out.orthographic ? 4.0 * height : 0.5 * height / std::tan(0.5 * view_angle);
    out.eye = target - axes.away * distance;
    return out;
}

} // namespace heddle::viewer
