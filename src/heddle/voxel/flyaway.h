#pragma once

#include <heddle/base/random.h>
#include <heddle/base/trig.h>
#include <heddle/geom/yarn.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace heddle {

/// A deviate of standard deviation 1 from one hash: the sum of four uniforms, cut at 2.5.
[[nodiscard]] inline double deviate(std::uint64_t hash) {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += static_cast<double>((hash >> (16 * i)) & 0xffff) / 65536.0;
    return std::clamp((sum - 2.0) * 1.7320508075688772, -2.5, 2.5);
}

/// Loop flyaways: where a fiber's migration is farthest out, it may be pulled out to a loop.
///                                                                     [Zhao 2016, sec. 5.2]
class LoopModel {
public:
    explicit LoopModel(const YarnType& yarn)
        : yarn_(yarn),
          section_(std::sqrt(yarn.ellipse_long * yarn.ellipse_short) *
                   (yarn.migration ? yarn.migration_max : 1.0f)) {
        const double period = static_cast<double>(yarn.fiber_pitch) /
                              std::max(static_cast<double>(yarn.migration_frequency), 1e-6);
        chance_ = static_cast<double>(yarn.loop_density) * period / yarn.fibers_per_ply;
    }

    [[nodiscard]] static std::uint64_t
    id(std::uint64_t seed, std::uint64_t curve, std::uint64_t fiber) {
        return hash64(seed + 0x6c6f6f70u, curve, fiber);
    }

    /// How far out the loop of a period goes, times the fiber's own distance; 1: no loop.
    /// @param id      of the fiber
    /// @param period  number of the migration's period, from half a turn before its outermost point
    /// @param radius  the fiber's, of the unit section
    [[nodiscard]] double ratio(std::uint64_t id, double period, float radius) const {
        const std::uint64_t draw =
            hash64(id, static_cast<std::uint64_t>(static_cast<long long>(period)));
        const float rest = radius * section_;
        if (static_cast<double>(to_unit_float(draw)) >= chance_ || rest <= 0.0f) return 1.0;
        const double reach = static_cast<double>(yarn_.loop_r1.mean) +
                             static_cast<double>(yarn_.loop_r1.sd) * deviate(hash64(id, draw, 1));
        const double ratio = reach / static_cast<double>(rest);
        return ratio > 1.05 ? ratio : 1.0; // no loop where the fiber already runs as far out
    }

    /// What multiplies a fiber's distance from its ply's axis: 1, or in a loop's period
    /// 1 + (ratio - 1) cos(pi w), w the distance from the outermost point in periods.
    /// @param ratio  of the phase's period
    /// @param phase  migration phase, turns; whole numbers are outermost points
    [[nodiscard]] static float factor(double ratio, double phase) {
        const double w = phase - period_of(phase);
        const double bump = 1.0 - 4.0 * w * w; // cos(pi w) to 6 %, and 0 at the period's ends
        return static_cast<float>(1.0 + (ratio - 1.0) * bump);
    }
    [[nodiscard]] static double period_of(double phase) {
        const auto whole = static_cast<double>(static_cast<long long>(phase + 0.5));
        return whole > phase + 0.5 ? whole - 1.0 : whole;
    }

private:
    const YarnType& yarn_;
    float section_;
    double chance_;
};

/// A hair flyaway in its ply's frame: at parameter q in [t0, t1] it lies at yarn length z0 + ze q,
/// distance r0 + re q from the ply's axis, angle p0 + pe q. Model units, radians.
struct FlyawayHair {
    double z0, ze, r0, re, p0, pe;
    double t0, t1;
};

/// Hair flyaways: one a cell of yarn length 1 / density, drawn by the cell's number. [Zhao 2016, 5.2]
class HairModel {
public:
    HairModel(const YarnType& yarn, double total, bool closed)
        : yarn_(yarn), total_(total), closed_(closed) {
        cells_ = std::max<std::int64_t>(
            1, static_cast<std::int64_t>(total * static_cast<double>(yarn.hair_density)));
        cell_ = total / static_cast<double>(cells_);
        // a hair begins up to kRoot of its extent before its emergence
        reach_ = (1.0 + kRoot) * (std::abs(static_cast<double>(yarn.hair_ze.mean)) +
                                  2.5 * static_cast<double>(yarn.hair_ze.sd));
    }

    /// Calls visit(hair) for the part of each hair that lies over yarn length [s0, s1).
    template <typename Visit>
    void for_each(std::uint64_t seed,
                  std::uint64_t curve,
                  std::uint64_t ply,
                  double s0,
                  double s1,
                  const Visit& visit) const {
        if (!(cell_ > 0.0) || !(s1 > s0)) return;
        const auto first = static_cast<std::int64_t>(std::floor((s0 - reach_) / cell_));
        const auto last = static_cast<std::int64_t>(std::floor((s1 + reach_) / cell_));
        for (std::int64_t cell = first; cell <= last; ++cell) {
            if (!closed_ && (cell < 0 || cell >= cells_)) continue;
            const std::int64_t turn = closed_ ? floor_div(cell, cells_) : 0;
            const auto own = static_cast<std::uint64_t>(cell - turn * cells_);
            CounterRandom random{.seed = hash64(seed + 0x68616972u, curve, ply), .id = own};
            FlyawayHair hair = place(random, own);
            hair.z0 += static_cast<double>(turn) * total_;
            // most hairs near a piece do not reach it: the rest of the draw is not needed
            const double end = hair.z0 + hair.ze;
            const double root = hair.z0 - kRoot * hair.ze;
            if (std::max(end, root) <= s0 || std::min(end, root) >= s1) continue;
            shape(random, hair);
            const double qa = (s0 - hair.z0) / hair.ze;
            const double qb = (s1 - hair.z0) / hair.ze;
            hair.t0 = std::max(hair.t0, std::min(qa, qb));
            hair.t1 = std::min(hair.t1, std::max(qa, qb));
            if (hair.t0 < hair.t1) visit(hair);
        }
    }

private:
    static constexpr double kRoot = 2.0;

    [[nodiscard]] double normal(CounterRandom& random, MeanSd v) const {
        return static_cast<double>(v.mean) + static_cast<double>(v.sd) * deviate(random.next());
    }
    [[nodiscard]] FlyawayHair place(CounterRandom& random, std::uint64_t cell) const {
        FlyawayHair hair{};
        hair.z0 = (static_cast<double>(cell) + static_cast<double>(random.uniform())) * cell_;
        hair.ze = normal(random, yarn_.hair_ze);
        // a hair straight out still passes through some yarn length: it has one place on the yarn
        const double least = 1e-3 * static_cast<double>(yarn_.model_radius);
        if (std::abs(hair.ze) < least) hair.ze = hair.ze < 0.0 ? -least : least;
        return hair;
    }
    void shape(CounterRandom& random, FlyawayHair& hair) const {
        hair.r0 = std::max(0.0, normal(random, yarn_.hair_r0));
        hair.re =
            std::max(0.1 * static_cast<double>(yarn_.hair_re.mean), normal(random, yarn_.hair_re));
        hair.p0 = 6.283185307179586 * static_cast<double>(random.uniform());
        hair.pe = normal(random, yarn_.hair_pe);
        hair.t0 = hair.re > 0.0 ? -std::min(kRoot, hair.r0 / hair.re) : 0.0;
        hair.t1 = 1.0;
    }

    const YarnType& yarn_;
    double total_;
    bool closed_;
    std::int64_t cells_ = 1;
    double cell_ = 0.0;
    double reach_ = 0.0;
};

} // namespace heddle
