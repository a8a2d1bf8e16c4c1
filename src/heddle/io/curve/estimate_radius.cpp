#include <heddle/io/curve/estimate_radius.h>

#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/geom/bounds.h>
#include <heddle/io/curve/curve_span.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace heddle {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr std::size_t kMaxProbes = 4096;
constexpr int kMaxRounds = 24; // the search radius grows from one chord to 2^23 chords
// Arc length / straight distance; pi/2 is a half circle. All values from 1.6 to 4 give the six
// sample .bcc files the same radius.
constexpr double kWayAround = 2.0;
constexpr double kMaxPieces = 64; // per chord: bounds the time for an outlier

/// A point of a centreline whose nearest neighbour is searched.
struct Probe {
    Vec3d position;
    std::size_t curve = 0;
    double along = 0.0; ///< arc length from the curve's start, scene units
};

/// The smallest distance so far, of all threads. The bits of doubles >= 0 sort like the doubles.
class Nearest {
public:
    [[nodiscard]] double get() const { return std::bit_cast<double>(bits_.load()); }
    void offer(double d) {
        const auto bits = std::bit_cast<std::uint64_t>(d);
        std::uint64_t old = bits_.load(std::memory_order_relaxed);
        while (bits < old && !bits_.compare_exchange_weak(old, bits)) {
        }
    }

private:
    std::atomic<std::uint64_t> bits_{
        std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity())};
};

/// A straight piece of a centreline. `along` is linear over the spans of a curve: accurate enough
/// to tell a neighbour from the probe's own part, and it needs no table of arc lengths.
struct Chord {
    Vec3d a, b;
    std::size_t curve = 0;
    double along_a = 0.0, along_b = 0.0;
};

/// Finds the probes that a piece of yarn is compared with, by hashed cells of twice the reach. A
/// probe is in each cell (at most 8) that can contain the middle of a piece within its reach.
class ProbeGrid {
public:
    /// @param wanted  per probe: whether its search continues
    ProbeGrid(const std::vector<Probe>& probes, const std::vector<char>& wanted, double reach)
        : cell_(2.0 * reach), mask_(std::bit_ceil(probes.size() * 16) - 1) {
        std::vector<std::pair<std::size_t, std::uint32_t>> entries;
        for (std::size_t i = 0; i < probes.size(); ++i) {
            if (wanted[i] == 0) continue;
            const Vec3d r{reach, reach, reach};
            const Vec3<std::int64_t> lo = cell_of(probes[i].position - r);
            const Vec3<std::int64_t> hi = cell_of(probes[i].position + r);
            for (std::int64_t z = lo.z; z <= hi.z; ++z) {
                for (std::int64_t y = lo.y; y <= hi.y; ++y) {
                    for (std::int64_t x = lo.x; x <= hi.x; ++x) {
                        entries.emplace_back(bucket({x, y, z}), static_cast<std::uint32_t>(i));
                    }
                }
            }
        }
        std::sort(entries.begin(), entries.end());
        start_.assign(mask_ + 2, 0);
        for (const auto& [b, i] : entries) {
            ++start_[b + 1];
            probe_.push_back(i);
        }
        for (std::size_t b = 0; b <= mask_; ++b) start_[b + 1] += start_[b];
    }

    template <typename Visit>
    void visit_near(Vec3d p, const Visit& visit) const {
        const std::size_t b = bucket(cell_of(p));
        for (std::uint32_t e = start_[b]; e < start_[b + 1]; ++e) visit(probe_[e]);
    }

private:
    [[nodiscard]] Vec3<std::int64_t> cell_of(Vec3d p) const {
        const auto cell = [&](double x) { // clamped: a far outlier must not overflow
            return static_cast<std::int64_t>(std::clamp(std::floor(x / cell_), -0x1p60, 0x1p60));
        };
        return {cell(p.x), cell(p.y), cell(p.z)};
    }
    [[nodiscard]] std::size_t bucket(Vec3<std::int64_t> c) const {
        return hash64(static_cast<std::uint64_t>(c.x), static_cast<std::uint64_t>(c.y),
                      static_cast<std::uint64_t>(c.z)) &
               mask_;
    }

    double cell_;
    std::size_t mask_;
    std::vector<std::uint32_t> start_; ///< per bucket, first index into `probe_`
    std::vector<std::uint32_t> probe_;
};

/// Per curve, the mean length of a span (as two chords), from at most 256 of its spans.
std::vector<double> measure_span_lengths(const CurveSet& set) {
    constexpr std::size_t kMax = 256; // enough to tell a bend from a neighbour
    std::vector<double> span_length(set.curve_count(), 0.0);
    parallel_chunks(span_length.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const std::size_t spans = set.span_count(c);
            const std::size_t used = std::min(spans, kMax);
            double sum = 0.0;
            for (std::size_t i = 0; i < used; ++i) {
                const BezierSpan b = bezier_span(set, c, i * spans / used);
                const Vec3d middle = evaluate(b, 0.5);
                sum += length(middle - b[0]) + length(b[3] - middle);
            }
            if (used > 0) span_length[c] = sum / static_cast<double>(used);
        }
    });
    return span_length;
}

