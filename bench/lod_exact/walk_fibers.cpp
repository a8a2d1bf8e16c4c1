#include "directions.h"

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/voxelize/chord/yarn_frame.h>
#include <heddle/yarn/fiber_source.h>
#include <heddle/yarn/yarn_section.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heddle::bench {
namespace {

constexpr double kStep = 1.0 / 8.0; ///< longest step, subvoxels
constexpr int kRunSteps = 8;        ///< steps per direction
constexpr double kBatch = 2e6;      ///< approximate number of directions
constexpr double kTau = 6.283185307179586;

Vec3i voxel_of(Vec3d p, Vec3d size) {
    Vec3i at;
    for (int a = 0; a < 3; ++a) at[a] = static_cast<std::int32_t>(std::floor(p[a] / size[a]));
    return at;
}

/// The state of a fiber that is visited in steps.
struct Run {
    Vec3d from, at;
    Vec3i voxel;
    double weight = 0.0;
    int steps = 0;

    void flush(std::vector<Directed>& out) {
        if (weight > 0.0) {
            out.push_back({voxel, to_float(normalize(at - from)), static_cast<float>(weight)});
        }
        from = at;
        weight = 0.0;
        steps = 0;
    }
    /// @return  length of the step
    double go_to(Vec3d p, double diameter, Vec3d size, std::vector<Directed>& out) {
        const Vec3i here = voxel_of(0.5 * (at + p), size);
        if (here != voxel || steps == kRunSteps) flush(out);
        const double step = length(p - at);
        voxel = here;
        weight += step * diameter;
        ++steps;
        at = p;
        return step;
    }
};

/// The largest |P'|, or an upper bound.
double fastest(const Cubic& c) {
    return std::max(
        {length(c.c[1]), length(c.c[1] + c.c[2]), length(c.c[1] + 2.0 * c.c[2] + 3.0 * c.c[3])});
}

/// The cross-section of a piece, all in scene units.
YarnSection<double>
section_at(const FiberPiece& piece, const YarnCourse& course, double unit, double t) {
    YarnSection<double> section(piece.cubic, course, t);
    section.scale *= unit;
    return section;
}

/// The fibers of a yarn at one point.                                    [Zhao 2016, sec. 4]
class YarnFibers {
public:
    YarnFibers(const YarnType& yarn, const FiberTable& table) : yarn_(yarn), table_(table) {
        if (yarn.model != YarnModel::Procedural || yarn.flyaways) {
            throw Error(ErrorCode::Unsupported, "yarn with flyaways or of slices",
                        "walk plain fibers");
        }
        if (!yarn.migration) return;
        mean_ = 0.5 * static_cast<double>(yarn.migration_max + yarn.migration_min);
        amplitude_ = 0.5 * static_cast<double>(yarn.migration_max - yarn.migration_min);
    }
    [[nodiscard]] std::size_t count() const { return table_.size(); }
    /// In model units.
    [[nodiscard]] double diameter() const { return 2.0 * static_cast<double>(table_.fiber_radius); }

