#pragma once

// Integrals over the sphere, a chi-squared test and scatterers for this room's tests.

#include <heddle/base/random.h>
#include <heddle/scatter/scatterer.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heddle::test {

inline constexpr double kPi = 3.141592653589793;
inline constexpr int kRows = 24;    ///< bins in the angle to the axis
inline constexpr int kColumns = 48; ///< bins around it

/// A unit direction, given by its z and its azimuth in turns.
inline Vec3f direction(double z, double turns) {
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return to_float({r * std::cos(2.0 * kPi * turns), r * std::sin(2.0 * kPi * turns), z});
}

inline Vec3f random_direction(CounterRandom& random) {
    const double z = 2.0 * static_cast<double>(random.uniform()) - 1.0;
    return direction(z, static_cast<double>(random.uniform()));
}

inline Vec3f random_point(CounterRandom& random) {
    const float x = random.uniform();
    const float y = random.uniform();
    return {x, y, random.uniform()};
}

/// The axes of a scatterer in a rotated frame, so that no test is along the world's axes.
struct Askew {
    Vec3f x, y, z;
    Askew() : z(normalize(Vec3f{0.3f, -0.5f, 0.7f})) {
        x = normalize(any_perpendicular(z) + cross(z, any_perpendicular(z)) * 0.4f);
        y = cross(z, x);
    }
    [[nodiscard]] Vec3f world(Vec3f w) const { return normalize(x * w.x + y * w.y + z * w.z); }
};

inline Scatterer askew(const ScatterMaterial& material) {
    const Askew frame;
    Scatterer at;
    at.material = material;
    at.axis = frame.z;
    at.tangent = frame.x;
    return at;
}

/// Calls f(direction, steradians, row, column) for the middle of every cell of a grid that is even
/// in both angles, so that lobes near the axis are resolved.
template <typename F>
void for_each_cell(int rows, const F& f) {
    const Askew frame;
    const int columns = 2 * rows;
    for (int i = 0; i < rows; ++i) {
        const double below = std::cos(kPi * (i + 1) / rows);
        const double area = (std::cos(kPi * i / rows) - below) * 2.0 * kPi / columns;
        for (int j = 0; j < columns; ++j) {
            const double z = std::cos(kPi * (i + .5) / rows);
            f(frame.world(direction(z, (j + .5) / columns)), area, i, j);
        }
    }
}

struct Integral {
    double energy[3]{};
    double pdf = 0.0;
};

/// Integrates evaluate and pdf over wo.
inline Integral integrate(const Scatterer& at, Vec3f wi, int rows = 256) {
    Integral sum;
    for_each_cell(rows, [&](Vec3f wo, double area, int, int) {
        const ScatterValue v = evaluate_with_pdf(at, wi, wo);
        for (int c = 0; c < 3; ++c) sum.energy[c] += area * static_cast<double>(v.value[c]);
        sum.pdf += area * static_cast<double>(v.pdf);
    });
    return sum;
}

/// The mean weight of samples: the energy again, for lobes that no grid resolves.
inline Vec3d mean_weight(const Scatterer& at, Vec3f wi, int samples = 40000) {
    CounterRandom random{7, 1};
    Vec3d sum{};
    for (int i = 0; i < samples; ++i) {
        sum = sum + to_double(sample(at, wi, random_point(random)).weight);
    }
    return sum * (1.0 / samples);
}

inline std::size_t bin_of(Vec3f w) {
    const Askew frame;
    const auto x = static_cast<double>(dot(w, frame.x));
    const auto y = static_cast<double>(dot(w, frame.y));
    const auto z = static_cast<double>(dot(w, frame.z));
    const double theta = std::acos(std::clamp(z, -1.0, 1.0));
    const int row = std::min(kRows - 1, static_cast<int>(theta / kPi * kRows));
    double turn = std::atan2(y, x) / (2.0 * kPi);
    turn -= std::floor(turn);
    const int column = std::min(kColumns - 1, static_cast<int>(turn * kColumns));
    return static_cast<std::size_t>(row * kColumns + column);
}

/// Chi-squared of samples against pdf, in standard deviations above its mean (Wilson and Hilferty).
/// Absorbed samples have a bin of their own, which expects 1 minus the integral of pdf.
inline double chi_squared_z(const Scatterer& at, Vec3f wi, int samples = 100000, int fine = 10) {
    std::vector<double> expected(kRows * kColumns + 1);
    std::vector<double> observed(kRows * kColumns + 1);
    double all = 0.0;
    for_each_cell(kRows * fine, [&](Vec3f wo, double area, int i, int j) {
        const double e = area * static_cast<double>(pdf(at, wi, wo));
        expected[static_cast<std::size_t>(i / fine * kColumns + j / fine)] += e * samples;
        all += e;
    });
    expected.back() = std::max(0.0, 1.0 - all) * samples;
    CounterRandom random{7, 2};
    for (int i = 0; i < samples; ++i) {
        const ScatterSample s = sample(at, wi, random_point(random));
        observed[s.pdf > 0.0f ? bin_of(s.direction) : kRows * kColumns] += 1.0;
    }
    double chi = 0.0;
    int degrees = -1;
    double pooled[2]{};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] >= 8.0) {
            chi += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
            ++degrees;
        } else {
            pooled[0] += observed[i];
            pooled[1] += expected[i];
        }
    }
    if (pooled[1] >= 8.0) {
        chi += (pooled[0] - pooled[1]) * (pooled[0] - pooled[1]) / pooled[1];
        ++degrees;
    }
    const double k = 2.0 / (9.0 * degrees);
    return (std::cbrt(chi / degrees) - (1.0 - k)) / std::sqrt(k);
}

/// A correct sampler exceeds this once in 30,000 times.
inline constexpr double kUnlikely = 4.0;

} // namespace heddle::test
