#pragma once

#include <heddle/base/random.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/agglomerate.h>
#include <heddle/sggx/direction_sums.h>
#include <heddle/sggx/moment_lobes.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/sample.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace heddle {

// The paper's reference method. Host only; the same bits on every machine.

inline constexpr int kHistogramBins = 5; ///< per axis of [-1, 1]^3                [Fabre26, 4.4]
inline constexpr int kHistogramSize = kHistogramBins * kHistogramBins * kHistogramBins;
inline constexpr int kLobeSamples = 5000; ///< per lobe            [Fabre26, 4.4]
using DirectionHistogram = std::array<float, kHistogramSize>; ///< shares of samples; x runs fastest

namespace detail {

/// The bins of the histogram, in the order of the projections of their centres on one line.
struct HistogramSlice {
    std::array<std::uint8_t, kHistogramSize> bin{};
    std::array<float, kHistogramSize> step{}; ///< from this bin's projection to the next bin's
};

[[nodiscard]] inline HistogramSlice slice_along(Vec3d axis) {
    constexpr int n = kHistogramBins;
    std::array<double, kHistogramSize> along{};
    for (int i = 0; i < kHistogramSize; ++i) {
        const Vec3d steps{static_cast<double>(i % n), static_cast<double>(i / n % n),
                          static_cast<double>(i / (n * n))};
        along[static_cast<std::size_t>(i)] = dot(axis, steps) * (2.0 / n);
    }
    HistogramSlice slice;
    std::iota(slice.bin.begin(), slice.bin.end(), std::uint8_t{0});
    std::stable_sort(slice.bin.begin(), slice.bin.end(),
                     [&](std::uint8_t a, std::uint8_t b) { return along[a] < along[b]; });
    for (std::size_t i = 0; i + 1 < slice.bin.size(); ++i) {
        slice.step[i] = static_cast<float>(along[slice.bin[i + 1]] - along[slice.bin[i]]);
    }
    return slice;
}

/// The symmetry axes of the cube: 3 along edges, 6 along face diagonals, 4 along body diagonals.
[[nodiscard]] inline const std::array<HistogramSlice, 13>& histogram_slices() {
    static const std::array<HistogramSlice, 13> slices = [] {
        std::array<HistogramSlice, 13> made;
        for (std::size_t i = 0; i < made.size(); ++i) {
            const int code = static_cast<int>(i) + 14; // (x, y, z) in -1 .. 1: one per pair
            made[i] =
                slice_along(normalize(Vec3d{code % 3 - 1.0, code / 3 % 3 - 1.0, code / 9 - 1.0}));
        }
        return made;
    }();
    return slices;
}

} // namespace detail

/// The share of `directions` in each of 5 x 5 x 5 bins over [-1, 1]^3.               [Fabre26, 4.4]
/// @param directions  unit; at least one
[[nodiscard]] inline DirectionHistogram direction_histogram(std::span<const Vec3f> directions) {
    constexpr int n = kHistogramBins;
    const auto bin = [](float x) {
        return std::clamp(static_cast<int>((x + 1.0f) * (0.5f * n)), 0, n - 1);
    };
    DirectionHistogram histogram{};
    for (const Vec3f& d : directions) {
        histogram[static_cast<std::size_t>((bin(d.z) * n + bin(d.y)) * n + bin(d.x))] += 1.0f;
    }
    for (float& share : histogram) share /= static_cast<float>(directions.size());
    return histogram;
}

/// Sliced Wasserstein-1 distance of two histograms.
///
/// The paper says "Wasserstein distance" and no more. This is the mean of the one-dimensional
/// distance over 13 lines, the symmetry axes of the cube: the integral of |difference of cumulated
/// shares|, with the centres of the bins projected on the line. It compares positions in space,
/// independent of the order of bins.
/// @return  >= 0, 0 for equal histograms; 0.22 for mass that moves by one bin along an axis
[[nodiscard]] inline float sliced_wasserstein(const DirectionHistogram& a,
                                              const DirectionHistogram& b) {
    float sum = 0.0f;
    for (const detail::HistogramSlice& slice : detail::histogram_slices()) {
        float ahead = 0.0f;
        for (std::size_t i = 0; i < slice.bin.size(); ++i) {
            ahead += a[slice.bin[i]] - b[slice.bin[i]];
            sum += std::fabs(ahead) * slice.step[i];
        }
    }
    return sum / static_cast<float>(detail::histogram_slices().size());
}

