#include <heddle/geom/generate_parts.h>
#include <heddle/geom/generate_sheet.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle::generate_parts {
namespace {

constexpr double kPi = std::numbers::pi;

// Shape of a loop, as fractions of the wale's width: the curve (u + a sin 2u, h cos u, d cos 2u) of
// Wadekar et al. 2020, "Geometric modeling of knitted fabrics using helicoid scaffolds". a, h and
// the course height were searched for the thickest yarn that does not intersect: radius 1/8.2 of
// the wale, loop length 16.1 yarn diameters (Peirce 1947 finds 16.66 for the tightest jersey).
constexpr double kLoopSway = 0.236;
constexpr double kLoopHeight = 0.65;
constexpr double kCourseHeight = 0.74;
/// Half the width in u of the part of a foot between two wales in which their differences are
/// blended. The foot meets the course below outside of this part, at 0.7 to 1.2.
constexpr double kBlend = 0.5;

constexpr std::int64_t kRibUnit = 4;     ///< two knit wales, two purl
constexpr double kRibSlope = 0.75;       ///< slope of the wave that ribs contract into, radians
constexpr std::int64_t kCableUnit = 6;   ///< two purl wales, then a cable of four
constexpr std::int64_t kCablePeriod = 8; ///< courses from one crossing to the next
constexpr double kCableSpan = 6.0;       ///< duration of a crossing, in courses
constexpr double kCableLift = 3.3; ///< lift of a crossing strand out of the middle, in yarn radii
constexpr double kCableRest = 0.5; ///< lift of a cable that does not cross, relative to kCableLift
/// At a crossing the four wales share the width of two. As in real cables they spread, and the
/// ground is drawn in, so that no thread between them spans more than half a wale.
constexpr double kCableSpread = 0.3; ///< widening of the gap within a pair of wales, in wales
constexpr double kCableDraw = 0.45;  ///< shift of the ground beside a crossing, in wales

double smooth(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Half the distance between a loop's legs and its head at which loops touch: fitted to a search
/// over wale widths from 8.2 to 40 radii; within 0.03 radii.
double loop_depth(double radius, double wale) {
    const double ratio = 8.4 * radius / wale;
    return radius * (1.1 + 0.19 * ratio * ratio);
}

/// What one wale does to its loops at a given height.
struct Wale {
    double side = 1.0; ///< 1 knit, -1 purl
    double dx = 0.0;
    double dz = 0.0;
};

class Knit {
public:
    explicit Knit(const GenerateOptions& o)
        : kind_(o.kind),
          wales_(o.nx),
          wale_(o.spacing),
          course_(kCourseHeight * o.spacing),
          depth_(loop_depth(o.radius, o.spacing)),
          lift_(kCableLift * o.radius),
          rib_{static_cast<double>(kRibUnit) * o.spacing, kRibSlope} {}

    /// The width of the flat cloth, in scene units.
    [[nodiscard]] double width() const {
        const double flat = static_cast<double>(wales_) * wale_;
        return kind_ == GenerateKind::Rib ? rib_.at(flat).along : flat;
    }

    /// Control point `step` of course `row` of the flat cloth; each stitch has kStitchPoints.
    [[nodiscard]] Vec3d at(std::int64_t row, std::int64_t step) const;

private:
    [[nodiscard]] Wale wale(std::int64_t row, std::int64_t column, double y) const;
    [[nodiscard]] Wale
    strand(std::int64_t row, std::int64_t cable, std::int64_t position, double y) const;

    /// The crossing of a cable that is nearest to a height, and its progress there.
    struct Crossing {
        std::int64_t index = 0; ///< from 0 at the bottom
        double t = 0.0;         ///< 0 at its start, 1 at its end
        double rise = 0.0;      ///< how far the strands are apart, in [0, 1]
    };
    [[nodiscard]] Crossing crossing(std::int64_t cable, double y) const;
    /// The course above a cable's first crossing. Neighbouring cables alternate, or else the cloth
    /// would narrow at some courses by an amount that grows with its width.
    [[nodiscard]] static std::int64_t first_crossing(std::int64_t cable) {
        return kCablePeriod / 2 + kCablePeriod / 2 * (cable % 2);
    }

    GenerateKind kind_;
    std::int64_t wales_;
    double wale_, course_, depth_, lift_;
    Meander rib_;
};

Knit::Crossing Knit::crossing(std::int64_t cable, double y) const {
    const double up =
        (y / course_ - (static_cast<double>(first_crossing(cable)) - 0.5)) / kCablePeriod;
    const double nearest = std::max(0.0, std::round(up));
    const double t = (up - nearest) * kCablePeriod / kCableSpan + 0.5;
    return {static_cast<std::int64_t>(nearest), t, smooth(t / 0.4) * smooth((1.0 - t) / 0.4)};
}

/// Four strands run through a cable; this is the one at `position` in a course. At each crossing
/// two of them pass over the other two. A strand keeps its chain of loops through the crossing, so
/// its shift depends on height alone; a course visits the strands from left to right.
Wale Knit::strand(std::int64_t row, std::int64_t cable, std::int64_t position, double y) const {
    const std::int64_t above = row - first_crossing(cable);
    const std::int64_t passed = above < 0 ? 0 : above / kCablePeriod + 1;
    const Crossing c = crossing(cable, y);
    const std::int64_t before = (position + 2 * passed + 2 * c.index) % 4;
    const double direction = before < 2 ? 1.0 : -1.0; // the left pair passes in front
    const double spread = (before % 2 == 0 ? -0.5 : 0.5) * kCableSpread * c.rise;
    const double place = static_cast<double>(before) + direction * 2.0 * smooth(c.t) + spread;
    return {1.0, (place - static_cast<double>(position)) * wale_,
            lift_ * (kCableRest + direction * c.rise)};
}

Wale Knit::wale(std::int64_t row, std::int64_t column, double y) const {
    const std::int64_t c = std::clamp<std::int64_t>(column, 0, wales_ - 1);
    if (kind_ == GenerateKind::Rib) return {c % kRibUnit < 2 ? 1.0 : -1.0, 0.0, 0.0};
    if (kind_ != GenerateKind::Cable) return {};
    const std::int64_t cable = c / kCableUnit;
    const std::int64_t position = c % kCableUnit - 2;
    const std::int64_t cables = wales_ / kCableUnit; // a cable that is cut off stays purl
    if (position >= 0 && cable < cables) return strand(row, cable, position, y);
    const double left = cable > 0 ? crossing(cable - 1, y).rise : 0.0;
    const double right = cable < cables ? crossing(cable, y).rise : 0.0;
    return {-1.0, kCableDraw * wale_ * (right - left), 0.0};
}

Vec3d Knit::at(std::int64_t row, std::int64_t step) const {
    const std::int64_t column = step >= 0 ? step / kStitchPoints : -1 - (-1 - step) / kStitchPoints;
    const std::int64_t within = step - column * kStitchPoints;
    const double u =
        kPi * (2.0 * static_cast<double>(within) / static_cast<double>(kStitchPoints) - 1.0);
    const double y = wale_ * kLoopHeight * (1.0 + std::cos(u)) + course_ * static_cast<double>(row);
    const double to_right = u > 0.0 ? u - kPi : u + kPi; // distance to the nearer border, in u
    const std::int64_t left = u > 0.0 ? column : column - 1;
    const double middle = y - wale_ * kLoopHeight;
    const Wale a = wale(row, left, middle);
    const Wale b = wale(row, left + 1, middle);
    const double w = smooth(0.5 + 0.5 * to_right / kBlend);
    const double side = a.side + (b.side - a.side) * w;
    const double x = wale_ * (static_cast<double>(column) + 0.5 + u / (2.0 * kPi) +
                              kLoopSway * std::sin(2.0 * u)) +
                     a.dx + (b.dx - a.dx) * w;
    const double z = a.dz + (b.dz - a.dz) * w - side * depth_ * std::cos(2.0 * u);
    if (kind_ != GenerateKind::Rib) return {x, y, z};
    // the wave's crest, at half a wavelength, is the middle of a pair of knit wales
    const double shift = 0.5 * rib_.wavelength - wale_;
    const Meander::Point m = rib_.at(x + shift);
    return {m.along - rib_.at(shift).along - z * std::sin(m.slope), y,
            m.across + z * std::cos(m.slope)};
}

} // namespace

double cloth_thickness(const GenerateOptions& o) {
    const double knit = 2.0 * (loop_depth(o.radius, o.spacing) + o.radius);
    switch (o.kind) {
    case GenerateKind::Knit: return knit;
    case GenerateKind::Rib: {
        const Meander rib{static_cast<double>(kRibUnit) * o.spacing, kRibSlope};
        return knit + 2.0 * std::abs(rib.at(0.0).across);
    }
    case GenerateKind::Cable: return knit + 2.0 * (1.0 + kCableRest) * kCableLift * o.radius;
    default: return 4.0 * o.radius; // a weave is two yarns thick
    }
}

Geometry generate_knit(const GenerateOptions& o) {
    const Knit knit(o);
    const double height =
        o.spacing * (kCourseHeight * static_cast<double>(o.ny - 1) + 2.0 * kLoopHeight);
    const Sheet sheet(o.shape, knit.width(), height, cloth_thickness(o));
    const Sizes size = sizes(o);
    Geometry geometry;
    geometry.curves.push_back(make_curves(size.curves[0], size.per_curve[0], Basis::CatmullRom,
                                          [&](std::int64_t row, std::int64_t point) {
                                              return sheet.place(
                                                  knit.at(row, point - 1)); // point 0: tangent
                                          }));
    geometry.curves.back().default_radius = static_cast<float>(o.radius);
    geometry.materials.push_back(
        {.name = "yarn", .kind = MaterialKind::Fiber, .albedo = {0.75f, 0.68f, 0.55f}});
    return geometry;
}

} // namespace heddle::generate_parts
