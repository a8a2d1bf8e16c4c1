#include <heddle/render/camera.h>

#include <cmath>
#include <numbers>

namespace heddle {

Camera::Camera(const CameraView& view, std::int32_t width, std::int32_t height) : view_(view) {
    forward_ = normalize(view.target - view.eye);
    const Vec3d right = normalize(cross(forward_, view.up));
    const Vec3d down = cross(forward_, right);
    const double whole =
        view.orthographic ? view.view_height : 2.0 * std::tan(0.5 * view.view_angle);
    const double pixel = whole / static_cast<double>(height);
    right_ = right * pixel;
    down_ = down * pixel;
    center_x_ = 0.5 * static_cast<double>(width);
    center_y_ = 0.5 * static_cast<double>(height);
    if (!(view_.focus_distance > 0.0)) view_.focus_distance = length(view.target - view.eye);
}

Ray Camera::ray(float x, float y, std::array<float, 2> lens) const {
    const Vec3d aside = right_ * (static_cast<double>(x) - center_x_) +
                        down_ * (static_cast<double>(y) - center_y_);
    const auto pixel = static_cast<float>(length(right_));
    Ray out;
    if (view_.orthographic) {
        out.origin = view_.eye + aside;
        out.direction = to_float(forward_);
        out.width = pixel;
        return out;
    }
    const Vec3d toward = forward_ + aside;
    out.origin = view_.eye;
    out.direction = to_float(normalize(toward));
    out.spread = pixel / static_cast<float>(length(toward));
    if (view_.lens_radius > 0.0) {
        const double r = view_.lens_radius * std::sqrt(static_cast<double>(lens[0]));
        const double phi = 2.0 * std::numbers::pi * static_cast<double>(lens[1]);
        const Vec3d place =
            normalize(right_) * (r * std::cos(phi)) + normalize(down_) * (r * std::sin(phi));
        out.origin = view_.eye + place;
        out.direction = to_float(normalize(toward * view_.focus_distance - place));
    }
    return out;
}

CameraView frame(const Bounds& box, Vec3d from, Vec3d up, double aspect) {
    CameraView out;
    const Vec3d size = box.size();
    const double radius = box.empty() ? 1.0 : std::max(0.5 * length(size), 1e-12);
    const double half = 0.5 * out.view_angle;
    const double narrow = aspect < 1.0 ? std::atan(std::tan(half) * aspect) : half;
    out.target = box.empty() ? Vec3d{} : (box.lo + box.hi) * 0.5;
    out.eye = out.target + normalize(from) * (radius / std::sin(narrow));
    out.up = up;
    return out;
}

} // namespace heddle
