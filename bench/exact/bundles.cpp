#include "tables.h"

#include <heddle/voxelize/test_bundle.h>
#include <heddle/voxelize/test_tube.h>

#include <cstdio>

namespace heddle::bench {
namespace {

using namespace heddle::test;

constexpr int kBundles = 12; ///< per row, each with its own direction

/// One solid yarn along two turns of a helix, 12 points per turn: radius 4.2, pitch 5 yarn radii.
Bundle bent_yarn(const BundleOptions& o) {
    CurveSet curve;
    const double radius = o.radius / 8.0;
    add_curve(curve, helix_points(-1, 25, 12.0, 6.0));
    for (Vec3f& p : curve.points) p = p * static_cast<float>(radius / 1.2);
    CurveSet set = scattered(curve, 1, o.seed);
    Bundle bundle;
    for (std::size_t k = 0; k < set.span_count(0); ++k) {
        for (int i = 0; i < 64; ++i) {
            bundle.cylinders.push_back({point_on(set, 0, k, i / 64.0),
                                        point_on(set, 0, k, (i + 1) / 64.0),
                                        static_cast<double>(static_cast<float>(radius))});
        }
    }
    bundle.geometry = solid_yarns(std::move(set), radius);
    return bundle;
}

void print_row(const char* kind, Bundle (*make)(const BundleOptions&), BundleOptions options) {
    BundleError columns;
    BundleError mask;
    for (int i = 0; i < kBundles; ++i) {
        options.seed = static_cast<std::uint64_t>(100 + i);
        const Bundle bundle = make(options);
        const RayFaces rays = cast_rays(bundle);
        VoxelizeOptions voxels;
        voxels.voxel_size = {1.0, 1.0, 1.0};
        compare(*voxelize_now(bundle.geometry, voxels), rays, columns);
        voxels.coverage = CoverageMode::Mask;
        compare(*voxelize_now(bundle.geometry, voxels), rays, mask);
    }
    const double fiber = 2.0 * options.radius * std::sqrt(options.fill / options.fibers);
    std::printf("| %s | %g | %.2f | %.1f | %lld | %.3f | %+.4f | %.4f | %+.4f | %.4f |\n", kind,
                options.radius, fiber, options.fill, static_cast<long long>(columns.faces),
                columns.mean_coverage(), columns.bias(), columns.mean_absolute(), mask.bias(),
                mask.mean_absolute());
    std::fflush(stdout);
}

} // namespace

void print_bundles() {
    std::printf(
        "## Bundles\n\n"
        "Bundles of 150 fibers, 12 random directions a row, coverage of every occupied voxel and\n"
        "axis against 64 x 64 rays through the exact cylinders. Straight: straight fibers about a\n"
        "common axis, slope 0.15 at the surface, directions scattered by 0.03. Yarn: helices of a\n"
        "procedural yarn, expanded by the voxelizer. Bent: one solid yarn along a helix of radius\n"
        "4.2, pitch 5 yarn radii. Lengths in subvoxels. Goal: bias 0.005, mean absolute error\n"
        "0.025. Mask is `--coverage mask`.\n\n"
        "| bundle | radius | fiber diameter | fill | faces | mean coverage | bias | mean abs error "
        "| mask: bias | mask: mean abs error |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const double radius : {4.0, 10.0, 24.0}) {
        for (const double fill : {0.2, 0.4, 0.6}) {
            print_row("straight", straight_bundle, {.radius = radius, .fill = fill});
        }
    }
    for (const double radius : {4.0, 10.0, 24.0}) {
        for (const double fill : {0.2, 0.4, 0.6}) {
            print_row("yarn", yarn_bundle, {.radius = radius, .fill = fill, .slope = 0.35});
        }
    }
    for (const double radius : {0.25, 1.0, 4.0, 12.0}) {
        print_row("bent", bent_yarn, {.radius = radius, .fill = 1.0, .fibers = 1});
    }
    std::printf("\n");
}

} // namespace heddle::bench