/// Probes at jittered points: with a fixed stride all loops of a knit would have theirs at the same
/// point.
std::vector<Probe> place_probes(const CurveSet& set, const std::vector<double>& span_length) {
    const std::size_t n = set.points.size();
    const std::size_t count = std::min(n, kMaxProbes);
    std::vector<Probe> probes;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = i * n / count;
        const std::size_t p = begin + hash64(0, i) % ((i + 1) * n / count - begin);
        visit_spans(set, p, p + 1, [&](std::size_t curve, std::size_t span) {
            probes.push_back({bezier_span(set, curve, span)[0], curve,
                              static_cast<double>(span) * span_length[curve]});
        });
    }
    return probes;
}

/// The distance from a probe to a piece; infinity for the probe's own part.
double distance_to_other(const CurveSet& set,
                         const std::vector<double>& span_length,
                         const Probe& probe,
                         const Chord& piece) {
    const Vec3d ab = piece.b - piece.a;
    const double squared = dot(ab, ab);
    const double t =
        squared > 0.0 ? std::clamp(dot(probe.position - piece.a, ab) / squared, 0.0, 1.0) : 0.0;
    const double d = length(probe.position - (piece.a + ab * t));
    if (probe.curve != piece.curve) return d;
    double way = std::abs(piece.along_a + (piece.along_b - piece.along_a) * t - probe.along);
    if (set.is_closed(piece.curve)) {
        const double around =
            span_length[piece.curve] * static_cast<double>(set.span_count(piece.curve));
        way = std::min(way, around - way);
    }
    // one more span: at the probe itself both lengths are 0, except for rounding
    return way > kWayAround * d + span_length[piece.curve]
               ? d
               : std::numeric_limits<double>::infinity();
}

/// Calls visit(piece) for the span's two chords, divided into pieces at most `longest` long.
template <typename Visit>
void visit_pieces(const CurveSet& set,
                  std::size_t curve,
                  std::size_t span,
                  double step,
                  double longest,
                  const Visit& visit) {
    const BezierSpan bezier = bezier_span(set, curve, span);
    const std::array<Vec3d, 3> at{bezier[0], evaluate(bezier, 0.5), bezier[3]};
    for (std::size_t half = 0; half < 2; ++half) {
        const Vec3d ab = at[half + 1] - at[half];
        const double along = (static_cast<double>(span) + 0.5 * static_cast<double>(half)) * step;
        const double pieces = std::clamp(std::ceil(length(ab) / longest), 1.0, kMaxPieces);
        for (double i = 0.0; i < pieces; i += 1.0) {
            const double t0 = i / pieces;
            const double t1 = (i + 1.0) / pieces;
            visit(Chord{at[half] + ab * t0, at[half] + ab * t1, curve, along + 0.5 * step * t0,
                        along + 0.5 * step * t1});
        }
    }
}

/// Compares every chord of the set with the probes: one round finds all neighbours within `reach`.
void search_within(const CurveSet& set,
                   const std::vector<double>& span_length,
                   double reach,
                   const std::vector<Probe>& probes,
                   std::vector<Nearest>& nearest) {
    std::vector<char> wanted(probes.size());
    for (std::size_t i = 0; i < probes.size(); ++i) { // the previous round searched half as far
        wanted[i] = nearest[i].get() > 0.5 * reach ? 1 : 0;
    }
    // a piece is at most `reach` long, so its middle is within 1.5 reach of the probes within reach
    // of the piece
    const ProbeGrid grid(probes, wanted, 1.5 * reach);
    parallel_chunks(set.points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        visit_spans(set, begin, end, [&](std::size_t curve, std::size_t span) {
            visit_pieces(set, curve, span, span_length[curve], reach, [&](const Chord& piece) {
                grid.visit_near((piece.a + piece.b) * 0.5, [&](std::uint32_t i) {
                    nearest[i].offer(distance_to_other(set, span_length, probes[i], piece));
                });
            });
        });
    });
}

Bounds bound_points(const CurveSet& set) {
    Bounds box;
    for (const Vec3f& p : set.points) box.grow(to_double(p));
    return box;
}

} // namespace

float estimate_radius(const CurveSet& set) {
    const std::vector<double> span_length = measure_span_lengths(set);
    const std::vector<Probe> probes = place_probes(set, span_length);
    double sum = 0.0;
    for (const Probe& p : probes) sum += span_length[p.curve];
    if (!(sum > 0.0)) return 0.0f;

    std::vector<Nearest> nearest(probes.size());
    const double diagonal = length(bound_points(set).size());
    double reach = sum / static_cast<double>(probes.size());
    for (int round = 0; round < kMaxRounds; ++round, reach *= 2.0) {
        search_within(set, span_length, reach, probes, nearest);
        std::vector<double> distance(probes.size());
        std::transform(nearest.begin(), nearest.end(), distance.begin(),
                       [](const Nearest& n) { return n.get(); });
        const auto middle = distance.begin() + static_cast<std::ptrdiff_t>(distance.size() / 2);
        std::nth_element(distance.begin(), middle, distance.end());
        // distances up to `reach` are exact, others are larger
        if (*middle <= reach) return static_cast<float>(0.5 * *middle);
        if (reach > diagonal) break;
    }
    return 0.0f;
}

float default_hair_radius(const CurveSet& set) {
    const Vec3d size = bound_points(set).size();
    return static_cast<float>(std::max({size.x, size.y, size.z}) / 4000.0);
}

} // namespace heddle
