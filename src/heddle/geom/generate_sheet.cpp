#include <heddle/geom/generate_sheet.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle::generate_parts {
namespace {

constexpr double kPi = std::numbers::pi;

/// Middle radius of a fold in thicknesses: its inner face is shortened by a third, about where
/// yarns would start to intersect, and the gap between layers is two thicknesses.
constexpr double kFoldRadius = 1.5;
constexpr int kMaxLayers = 4;
constexpr double kMaxFolds = 5.0;
/// Slope of a hanging cloth at its hem, radians: as deep as a full curtain, without overhang.
constexpr double kHemSlope = 1.1;

/// Bessel function of the first kind, integer order, by its power series; |a| <= 1.2 needs 8 terms.
double bessel_j(int order, double a) {
    double term = 1.0;
    for (int k = 1; k <= order; ++k) term *= 0.5 * a / k;
    double sum = term;
    for (int k = 1; k <= 8; ++k) {
        term *= -0.25 * a * a / (k * (k + order));
        sum += term;
    }
    return sum;
}

} // namespace

// Jacobi-Anger: cos(a sin t) = J0 + 2 sum J_2n cos(2n t), sin(a sin t) = 2 sum J_2n+1 sin((2n+1)
// t), integrated term by term. At a = 1.2, order 9 is below 1e-8.
Meander::Point Meander::at(double s) const {
    const double t = 2.0 * kPi * s / wavelength;
    const double scale = wavelength / (2.0 * kPi);
    Point p{bessel_j(0, amplitude) * s, 0.0, amplitude * std::sin(t)};
    for (int n = 1; n <= 7; n += 2) {
        p.across -= scale * 2.0 * bessel_j(n, amplitude) / n * std::cos(n * t);
        p.along += scale * 2.0 * bessel_j(n + 1, amplitude) / (n + 1) * std::sin((n + 1) * t);
    }
    return p;
}

Sheet::Sheet(GenerateShape shape, double width, double height, double thickness)
    : shape_(shape), width_(width), height_(height), fold_radius_(kFoldRadius * thickness) {
    const double turn = kPi * fold_radius_;
    if (shape == GenerateShape::Folded) {
        // the flat part of a layer is at least as long as a fold
        layers_ = static_cast<int>(
            std::clamp((height + turn) / (2.0 * turn), 0.0, static_cast<double>(kMaxLayers)));
        if (layers_ < 2) {
            throw Error(ErrorCode::InvalidArgument,
                        str("a cloth ", height, " long is too short to be folded; at least ",
                            3.0 * turn, " is needed"),
                        str("raise ny at least ", std::ceil(30.0 * turn / height) / 10.0,
                            " times, or use the shape 'flat'"));
        }
        panel_ = (height - (layers_ - 1) * turn) / layers_;
    }
    if (shape == GenerateShape::Hanging) {
        // the smallest radius of curvature is wavelength / (2 pi slope)
        const double shortest = 2.0 * kPi * kHemSlope * 2.0 * fold_radius_;
        wavelength_ = width / std::clamp(std::floor(width / shortest), 1.0, kMaxFolds);
        slope_ = kHemSlope * std::min(1.0, wavelength_ / shortest);
    }
}

Vec3d Sheet::place(Vec3d p) const {
    switch (shape_) {
    case GenerateShape::Flat: return p;
    case GenerateShape::Folded: return fold(p);
    case GenerateShape::Hanging: return hang(p);
    }
    return p;
}

Vec3d Sheet::fold(Vec3d p) const {
    const double period = panel_ + kPi * fold_radius_;
    const double layer = std::clamp(std::floor(p.y / period), 0.0, layers_ - 1.0);
    const double s = p.y - layer * period;
    const bool last = layer == layers_ - 1.0;
    const double angle = last ? 0.0 : std::max(0.0, (s - panel_) / fold_radius_);
    double y = angle > 0.0 ? panel_ + fold_radius_ * std::sin(angle) : s;
    const double z = fold_radius_ * (2.0 * layer + 1.0 - std::cos(angle));
    const bool back = std::fmod(layer, 2.0) != 0.0; // odd layers run towards -y
    if (back) y = panel_ - y;
    const double ty = back ? -std::cos(angle) : std::cos(angle);
    const double tz = std::sin(angle);
    return {p.x, y - p.z * tz, z + p.z * ty};
}

Vec3d Sheet::hang(Vec3d p) const {
    const double below = std::clamp(1.0 - p.y / height_, 0.0, 1.0);
    const Meander::Point m = Meander{wavelength_, slope_ * below}.at(p.x - 0.5 * width_);
    return {m.along - p.z * std::sin(m.slope), p.y, m.across + p.z * std::cos(m.slope)};
}

} // namespace heddle::generate_parts
