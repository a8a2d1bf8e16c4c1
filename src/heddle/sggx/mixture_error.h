#pragma once

#include <heddle/base/vec.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/sample.h>
#include <heddle/sggx/sggx.h>
#include <heddle/sggx/sphere_cells.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

// The error of a mixture of SGGX against the directions that it represents. Host only.

/// One SGGX of a mixture with its weight, > 0 in any unit.
struct MixtureLobe {
    SggxMatrix S;
    double weight = 1.0;
};

inline constexpr int kAreaDirections = 500; ///< projected areas are compared along these

/// Number of points by which the cells of a narrow lobe are integrated, by default.
inline constexpr int kLobePoints = 8192;

namespace detail {

/// `count` directions of one hemisphere, each for the same solid angle (spherical Fibonacci).
[[nodiscard]] inline std::vector<Vec3d> fibonacci_hemisphere(int count) {
    std::vector<Vec3d> d;
    for (int i = 0; i < count; ++i) {
        const double z = (i + 0.5) / count;
        const double r = std::sqrt(1.0 - z * z);
        const double phi = 2.399963229728653 * i; // golden angle
        d.push_back({r * std::cos(phi), r * std::sin(phi), z});
    }
    return d;
}

/// Evaluates the quadratic form w^T S w for many w at once; each of their six products is a row.
class QuadraticForms {
public:
    explicit QuadraticForms(const std::vector<Vec3d>& directions) {
        for (const Vec3d& w : directions) {
            const double p[6] = {w.x * w.x,       w.y * w.y,       w.z * w.z,
                                 2.0 * w.x * w.y, 2.0 * w.x * w.z, 2.0 * w.y * w.z};
            for (std::size_t k = 0; k < 6; ++k) row_[k].push_back(static_cast<float>(p[k]));
        }
    }
    [[nodiscard]] std::size_t size() const { return row_[0].size(); }
    [[nodiscard]] float operator()(const SymmetricMatrix& S, std::size_t i) const {
        return S.xx * row_[0][i] + S.yy * row_[1][i] + S.zz * row_[2][i] +
               (S.xy * row_[3][i] + S.xz * row_[4][i] + S.yz * row_[5][i]);
    }

private:
    std::vector<float> row_[6];
};

[[nodiscard]] inline const QuadraticForms& area_directions() {
    static const QuadraticForms forms{fibonacci_hemisphere(kAreaDirections)};
    return forms;
}

/// The centres of 64 parts of each cell; only one of each pair of opposite centres is stored.
struct CellParts {
    QuadraticForms form;
    std::vector<CellPair> cells;
};

[[nodiscard]] inline const CellParts& cell_parts() {
    static const CellParts parts = [] {
        std::vector<Vec3d> north;
        for (const Vec3d& d : sphere_cell_centers(8 * kSphereCellSide)) {
            if (d.z > 1e-9 || (d.z > -1e-9 && d.y > 0.0)) north.push_back(d);
        }
        CellParts made{QuadraticForms{north}, {}};
        for (const Vec3d& d : north) made.cells.push_back(sphere_cells_of(d));
        return made;
    }();
    return parts;
}

/// Adds a lobe that is wider than the parts of a cell: evaluates its density at their centres.
inline void add_wide_lobe(const SggxMatrix& S, double weight, double* cell) {
    const CellParts& parts = cell_parts();
    const SymmetricMatrix adjugate{S.yy * S.zz - S.yz * S.yz, S.xx * S.zz - S.xz * S.xz,
                                   S.xx * S.yy - S.xy * S.xy, S.xz * S.yz - S.xy * S.zz,
                                   S.xy * S.yz - S.xz * S.yy, S.xy * S.xz - S.yz * S.xx};
    thread_local std::vector<float> density;
    density.resize(parts.form.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < density.size(); ++i) {
        const float q = parts.form(adjugate, i);
        density[i] = 1.0f / (q * q);
    }
    for (const float d : density) sum += static_cast<double>(d);
    const double scale = 0.5 * weight / sum;
    for (std::size_t i = 0; i < density.size(); ++i) {
        const double share = scale * static_cast<double>(density[i]);
        cell[parts.cells[i].cell] += share;
        cell[parts.cells[i].opposite] += share;
    }
}

/// Adds a lobe by the normals A u of its ellipsoid, each weighted by its area |A u|: a narrow lobe
/// gets as many points as a wide one.
inline void add_narrow_lobe(const SggxMatrix& S, double weight, int points, double* cell) {
    thread_local std::vector<Vec3d> u;
    thread_local std::vector<std::pair<CellPair, double>> hit;
    if (u.size() != static_cast<std::size_t>(points)) u = fibonacci_hemisphere(points);
    const SymmetricEigen e = decompose(S);
    Vec3d column[3]; // S^(1/2), the pole of u on the long axis
    for (int i = 0; i < 3; ++i) column[i] = e.axis[i] * std::sqrt(std::max(0.0, e.value[i]));
    hit.clear();
    double sum = 0.0;
    for (const Vec3d& p : u) {
        const Vec3d w = column[0] * p.z + column[1] * p.x + column[2] * p.y;
        const double area = length(w);
        if (!(area > 0.0)) continue;
        hit.emplace_back(sphere_cells_of(w), area);
        sum += area;
    }
    for (const auto& [cells, area] : hit) {
        cell[cells.cell] += 0.5 * weight * area / sum;
        cell[cells.opposite] += 0.5 * weight * area / sum;
    }
}

} // namespace detail

