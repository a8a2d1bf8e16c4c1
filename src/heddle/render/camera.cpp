#include <heddle/render/camera.h>

#include <cmath>
#include <numbers>

namespace heddle {

Camera::Camera(const CameraParameters& parameters, std::int32_t width, std::int32_t height)
    : parameters_(parameters) {
    forward_ = normalize(parameters.target - parameters.eye);
    const Vec3d right = normalize(cross(forward_, parameters.up));
    const Vec3d down = cross(forward_, right);
    const double whole = parameters.orthographic ? parameters.view_height
                                                 : 2.0 * std::tan(0.5 * parameters.view_angle);
    const double pixel = whole / static_cast<double>(height);
    right_ = right * pixel;
    down_ = down * pixel;
    center_x_ = 0.5 * static_cast<double>(width);
    center_y_ = 0.5 * static_cast<double>(height);
    if (!(parameters_.focus_distance > 0.0))
        parameters_.focus_distance = length(parameters.target - parameters.eye);
}

Ray Camera::ray(float x, float y, std::array<float, 2> lens) const {
    const Vec3d aside = right_ * (static_cast<double>(x) - center_x_) +
                        down_ * (static_cast<double>(y) - center_y_);
    const auto pixel = static_cast<float>(length(right_));
    Ray out;
    if (parameters_.orthographic) {
        out.origin = parameters_.eye + aside;
        out.direction = to_float(forward_);
        out.width = pixel;
        return out;
    }
    const Vec3d toward = forward_ + aside;
    out.origin = parameters_.eye;
    out.direction = to_float(normalize(toward));
    out.spread = pixel / static_cast<float>(length(toward));
    if (parameters_.lens_radius > 0.0) {
        const double r = parameters_.lens_radius * std::sqrt(static_cast<double>(lens[0]));
        const double phi = 2.0 * std::numbers::pi * static_cast<double>(lens[1]);
        const Vec3d on_lens =
            normalize(right_) * (r * std::cos(phi)) + normalize(down_) * (r * std::sin(phi));
        out.origin = parameters_.eye + on_lens;
        out.direction = to_float(normalize(toward * parameters_.focus_distance - on_lens));
    }
    return out;
}

CameraParameters frame(const Bounds& box, Vec3d from, Vec3d up, double aspect) {
    constexpr double kMargin = 1.06;
    CameraParameters out;
    out.up = up;
    if (box.empty()) return out;
    const Vec3d back = normalize(from);
    const Vec3d right = normalize(cross(up, back));
    const Vec3d top = cross(back, right);
    const double tall = std::tan(0.5 * out.view_angle) / kMargin;
    out.target = (box.lo + box.hi) * 0.5;
    double away = 1e-6 * length(box.size()); // along `back` until all corners are in view
    for (int c = 0; c < 8; ++c) {
        const Vec3d corner =
            Vec3d{(c & 1) != 0 ? box.hi.x : box.lo.x, (c & 2) != 0 ? box.hi.y : box.lo.y,
                  (c & 4) != 0 ? box.hi.z : box.lo.z} -
            out.target;
        const double aside =
            std::max(std::fabs(dot(corner, right)) / aspect, std::fabs(dot(corner, top)));
        away = std::max(away, dot(corner, back) + aside / tall);
    }
    out.eye = out.target + back * (away > 0.0 ? away : 1.0);
    return out;
}

} // namespace heddle
