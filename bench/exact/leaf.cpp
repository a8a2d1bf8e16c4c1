#include "tables.h"

#include <heddle/voxelize/test_leaf.h>

#include <algorithm>
#include <cstdio>

namespace heddle::bench {
namespace {

using namespace heddle::test;

constexpr int kTurns = 100;  ///< random orientations per set
constexpr int kViews = 1000; ///< directions of the projected area

/// The error of the projected area over all views.
struct AreaError {
    double absolute = 0.0, worst = 0.0;
    int count = 0;
    void add(double found, double exact) {
        absolute += std::fabs(found - exact);
        worst = std::max(worst, std::fabs(found - exact));
        ++count;
    }
    [[nodiscard]] double mean() const { return absolute / count; }
};

/// sigma_i = mean |w_i . d| along the eigenvectors                          [Fabre26, eq. 15-16]
SggxMatrix fit_by_projection(const std::vector<Vec3d>& directions) {
    SymmetricEigen e = decompose(pool(directions));
    for (int i = 0; i < 3; ++i) {
        const double sigma = mean_cosine(directions, e.axis[i]);
        e.value[i] = sigma * sigma;
    }
    return compose(e);
}

struct LeafErrors {
    double moment = 0.0, packed_moment = 0.0; ///< of the worst entry
    AreaError fit, packed, projection;
    int definite = 0;

    void add(const std::vector<Vec3d>& directions, const Lobe& lobe) {
        const SymmetricMatrix pooled = pool(directions);
        const SggxMatrix S = fit_sggx(pooled);
        const SggxMatrix stored = unpack(lobe.sggx);
        const SggxMatrix other = fit_by_projection(directions);
        moment = std::max(moment, difference(second_moment_of(S), pooled));
        packed_moment = std::max(packed_moment, difference(second_moment_of(stored), pooled));
        definite += decompose(stored).value[2] > 0.0 ? 1 : 0;
        for (const Vec3d& w : sphere(kViews)) {
            const double exact = mean_cosine(directions, w);
            const auto area = [&](const SggxMatrix& of) {
                return static_cast<double>(projected_area(of, to_float(w)));
            };
            fit.add(area(S), exact);
            packed.add(area(stored), exact);
            projection.add(area(other), exact);
        }
    }
};

} // namespace

void print_leaf_fits() {
    std::printf(
        "## Leaf SGGX\n\n"
        "One voxel of fibers in known directions, each set in %d random orientations. M: largest\n"
        "difference of an entry of the lobe's own second moment M(S) from the pooled one; goal:\n"
        "1e-4 before packing. Area: projected area over %d directions against the mean of |w . d|\n"
        "over the fibers, mean / worst. No SGGX can follow the corners of few directions: beside it\n"
        "stands the fit sigma_i = mean |w_i . d| of [Fabre26, eq. 15-16]. Stored: decoded from "
        "the\n"
        "voxel's 6 bytes. What packing adds by width of the lobe: sggx_packing.md.\n\n"
        "| directions | M, fit | M, stored | area, fit | area, stored | area, sigma_i = mean | stored lobes definite |\n|---|---|---|---|---|---|---|\n",
        kTurns, kViews);
    CounterRandom random{9, 4};
    for (const DirectionSet& set : direction_sets()) {
        std::vector<std::vector<Vec3d>> voxels;
        for (int i = 0; i < kTurns; ++i) voxels.push_back(turned(set.directions, random));
        const std::vector<Lobe> lobes = voxelize_directions(voxels);
        LeafErrors e;
        for (std::size_t i = 0; i < lobes.size(); ++i) e.add(voxels[i], lobes[i]);
        std::printf("| %s | %.1e | %.1e | %.4f / %.4f | %.4f / %.4f | %.4f / %.4f | %d of %d |\n",
                    set.name, e.moment, e.packed_moment, e.fit.mean(), e.fit.worst, e.packed.mean(),
                    e.packed.worst, e.projection.mean(), e.projection.worst, e.definite, kTurns);
    }
    std::printf("\n");
}

} // namespace heddle::bench
