#pragma once

#include <heddle/base/trig.h>
#include <heddle/render/embree/round_curves.h>
#include <heddle/yarn/fiber_source.h>
#include <heddle/yarn/fiber_table.h>
#include <heddle/yarn/yarn_section.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace heddle {

/// The yarn frame at one point, in scene units; `scale` is in scene units per model unit.
using TracedYarnFrame = YarnSection<double>;

/// The position and axes of a ply's section at one point.
struct TracedPlyFrame {
    Vec3d center, u, v; ///< a fiber is at center + x u + y v, x and y in model units
};

/// The fibers of one yarn, in double precision, with the same paths as in the voxelizer.
///                                                                     [Zhao 2016, sec. 4]
class YarnPath {
public:
    /// @param first_span  first span of the curve among all spans of the source
    /// @param unit        unit of the courses' scales, which are in single precision; scene units
    YarnPath(const FiberSource& source, std::uint64_t first_span, double unit);

    [[nodiscard]] std::size_t span_count() const { return spans_.size(); }
    [[nodiscard]] const FiberTable& table() const { return table_; }
    [[nodiscard]] const YarnType& yarn() const { return yarn_; }
    [[nodiscard]] bool closed() const { return spans_.front().course.closed; }
    [[nodiscard]] double total() const { return spans_.front().course.total; } ///< model units
    [[nodiscard]] std::uint64_t seed() const { return seed_; }
    [[nodiscard]] std::uint64_t curve() const { return curve_; }
    [[nodiscard]] std::size_t ply_count() const { return table_.first_of_ply.size() - 1; }

    /// @param t  knots from the start of the curve, in [0, span_count()]; periodic if closed
    [[nodiscard]] TracedYarnFrame at(double t) const;
    /// @param s  yarn length, model units, in [0, total]
    /// @return   knots from the start, linear in the length within a span
    [[nodiscard]] double knot_of_length(double s) const;
    [[nodiscard]] TracedPlyFrame ply(const TracedYarnFrame& at, std::size_t ply) const;

    /// Calls visit(fiber, position, radius) for all fibers at one point, in the table's order.
    /// @param t  as in `at`
    template <typename Visit>
    void for_each_fiber(double t, const Visit& visit) const;

private:
    struct Span {
        Cubic cubic;
        YarnCourse course;
    };
    [[nodiscard]] double loop_factor(std::size_t fiber, double s) const;

    const YarnType& yarn_;
    double unit_;
    std::uint64_t seed_;
    std::uint64_t curve_ = 0;
    FiberTable table_;
    std::vector<Span> spans_;
    double offset_ = 0.0, short_axis_ = 1.0, long_axis_ = 1.0; ///< of a ply's section
    double mean_ = 1.0, amplitude_ = 0.0; ///< migrating radius = R (mean + amplitude cos phase)
    bool loops_ = false;
};

template <typename Visit>
void YarnPath::for_each_fiber(double t, const Visit& visit) const {
    const TracedYarnFrame yarn = at(t);
    const double* turns = spans_.front().course.turns_per_length;
    const SinCos fiber = sincos_turns(turns[1] * yarn.s);
    const SinCos wave = sincos_turns(turns[2] * yarn.s);
    const double radius = static_cast<double>(table_.fiber_radius) * yarn.scale;
    const auto d = [](float x) { return static_cast<double>(x); };
    for (std::size_t p = 0; p < ply_count(); ++p) {
        const TracedPlyFrame frame = ply(yarn, p);
        for (std::size_t i = table_.first_of_ply[p]; i < table_.first_of_ply[p + 1]; ++i) {
            const double phase =
                d(table_.cos_migration[i]) * d(wave.cos) - d(table_.sin_migration[i]) * d(wave.sin);
            double r = d(table_.radius[i]) * (mean_ + amplitude_ * phase);
            if (loops_) r *= loop_factor(i, yarn.s);
            const double c =
                d(table_.cos_angle[i]) * d(fiber.cos) - d(table_.sin_angle[i]) * d(fiber.sin);
            const double s =
                d(table_.sin_angle[i]) * d(fiber.cos) + d(table_.cos_angle[i]) * d(fiber.sin);
            visit(i,
                  frame.center + (offset_ + short_axis_ * r * c) * frame.u +
                      (long_axis_ * r * s) * frame.v,
                  radius);
        }
    }
}

} // namespace heddle
