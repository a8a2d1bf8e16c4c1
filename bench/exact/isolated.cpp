#include "tables.h"

#include <heddle/voxelize/test_isolated.h>

#include <cstdio>

namespace heddle::bench {
namespace {

using namespace heddle::test;

constexpr double kDiameters[] = {0.05, 0.1, 0.3, 1.0, 2.0, 4.0, 16.0};

void print_row(const char* name, const IsolatedResult& r) {
    std::printf("| %s |", name);
    for (const CoverageTally& t : r.axis) {
        std::printf(" %+.2f ± %.2f %% |", 100.0 * t.error(), 100.0 * t.deviation());
    }
    for (int bin = 0; bin < kAngleBins; ++bin) {
        CoverageTally all;
        for (int a = 0; a < 3; ++a) {
            all.add(r.angle[static_cast<std::size_t>(a)][static_cast<std::size_t>(bin)]);
        }
        std::printf(" %+.2f ± %.2f |", 100.0 * all.error(), 100.0 * all.deviation());
    }
    std::printf("\n");
}

} // namespace

void print_isolated_fibers() {
    std::printf(
        "## Isolated fibers\n\n"
        "2,000 random straight fibers of 152 voxels for each diameter: the sum over voxels of\n"
        "coverage x face area against the sum of the exact silhouettes of fiber cut by voxel, in %%\n"
        "of the latter, with its standard error from fiber to fiber. Then the same by the angle\n"
        "between fiber and axis, all axes together. Goal: 1 %% on every axis; from diameter 0.3 up\n"
        "5 %% in every 15 degrees.\n\n"
        "| diameter, subvoxels | x | y | z | 0-15 | 15-30 | 30-45 | 45-60 | 60-75 | 75-90 |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n");
    const auto row = [](const char* what, IsolatedOptions options) {
        char name[64];
        std::snprintf(name, sizeof name, "%g%s", options.diameter, what);
        print_row(name, IsolatedFibers(options).measure());
        std::fflush(stdout);
    };
    for (const double d : kDiameters) row("", {.diameter = d});
    for (const double d : {0.3, 4.0}) {
        row(", voxels 1 x 1 x 0.25", {.diameter = d, .voxel_size = {1.0, 1.0, 0.25}, .seed = 2});
    }
    for (const double d : kDiameters) {
        row(", mask", {.diameter = d, .coverage = CoverageMode::Mask});
    }
    std::printf("\n");
}

} // namespace heddle::bench
