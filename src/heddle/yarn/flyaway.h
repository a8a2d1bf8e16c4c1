#pragma once

#include <heddle/base/random.h>
#include <heddle/base/trig.h>
#include <heddle/geom/yarn.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace heddle {

/// Returns a random deviate of standard deviation 1 from a hash: the sum of four uniform numbers,
/// clamped to +-2.5.
[[nodiscard]] HEDDLE_HD inline double deviate(std::uint64_t hash) {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += static_cast<double>((hash >> (16 * i)) & 0xffff) / 65536.0;
    const double x = (sum - 2.0) * 1.7320508075688772;
    return x < -2.5 ? -2.5 : x > 2.5 ? 2.5 : x;
}
[[nodiscard]] HEDDLE_HD inline double deviate(MeanSd of, std::uint64_t hash) {
    return static_cast<double>(of.mean) + static_cast<double>(of.sd) * deviate(hash);
}

/// Loop flyaways: a fiber may be pulled out to a loop where its migration is farthest from the
/// axis.
///                                                [Zhao 2016, sec. 5.2]
class LoopModel {
public:
    /// @param yarn  a YarnType or a YarnView
    template <typename Yarn>
    HEDDLE_HD explicit LoopModel(const Yarn& yarn)
        : reach_(yarn.loop_r1),
          section_(std::sqrt(yarn.ellipse_long * yarn.ellipse_short) *
                   (yarn.migration ? yarn.migration_max : 1.0f)),
          frequency_(static_cast<double>(yarn.migration_frequency) /
                     static_cast<double>(yarn.fiber_pitch)) {
        const auto frequency = static_cast<double>(yarn.migration_frequency);
        const double period =
            static_cast<double>(yarn.fiber_pitch) / (frequency < 1e-6 ? 1e-6 : frequency);
        chance_ = static_cast<double>(yarn.loop_density) * period / yarn.fibers_per_ply;
    }

    /// Returns the id of a fiber for ratio().
    /// @param seed  seed of the run plus the number of the set of curves
    [[nodiscard]] HEDDLE_HD static std::uint64_t
    id(std::uint64_t seed, std::uint64_t curve, std::uint64_t fiber) {
        return hash64(seed + 0x6c6f6f70u, curve, fiber);
    }

    /// Returns the largest distance of a period's loop over the fiber's own distance; 1: no loop.
    /// @param id      id of the fiber
    /// @param period  number of the migration period, which starts half a turn before its outermost
    ///                point
    /// @param radius  FiberTable::radius of the fiber
    [[nodiscard]] HEDDLE_HD double ratio(std::uint64_t id, double period, float radius) const {
        const std::uint64_t draw =
            hash64(id, static_cast<std::uint64_t>(static_cast<long long>(period)));
        const float rest = radius * section_;
        if (static_cast<double>(to_unit_float(draw)) >= chance_ || rest <= 0.0f) return 1.0;
        const double ratio = deviate(reach_, hash64(id, draw, 1)) / static_cast<double>(rest);
        return ratio > 1.05 ? ratio : 1.0; // no loop where the fiber already runs as far out
    }

    /// Returns the factor of a fiber's distance from its ply's axis: 1, or in a period with a loop
    /// 1 + (ratio - 1) cos(pi w), where w is the distance from the outermost point in periods.
    /// @param ratio  ratio() of the period
    /// @param phase  migration phase in turns; whole numbers are the outermost points
    [[nodiscard]] HEDDLE_HD static float factor(double ratio, double phase) {
        const double w = phase - period_of(phase);
        const double bump = 1.0 - 4.0 * w * w; // cos(pi w) to 6 %, and 0 at the period's ends
        return static_cast<float>(1.0 + (ratio - 1.0) * bump);
    }
    /// Returns the migration phase of a fiber at yarn length s, in turns.
    /// @param turns  its phase at the yarn's start
    [[nodiscard]] HEDDLE_HD double phase_at(double s, float turns) const {
        return s * frequency_ + static_cast<double>(turns);
    }
    [[nodiscard]] HEDDLE_HD static double period_of(double phase) {
        const double from_start = phase + 0.5; // a period starts half a turn before
        const auto whole = static_cast<double>(static_cast<long long>(from_start));
        return whole > from_start ? whole - 1.0 : whole;
    }

private:
    MeanSd reach_;
    float section_ = 0.0f;
    double frequency_ = 0.0; ///< migration turns per model unit
    double chance_ = 0.0;
};