/// The reference for a mixture: directions, or lobes, or both, added one by one.
struct DirectionTruth {
    std::array<double, kAreaDirections> sigma{}; ///< sum of weight x |w . d|
    std::array<double, kSphereCells> cell{};     ///< sum of weights, half of each at -d
    std::array<double, 6> moment{};              ///< sum of weight x d d^T: xx yy zz xy xz yz
    double weight = 0.0;

    /// @param d  unit
    void add(Vec3d d, double w) {
        const SymmetricMatrix dd{static_cast<float>(d.x * d.x), static_cast<float>(d.y * d.y),
                                 static_cast<float>(d.z * d.z), static_cast<float>(d.x * d.y),
                                 static_cast<float>(d.x * d.z), static_cast<float>(d.y * d.z)};
        add_areas(dd, w);
        add_moment(dd, w);
        const CellPair cells = sphere_cells_of(d);
        cell[cells.cell] += 0.5 * w;
        cell[cells.opposite] += 0.5 * w;
        weight += w;
    }

    /// Adds all directions of a lobe.
    ///
    /// Areas and moment have closed forms. The cells, which sum to the weight, come from the
    /// density at the centres of 64 parts of each cell if the lobe is wide enough, else from
    /// `points` of its directions. Both are within 0.007 of the true shares in L1 at kLobePoints.
    /// @param lobe    S positive definite
    /// @param points  >= 1; if fewer than kLobePoints, all lobes use points: for sums of many lobes
    void add(const MixtureLobe& lobe, int points = kLobePoints) {
        add_areas(lobe.S, lobe.weight);
        add_moment(second_moment_of(lobe.S), lobe.weight);
        const SymmetricEigen e = decompose(lobe.S);
        // ratio of sigmas below which the parts err more (0.007 in L1) than 8,192 points do
        constexpr double kWide = 0.05 * 0.05;
        if (points >= kLobePoints && e.value[2] > kWide * e.value[0]) {
            detail::add_wide_lobe(lobe.S, lobe.weight, cell.data());
        } else {
            detail::add_narrow_lobe(lobe.S, lobe.weight, points, cell.data());
        }
        weight += lobe.weight;
    }

private:
    void add_areas(const SymmetricMatrix& S, double w) {
        const detail::QuadraticForms& forms = detail::area_directions();
        for (std::size_t i = 0; i < sigma.size(); ++i) {
            const float q = forms(S, i);
            sigma[i] += w * static_cast<double>(std::sqrt(q > 0.0f ? q : 0.0f));
        }
    }
    void add_moment(const SymmetricMatrix& M, double w) {
        const float entry[6] = {M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
        for (std::size_t k = 0; k < 6; ++k) moment[k] += w * static_cast<double>(entry[k]);
    }
};

/// The difference of two distributions, each scaled to weight 1.
struct DirectionError {
    double sigma = 0.0;  ///< mean over kAreaDirections of |difference of projected area|, in [0, 1]
    double cells = 0.0;  ///< L1 distance over kSphereCells, in [0, 2]
    double moment = 0.0; ///< largest difference of an entry of the second moment
};

/// @param a, b  with a weight > 0
[[nodiscard]] inline DirectionError direction_error(const DirectionTruth& a,
                                                    const DirectionTruth& b) {
    DirectionError error;
    const double p = 1.0 / a.weight;
    const double q = 1.0 / b.weight;
    for (std::size_t i = 0; i < a.sigma.size(); ++i) {
        error.sigma += std::fabs(a.sigma[i] * p - b.sigma[i] * q) / kAreaDirections;
    }
    for (std::size_t i = 0; i < a.cell.size(); ++i) {
        error.cells += std::fabs(a.cell[i] * p - b.cell[i] * q);
    }
    for (std::size_t k = 0; k < a.moment.size(); ++k) {
        error.moment = std::max(error.moment, std::fabs(a.moment[k] * p - b.moment[k] * q));
    }
    return error;
}

/// The error of a mixture against its reference.
///
/// Do not mix tangents and normals: measure the lobes of either kind separately.
/// @param lobes  at least one
[[nodiscard]] inline DirectionError mixture_error(std::span<const MixtureLobe> lobes,
                                                  const DirectionTruth& truth) {
    DirectionTruth own;
    for (const MixtureLobe& lobe : lobes) own.add(lobe);
    return direction_error(own, truth);
}

} // namespace heddle
