#include <heddle/geom/generate_parts.h>
#include <heddle/geom/generate_sheet.h>

#include <cmath>
#include <numbers>

namespace heddle::generate_parts {
namespace {

/// The height of a yarn that passes over one crossing yarn and under the next: an arc of two radii
/// around the first, a straight piece, an arc around the second. Yarns touch along the arcs and are
/// never closer: the squared distance of two crossing arcs of angles a and b is
/// 4 r^2 (1 + 2 (1 - cos a) (1 - cos b)).     [Peirce 1937, "The geometry of cloth structure"]
class Crimp {
public:
    Crimp(double radius, double spacing) : radius_(radius), spacing_(spacing) {
        // climb of 2 r over one spacing: rises with the angle, which is 60 degrees when jammed
        double lo = 0.0;
        double hi = std::numbers::pi / 3.0;
        for (int step = 0; step < 60; ++step) {
            angle_ = 0.5 * (lo + hi);
            const double climb = 4.0 * radius * (1.0 - std::cos(angle_)) +
                                 (spacing - 4.0 * radius * std::sin(angle_)) * std::tan(angle_);
            (climb < 2.0 * radius ? lo : hi) = angle_;
        }
    }
    /// The height of the yarn's axis. @param s  distance from the crossing, in [0, spacing]
    /// @return   height above the cloth's middle; from r at s = 0 down to -r at s = spacing
    [[nodiscard]] double height(double s) const {
        if (s > 0.5 * spacing_) return -height(spacing_ - s);
        const double reach = 2.0 * radius_; // radius of the arc around the crossing yarn's axis
        const double arc = reach * std::sin(angle_);
        if (s < arc) return std::sqrt(reach * reach - s * s) - radius_;
        return reach * std::cos(angle_) - radius_ - (s - arc) * std::tan(angle_);
    }

private:
    double radius_, spacing_;
    double angle_ = 0.0;
};

/// True if warp yarn i passes over weft yarn j.
bool warp_over(GenerateKind kind, std::int64_t i, std::int64_t j) {
    const auto modulo = [](std::int64_t a, std::int64_t m) { return (a % m + m) % m; };
    switch (kind) {
    case GenerateKind::Twill: return modulo(i - j, 4) < 2;
    case GenerateKind::Satin: return modulo(i - 2 * j, 5) != 0; // step 2 separates the bindings
    default: return modulo(i + j, 2) == 0;
    }
}

struct Weave {
    GenerateKind kind;
    double radius, spacing;
    Crimp crimp;

    /// The height of a yarn at `step`, of kCrossingPoints per spacing; step 0 is half a spacing
    /// before the first crossing. `over(k)`: whether it passes over the k-th yarn that it crosses.
    template <typename Over>
    [[nodiscard]] double height(std::int64_t step, const Over& over) const {
        const std::int64_t s = step - kCrossingPoints / 2;
        const std::int64_t k = s >= 0 ? s / kCrossingPoints : -1 - (-1 - s) / kCrossingPoints;
        const double here = over(k) ? 1.0 : -1.0;
        if (over(k) == over(k + 1)) return here * radius;
        const double part =
            static_cast<double>(s - k * kCrossingPoints) / static_cast<double>(kCrossingPoints);
        return here * crimp.height(part * spacing);
    }
};

} // namespace

Geometry generate_weave(const GenerateOptions& o) {
    const Weave weave{o.kind, o.radius, o.spacing, Crimp(o.radius, o.spacing)};
    const Sheet sheet(o.shape, static_cast<double>(o.nx) * o.spacing,
                      static_cast<double>(o.ny) * o.spacing, cloth_thickness(o));
    const Sizes size = sizes(o);
    const double pitch = o.spacing / static_cast<double>(kCrossingPoints);
    Geometry geometry;
    geometry.curves.push_back(make_curves(
        size.curves[0], size.per_curve[0], Basis::CatmullRom,
        [&](std::int64_t i, std::int64_t point) {
            const std::int64_t step = point - 1; // point 0 only gives a tangent
            const double z =
                weave.height(step, [&](std::int64_t j) { return warp_over(o.kind, i, j); });
            return sheet.place(
                {(static_cast<double>(i) + 0.5) * o.spacing, static_cast<double>(step) * pitch, z});
        }));
    geometry.curves.push_back(make_curves(
        size.curves[1], size.per_curve[1], Basis::CatmullRom,
        [&](std::int64_t j, std::int64_t point) {
            const std::int64_t step = point - 1;
            const double z =
                weave.height(step, [&](std::int64_t i) { return !warp_over(o.kind, i, j); });
            return sheet.place(
                {static_cast<double>(step) * pitch, (static_cast<double>(j) + 0.5) * o.spacing, z});
        }));
    for (CurveSet& set : geometry.curves) set.default_radius = static_cast<float>(o.radius);
    geometry.curves[1].material = 1;
    geometry.materials.push_back(
        {.name = "warp", .kind = MaterialKind::Fiber, .albedo = {0.25f, 0.35f, 0.6f}});
    geometry.materials.push_back(
        {.name = "weft", .kind = MaterialKind::Fiber, .albedo = {0.75f, 0.72f, 0.65f}});
    return geometry;
}

} // namespace heddle::generate_parts