    /// Calls visit(fiber, position).
    template <typename Visit>
    void at(const YarnSection<double>& place, const YarnCourse& course, const Visit& visit) const {
        const double* turns = course.turns_per_length;
        const double ply_turn = kTau * course.ply_turns(place.s);
        const double fiber_turn = kTau * turns[1] * place.s;
        const double cos_fiber = std::cos(fiber_turn), sin_fiber = std::sin(fiber_turn);
        const double migration_turn = kTau * turns[2] * place.s;
        const double cos_migration = std::cos(migration_turn);
        const double sin_migration = std::sin(migration_turn);
        for (std::size_t ply = 0; ply + 1 < table_.first_of_ply.size(); ++ply) {
            const double base = std::atan2(static_cast<double>(table_.ply_sin[ply]),
                                           static_cast<double>(table_.ply_cos[ply]));
            const double c = std::cos(base + ply_turn), s = std::sin(base + ply_turn);
            const Vec3d u = place.scale * (c * place.normal + s * place.binormal);
            const Vec3d v = place.scale * (c * place.binormal - s * place.normal);
            for (std::size_t i = table_.first_of_ply[ply]; i < table_.first_of_ply[ply + 1]; ++i) {
                const auto cos_0 = static_cast<double>(table_.cos_angle[i]);
                const auto sin_0 = static_cast<double>(table_.sin_angle[i]);
                const double wave = static_cast<double>(table_.cos_migration[i]) * cos_migration -
                                    static_cast<double>(table_.sin_migration[i]) * sin_migration;
                const double r =
                    static_cast<double>(table_.radius[i]) * (mean_ + amplitude_ * wave);
                const double x = static_cast<double>(yarn_.ply_offset) +
                                 static_cast<double>(yarn_.ellipse_short) * r *
                                     (cos_0 * cos_fiber - sin_0 * sin_fiber);
                const double y = static_cast<double>(yarn_.ellipse_long) * r *
                                 (sin_0 * cos_fiber + cos_0 * sin_fiber);
                visit(i, place.center + x * u + y * v);
            }
        }
    }

private:
    const YarnType& yarn_;
    const FiberTable& table_;
    double mean_ = 1.0;
    double amplitude_ = 0.0;
};

/// Visits all fibers of a piece at once.
/// @return  the longest step, scene units
double walk_yarn(const YarnFibers& fibers,
                 const FiberPiece& piece,
                 const YarnCourse& course,
                 const LatticeUnits& u,
                 int count,
                 std::vector<Directed>& out) {
    std::vector<Run> runs(fibers.count());
    double longest = 0.0;
    for (int j = 0; j <= count; ++j) {
        const YarnSection<double> place =
            section_at(piece, course, u.unit, static_cast<double>(j) / count);
        fibers.at(place, course, [&](std::size_t i, Vec3d p) {
            if (j == 0) {
                runs[i].from = runs[i].at = p;
            } else {
                const double diameter = fibers.diameter() * place.scale;
                longest = std::max(longest, runs[i].go_to(p, diameter, u.voxel_size, out));
            }
        });
    }
    for (Run& run : runs) run.flush(out);
    return longest;
}

/// Fibers outside in a bend are longer than the centreline: the number of steps is found by trying.
void walk_yarn(const FiberSource& source,
               const LatticeUnits& units,
               const FiberPiece& piece,
               const FiberTable& table,
               std::vector<Directed>& out) {
    const YarnFibers fibers(*source.yarn_of(piece.set), table);
    const YarnCourse course = source.course(piece, units.unit);
    const std::size_t before = out.size();
    const double allowed = kStep * units.unit;
    double steps = 1.5 * fastest(piece.cubic) / allowed;
    for (double longest = allowed * 2.0; longest > allowed;) {
        out.resize(before);
        longest = walk_yarn(fibers, piece, course, units, static_cast<int>(std::ceil(steps)), out);
        steps *= 1.05 * longest / allowed;
    }
}

/// Visits a curve that is one fiber.
void walk_plain(const FiberSource& source,
                const LatticeUnits& u,
                const FiberPiece& piece,
                std::vector<Directed>& out) {
    const YarnCourse course = source.course(piece, u.unit);
    const auto count = static_cast<int>(std::ceil(fastest(piece.cubic) / (kStep * u.unit)));
    Run run;
    run.from = run.at = piece.cubic.at(0.0);
    for (int j = 1; j <= count; ++j) {
        const double t = static_cast<double>(j) / count;
        const double radius =
            (1.0 - t) * static_cast<double>(course.scale0) + t * static_cast<double>(course.scale1);
        run.go_to(piece.cubic.at(t), 2.0 * radius * u.unit, u.voxel_size, out);
    }
    run.flush(out);
}

/// The fibers of the yarn that was used last.
struct TableMemo {
    std::uint32_t set = ~0u;
    std::uint64_t curve = ~std::uint64_t{0};
    FiberTable table;

    const FiberTable& of(const FiberSource& source, const FiberPiece& piece) {
        if (set != piece.set || curve != piece.curve) {
            // numbered as in the voxelizer: other fibers would be another object
            table =
                place_fibers(*source.yarn_of(piece.set), source.seed() + piece.set, piece.curve);
            set = piece.set;
            curve = piece.curve;
        }
        return table;
    }
};

void walk_span(const FiberSource& source,
               const LatticeUnits& units,
               std::uint64_t span,
               TableMemo& memo,
               std::vector<Directed>& out) {
    const FiberPiece whole = source.whole_span(span);
    const YarnType* yarn = source.yarn_of(whole.set);
    for (std::uint32_t part = 0; part < whole.parts; ++part) {
        const FiberPiece piece = part_of(whole, part);
        if (yarn == nullptr || yarn->model == YarnModel::Solid) {
            walk_plain(source, units, piece, out);
        } else {
            walk_yarn(source, units, piece, memo.of(source, piece), out);
        }
    }
}

} // namespace

void walk_fibers(const Geometry& geometry,
                 const Lattice& lattice,
                 std::uint64_t seed,
                 const TakeDirections& take) {
    const LatticeUnits units(lattice);
    const FiberSource source(geometry, piece_length_of(units), seed);
    std::vector<Directed> batch;
    for (std::uint64_t begin = 0; begin < source.span_count();) {
        std::uint64_t end = begin;
        for (double size = 0.0; end < source.span_count() && size < kBatch; ++end) {
            const FiberPiece span = source.whole_span(end);
            size += static_cast<double>(source.fiber_count(span.set)) *
                    (1.0 + span.cubic.polygon_length() / units.unit);
        }
        const std::size_t grain = std::max<std::size_t>(1, (end - begin) / 64);
        batch = reduce_chunks(
            end - begin, grain, std::vector<Directed>(),
            [&](std::size_t b, std::size_t e) {
                std::vector<Directed> out;
                TableMemo memo;
                for (std::size_t i = b; i < e; ++i) walk_span(source, units, begin + i, memo, out);
                return out;
            },
            [](std::vector<Directed> a, const std::vector<Directed>& b) {
                a.insert(a.end(), b.begin(), b.end());
                return a;
            });
        take(batch);
        begin = end;
    }
}

} // namespace heddle::bench