/// Lobes for agglomerate() by the method `wasserstein`.                         [Fabre26, 4.4]
///
/// Each lobe is 5,000 samples of its SGGX; the distance is sliced_wasserstein of their histograms
/// and, as in the paper, ignores weights. A merged lobe takes samples of both in proportion to
/// their weights, 5,000 together; it is fitted to their second moment and sampled anew.
class WassersteinLobes {
public:
    /// @param lobes  weights > 0; merged in place
    /// @param seed   seed of all samples: the same seed gives the same bits
    WassersteinLobes(std::span<DirectionSums> lobes, std::uint64_t seed)
        : lobes_(lobes), seed_(seed), drawn_(lobes.size()) {
        for (std::size_t i = 0; i < lobes.size(); ++i) drawn_[i] = draw(lobes[i]);
    }
    [[nodiscard]] float distance(int i, int j) const {
        const DirectionSums& a = lobes_[static_cast<std::size_t>(i)];
        const DirectionSums& b = lobes_[static_cast<std::size_t>(j)];
        const Drawn& p = drawn_[static_cast<std::size_t>(i)];
        const Drawn& q = drawn_[static_cast<std::size_t>(j)];
        if (a.material == b.material) return sliced_wasserstein(p.histogram, q.histogram);
        if (a.normals == b.normals) {
            return detail::keep_apart(sliced_wasserstein(p.histogram, q.histogram));
        }
        return detail::keep_apart(
            leads(a, b) ? sliced_wasserstein(p.histogram, draw(turned_across(b)).histogram)
                        : sliced_wasserstein(draw(turned_across(a)).histogram, q.histogram));
    }
    void merge(int into, int from) {
        DirectionSums& a = lobes_[static_cast<std::size_t>(into)];
        const DirectionSums& b = lobes_[static_cast<std::size_t>(from)];
        const bool first = leads(a, b);
        const DirectionSums& light = first ? b : a;
        Drawn joined = drawn_[static_cast<std::size_t>(first ? into : from)];
        const Drawn other = a.normals == b.normals
                                ? drawn_[static_cast<std::size_t>(first ? from : into)]
                                : draw(turned_across(light));
        const double share =
            static_cast<double>(light.weight) / static_cast<double>(a.weight + b.weight);
        std::copy_n(other.samples.begin(), static_cast<int>(share * kLobeSamples + 0.5),
                    joined.samples.begin());
        a = merged(a, b);
        set_moment(a, joined.samples);
        drawn_[static_cast<std::size_t>(into)] = draw(a);
    }

private:
    struct Drawn {
        std::vector<Vec3f> samples;
        DirectionHistogram histogram{};
    };
    /// Samples the SGGX that is fitted to `sums`, with a random stream for each set of sums, so
    /// that the order of calls does not matter.
    [[nodiscard]] Drawn draw(const DirectionSums& sums) const {
        std::uint64_t id = static_cast<std::uint64_t>(sums.weight);
        for (const std::int64_t m : sums.moment) id = hash64(id, static_cast<std::uint64_t>(m));
        CounterRandom random{seed_, id};
        const SggxFactor A = factor(fit_sggx(detail::mean_moment(sums)));
        Drawn drawn;
        drawn.samples.resize(kLobeSamples);
        for (Vec3f& d : drawn.samples) d = sample_ndf(A, random);
        drawn.histogram = direction_histogram(drawn.samples);
        return drawn;
    }
    static void set_moment(DirectionSums& sums, std::span<const Vec3f> samples) {
        double sum[6]{};
        for (const Vec3f& sample : samples) {
            const Vec3d d = to_double(sample);
            const double product[6] = {d.x * d.x, d.y * d.y, d.z * d.z,
                                       d.x * d.y, d.x * d.z, d.y * d.z};
            for (int k = 0; k < 6; ++k) sum[k] += product[k];
        }
        const double scale = static_cast<double>(sums.weight) / kLobeSamples;
        for (int k = 0; k < 6; ++k) sums.moment[k] = static_cast<std::int64_t>(sum[k] * scale);
    }

    std::span<DirectionSums> lobes_;
    std::uint64_t seed_;
    std::vector<Drawn> drawn_;
};

} // namespace heddle