/// Caches the ratio of the migration period that was asked for last.
struct LoopMemo {
    double period = 1e300;
    double value = 1.0;

    [[nodiscard]] HEDDLE_HD double
    ratio(const LoopModel& model, std::uint64_t id, double of_period, float radius) {
        if (period != of_period) {
            period = of_period;
            value = model.ratio(id, of_period, radius);
        }
        return value;
    }
};

/// A hair flyaway in its ply's frame. At parameter q in [t0, t1] it is at yarn length z0 + ze q, at
/// distance r0 + re q from the ply's axis and at angle p0 + pe q, in model units and radians.
struct FlyawayHair {
    double z0, ze, r0, re, p0, pe;
    double t0, t1;
};

/// The parameters of a yarn type's hair flyaways.
struct HairShape {
    float density = 0.0f; ///< per ply and model unit
    float yarn_radius = 1.0f;
    MeanSd ze, r0, re, pe;

    template <typename Yarn>
    HEDDLE_HD explicit HairShape(const Yarn& yarn)
        : density(yarn.hair_density),
          yarn_radius(yarn.model_radius),
          ze(yarn.hair_ze),
          r0(yarn.hair_r0),
          re(yarn.hair_re),
          pe(yarn.hair_pe) {}
};

/// The identity of a ply, which its random hairs depend on.
struct HairPly {
    std::uint64_t seed; ///< seed of the run plus the number of the set of curves
    std::uint64_t curve, ply;
};

/// The hair flyaways of one yarn: one per cell of length 1 / density, random by the cell's number.
///                                                                       [Zhao 2016, 5.2]
class HairModel {
public:
    /// @param total  length of the yarn, model units
    HEDDLE_HD HairModel(const HairShape& shape, double total, bool closed)
        : shape_(shape), total_(total), closed_(closed) {
        const auto cells = static_cast<std::int64_t>(total * static_cast<double>(shape.density));
        cells_ = cells > 1 ? cells : 1;
        cell_ = total / static_cast<double>(cells_);
        // a hair begins up to kRoot of its extent before its emergence
        reach_ = (1.0 + kRoot) * (std::fabs(static_cast<double>(shape.ze.mean)) +
                                  2.5 * static_cast<double>(shape.ze.sd));
    }

    /// A range of cells whose hairs may touch a range of yarn length. At the ends of an open yarn
    /// some of them do not exist.
    struct Cells {
        std::int64_t first = 0, last = -1;
        [[nodiscard]] HEDDLE_HD std::int64_t count() const { return last - first + 1; }
    };
    [[nodiscard]] HEDDLE_HD Cells cells(double s0, double s1) const {
        if (!(cell_ > 0.0) || !(s1 > s0)) return {};
        return {static_cast<std::int64_t>(std::floor((s0 - reach_) / cell_)),
                static_cast<std::int64_t>(std::floor((s1 + reach_) / cell_))};
    }

