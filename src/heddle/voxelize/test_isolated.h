#pragma once

#include <heddle/base/random.h>
#include <heddle/voxelize/test_cylinder.h>
#include <heddle/voxelize/test_voxelize.h>

#include <array>
#include <cmath>

// Coverage of single fibers against their exact projections.

namespace heddle::test {

inline constexpr int kAngleBins = 6; ///< of 15 degrees between fiber and axis

/// Sums over fibers of coverage x face area, measured and exact, in scene units^2.
struct CoverageTally {
    double found = 0.0;
    double exact = 0.0;
    double found2 = 0.0, both = 0.0, exact2 = 0.0; ///< their products, fiber by fiber
    int fibers = 0;

    void add(double f, double e) {
        found += f;
        exact += e;
        found2 += f * f;
        both += f * e;
        exact2 += e * e;
        ++fibers;
    }
    void add(const CoverageTally& t) {
        found += t.found;
        exact += t.exact;
        found2 += t.found2;
        both += t.both;
        exact2 += t.exact2;
        fibers += t.fibers;
    }
    [[nodiscard]] double error() const { return found / exact - 1.0; }
    /// Standard error of `error`.
    [[nodiscard]] double deviation() const {
        const double r = found / exact; // a ratio's: from the scatter about found = r exact
        return std::sqrt(std::max(0.0, found2 - 2.0 * r * both + r * r * exact2)) / exact;
    }
};

struct IsolatedResult {
    std::array<CoverageTally, 3> axis;
    std::array<std::array<CoverageTally, kAngleBins>, 3> angle; ///< by axis, by angle to it
};

/// What to measure: `count` random fibers of one diameter.
struct IsolatedOptions {
    double diameter = 1.0; ///< smallest subvoxel edges
    int count = 2000;
    double length = 152.0; ///< largest voxel edges
    Vec3d voxel_size{1.0, 1.0, 1.0};
    std::uint64_t seed = 1;
    CoverageMode coverage = CoverageMode::Columns;
};

inline Vec3d random_unit(CounterRandom& random) {
    const double z = 2.0 * static_cast<double>(random.uniform()) - 1.0;
    const double phi = 2.0 * kPi * static_cast<double>(random.uniform());
    const double s = std::sqrt(1.0 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}

/// Fibers in the cells of a cubic arrangement, so far apart that no voxel touches two.
class IsolatedFibers {
public:
    explicit IsolatedFibers(const IsolatedOptions& options) : options_(options) {
        const Vec3d h = options.voxel_size;
        const double longest = std::max({h.x, h.y, h.z});
        const double radius = 0.5 * options.diameter * std::min({h.x, h.y, h.z}) / 8.0;
        side_ = static_cast<int>(std::ceil(std::cbrt(options.count)));
        for (int a = 0; a < 3; ++a) {
            cell_[a] =
                static_cast<int>(std::ceil((options.length * longest + 2.0 * radius) / h[a]) + 4.0);
        }
        CurveSet set;
        set.basis = Basis::Linear;
        set.default_radius = static_cast<float>(radius);
        CounterRandom random{options.seed, 1};
        for (int f = 0; f < options.count; ++f) {
            const Vec3d half = random_unit(random) * (0.5 * options.length * longest);
            Vec3d middle;
            for (int a = 0; a < 3; ++a) {
                const double jitter = static_cast<double>(random.uniform());
                middle[a] = (cell_index(f, a) * cell_[a] + cell_[a] / 2 + jitter) * h[a];
            }
            add_curve(set, {to_float(middle - half), to_float(middle + half)});
            // rounded to float, as in the geometry
            fibers_.push_back({to_double(set.points[set.points.size() - 2]),
                               to_double(set.points.back()),
                               static_cast<double>(set.default_radius)});
        }
        geometry_ = geometry_of(std::move(set));
    }

    [[nodiscard]] IsolatedResult measure() const {
        const std::vector<Vec3d> found = measure_found();
        const Vec3d h = options_.voxel_size;
        IsolatedResult result;
        for (std::size_t f = 0; f < fibers_.size(); ++f) {
            const Vec3d d = normalize(fibers_[f].to - fibers_[f].from);
            for (int a = 0; a < 3; ++a) {
                const double exact = sum_of_silhouettes(fibers_[f], a, h[a]);
                const double degrees = std::acos(std::min(1.0, std::fabs(d[a]))) * (180.0 / kPi);
                const int bin = std::min(kAngleBins - 1, static_cast<int>(degrees / 15.0));
                const auto i = static_cast<std::size_t>(a);
                result.axis[i].add(found[f][a], exact);
                result.angle[i][static_cast<std::size_t>(bin)].add(found[f][a], exact);
            }
        }
        return result;
    }

private:
    /// Cells lie about the origin, so that half of the indices are negative.
    [[nodiscard]] int cell_index(int fiber, int axis) const {
        const int i = axis == 0   ? fiber % side_
                      : axis == 1 ? fiber / side_ % side_
                                  : fiber / side_ / side_;
        return i - side_ / 2;
    }

    /// Coverage x face area, per fiber and axis.
    [[nodiscard]] std::vector<Vec3d> measure_found() const {
        VoxelizeOptions options;
        options.voxel_size = options_.voxel_size;
        options.coverage = options_.coverage;
        const Vec3d h = options_.voxel_size;
        std::vector<Vec3d> found(fibers_.size());
        for_each_voxel(*voxelize_now(geometry_, options), [&](const BlockVoxel& v) {
            int cell[3];
            for (int a = 0; a < 3; ++a) {
                cell[a] = static_cast<int>(std::floor(static_cast<double>(v.at[a]) / cell_[a])) +
                          side_ / 2;
            }
            const int f = (cell[2] * side_ + cell[1]) * side_ + cell[0];
            for (int a = 0; a < 3; ++a) {
                const double face = h.x * h.y * h.z / h[a];
                found.at(static_cast<std::size_t>(f))[a] += covered(v.coverage(), a) * face;
            }
        });
        return found;
    }

    IsolatedOptions options_;
    int side_ = 0;
    Vec3i cell_; ///< voxels
    Geometry geometry_;
    std::vector<ExactCylinder> fibers_;
};

} // namespace heddle::test
