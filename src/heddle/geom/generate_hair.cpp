#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/geom/generate_parts.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle::generate_parts {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHairLength = 1000.0; ///< in radii; 4 cm of hair 80 um thick
constexpr double kTurns = 5.0;         ///< of a curl from root to tip
constexpr double kTipRadius = 0.3;     ///< radius of a strand's tip, relative to its root

/// Uniform in [-1, 1).
double signed_unit(CounterRandom& random) {
    return 2.0 * static_cast<double>(random.uniform()) - 1.0;
}

/// Point i of a sequence that fills the unit square evenly; any number of points, in any order.
///                        [Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"]
Vec3d even_point(std::int64_t i) {
    const auto n = static_cast<double>(i);
    return {std::fmod(0.5 + n * 0.7548776662466927, 1.0), 0.0,
            std::fmod(0.5 + n * 0.5698402909980532, 1.0)};
}

/// The axis of a strand: an arc that starts at its root along `up` and bends towards `side`.
struct Arc {
    Vec3d root, up, side;
    double length = 1.0;
    double bend = 1.0; ///< radians over the whole length, not 0

    [[nodiscard]] Vec3d at(double t) const {
        const double a = bend * t;
        return root + (up * std::sin(a) + side * (1.0 - std::cos(a))) * (length / bend);
    }
    /// The unit normal in the arc's plane; the other one is cross(up, side) everywhere.
    [[nodiscard]] Vec3d normal(double t) const {
        const double a = bend * t;
        return side * std::cos(a) - up * std::sin(a);
    }
};

/// An arc that leans at random by up to `lean` radians and is combed towards +x.
Arc make_arc(CounterRandom& random, Vec3d root, double length, double lean) {
    const double tilt = lean * signed_unit(random);
    const double turn = 0.5 * signed_unit(random);
    const Vec3d side{std::cos(turn), 0.0, std::sin(turn)};
    const Vec3d up = Vec3d{0.0, 1.0, 0.0} * std::cos(tilt) + side * std::sin(tilt);
    const Vec3d bent = side * std::cos(tilt) - Vec3d{0.0, 1.0, 0.0} * std::sin(tilt);
    return {root, up, bent, length * (1.0 + 0.15 * signed_unit(random)),
            1.1 + 0.25 * signed_unit(random)};
}

/// A strand: an offset from an arc, which turns around the arc.
struct Strand {
    Arc arc;
    Vec3d offset;        ///< from the arc's root, on the ground
    double gather = 0.0; ///< how far the offset shrinks towards the tip, in [0, 1]
    double radius = 0.0; ///< of the helix, scene units
    double turns = 0.0;
    double phase = 0.0; ///< radians

    [[nodiscard]] Vec3d at(double t) const {
        const double grown = radius * std::min(1.0, t / 0.15) * (1.0 - 0.4 * t);
        const double angle = 2.0 * kPi * turns * t + phase;
        const Vec3d across = cross(arc.up, arc.side);
        return arc.at(t) + offset * (1.0 - gather * t) +
               (arc.normal(t) * std::cos(angle) + across * std::sin(angle)) * grown;
    }
};

Strand make_hair(const GenerateOptions& o, std::int64_t i) {
    CounterRandom random{o.seed, static_cast<std::uint64_t>(i)};
    const double side = std::sqrt(static_cast<double>(o.nx)) * o.spacing;
    const double length = kHairLength * o.radius;
    Strand s;
    s.arc = make_arc(random, even_point(i) * side, length, 0.15);
    s.radius = 0.012 * length * static_cast<double>(random.uniform());
    s.turns = 1.0 + static_cast<double>(random.uniform());
    s.phase = kPi * signed_unit(random);
    return s;
}

/// The strands of a lock share its arc and helix; each has its own offset in the lock's section.
Strand make_curl(const GenerateOptions& o, std::int64_t i) {
    const std::int64_t lock = i / kLockStrands;
    const std::int64_t locks = (o.nx + kLockStrands - 1) / kLockStrands;
    const double pitch = std::sqrt(static_cast<double>(kLockStrands)) * o.spacing;
    CounterRandom of_lock{o.seed, static_cast<std::uint64_t>(lock)};
    const Vec3d root = even_point(lock) * (std::sqrt(static_cast<double>(locks)) * pitch);
    Strand s;
    s.arc = make_arc(of_lock, root, kHairLength * o.radius, 0.3);
    s.radius = pitch * (0.6 + 0.15 * signed_unit(of_lock));
    s.turns = kTurns * (1.0 + 0.2 * signed_unit(of_lock));
    s.phase = kPi * signed_unit(of_lock);
    CounterRandom random{~o.seed, static_cast<std::uint64_t>(i)};
    const double away = 0.45 * pitch * std::sqrt(static_cast<double>(random.uniform()));
    const double angle = kPi * signed_unit(random);
    s.offset = {away * std::cos(angle), 0.0, away * std::sin(angle)};
    s.gather = 0.6;
    s.arc.length *= 1.0 + 0.04 * signed_unit(random);
    s.phase += 0.25 * signed_unit(random);
    s.radius *= 1.0 + 0.1 * signed_unit(random);
    return s;
}

} // namespace

Geometry generate_hair(const GenerateOptions& o) {
    const Sizes size = sizes(o);
    const auto points = static_cast<std::size_t>(o.ny);
    const auto strands = static_cast<std::size_t>(o.nx);
    const std::size_t grain = std::max<std::size_t>(1, 4096 / points);
    Geometry geometry;
    geometry.curves.push_back(make_empty_curves(size.curves[0], size.per_curve[0], Basis::Linear));
    CurveSet& set = geometry.curves.back();
    set.default_radius = static_cast<float>(o.radius);
    set.radius.resize(set.points.size());
    parallel_chunks(strands, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto n = static_cast<std::int64_t>(i);
            const Strand s = o.kind == GenerateKind::Curls ? make_curl(o, n) : make_hair(o, n);
            for (std::size_t k = 0; k < points; ++k) {
                const double t = static_cast<double>(k) / static_cast<double>(points - 1);
                const double taper = 1.0 - (1.0 - kTipRadius) * t * t;
                set.points[i * points + k] = to_float(s.at(t));
                set.radius[i * points + k] = static_cast<float>(o.radius * taper);
            }
        }
    });
    geometry.materials.push_back(
        {.name = "hair", .kind = MaterialKind::Fiber, .albedo = {0.35f, 0.2f, 0.1f}});
    return geometry;
}

} // namespace heddle::generate_parts