    /// Sets `hair` to the part of a cell's hair within yarn length [s0, s1).
    /// @return  false: there is none
    [[nodiscard]] HEDDLE_HD bool
    hair_of(std::int64_t cell, const HairPly& ply, double s0, double s1, FlyawayHair& hair) const {
        if (!closed_ && (cell < 0 || cell >= cells_)) return false;
        const std::int64_t turn = closed_ ? floor_div(cell, cells_) : 0;
        const auto own = static_cast<std::uint64_t>(cell - turn * cells_);
        CounterRandom random{.seed = hash64(ply.seed + 0x68616972u, ply.curve, ply.ply), .id = own};
        hair = place(random, own);
        hair.z0 += static_cast<double>(turn) * total_;
        // most hairs near a piece do not reach it and need no more random numbers
        const double end = hair.z0 + hair.ze;
        const double root = hair.z0 - kRoot * hair.ze;
        const double least = end < root ? end : root;
        const double most = end < root ? root : end;
        if (most <= s0 || least >= s1) return false;
        shape(random, hair);
        cut(s0, s1, hair);
        return hair.t0 < hair.t1;
    }

    /// Calls visit(hair) for each part of a ply's hairs within yarn length [s0, s1); see hair_of().
    template <typename Visit>
    void for_each(const HairPly& ply, double s0, double s1, const Visit& visit) const {
        const Cells all = cells(s0, s1);
        for (std::int64_t cell = all.first; cell <= all.last; ++cell) {
            FlyawayHair hair;
            if (hair_of(cell, ply, s0, s1, hair)) visit(hair);
        }
    }

private:
    static constexpr double kRoot = 2.0;

    [[nodiscard]] HEDDLE_HD FlyawayHair place(CounterRandom& random, std::uint64_t cell) const {
        FlyawayHair hair{};
        hair.z0 = (static_cast<double>(cell) + static_cast<double>(random.uniform())) * cell_;
        hair.ze = deviate(shape_.ze, random.next());
        // a hair perpendicular to the yarn still needs a nonzero extent along the yarn
        const double least = 1e-3 * static_cast<double>(shape_.yarn_radius);
        if (std::fabs(hair.ze) < least) hair.ze = hair.ze < 0.0 ? -least : least;
        return hair;
    }
    HEDDLE_HD void shape(CounterRandom& random, FlyawayHair& hair) const {
        const double r0 = deviate(shape_.r0, random.next());
        hair.r0 = r0 > 0.0 ? r0 : 0.0;
        const double re = deviate(shape_.re, random.next());
        const double least = 0.1 * static_cast<double>(shape_.re.mean);
        hair.re = least < re ? re : least;
        hair.p0 = 6.283185307179586 * static_cast<double>(random.uniform());
        hair.pe = deviate(shape_.pe, random.next());
        const double before = hair.re > 0.0 ? hair.r0 / hair.re : 0.0;
        hair.t0 = -(before < kRoot ? before : kRoot);
        hair.t1 = 1.0;
    }

    /// Clips a hair's parameter range to yarn length [s0, s1).
    HEDDLE_HD static void cut(double s0, double s1, FlyawayHair& hair) {
        const double qa = (s0 - hair.z0) / hair.ze;
        const double qb = (s1 - hair.z0) / hair.ze;
        const double q0 = qa < qb ? qa : qb;
        const double q1 = qa < qb ? qb : qa;
        hair.t0 = hair.t0 < q0 ? q0 : hair.t0;
        hair.t1 = q1 < hair.t1 ? q1 : hair.t1;
    }

    HairShape shape_;
    double total_;
    bool closed_;
    std::int64_t cells_ = 1;
    double cell_ = 0.0;
    double reach_ = 0.0;
};

/// Returns the number of chords of about 4 units for a part of a hair flyaway.
/// @param scale  units per model unit at the piece's start
[[nodiscard]] HEDDLE_HD inline int hair_chord_count(const FlyawayHair& hair, double scale) {
    const double size = scale * (std::fabs(hair.ze) + std::fabs(hair.re) +
                                 std::fabs(hair.pe) * (hair.r0 + std::fabs(hair.re)));
    const double count = std::ceil(size * (hair.t1 - hair.t0) / 4.0);
    return count < 1.0 ? 1 : count > 64.0 ? 64 : static_cast<int>(count);
}

} // namespace heddle
