#include "tables.h"

#include <heddle/voxelize/test_tube.h>

#include <cstdio>

namespace heddle::bench {
namespace {

using namespace heddle::test;

constexpr double kRadii[] = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}; ///< subvoxels

void print_row(const char* name, const CurveSet& set, double radius) {
    std::printf("| %s |", name);
    for (const double subvoxels : kRadii) {
        std::printf(" %+.2f |", 100.0 * volume_error(set, radius, subvoxels, 4e5));
        std::fflush(stdout);
    }
    std::printf("\n");
}

CurveSet knitted(GenerateKind kind, double& radius) {
    GenerateOptions options;
    options.kind = kind;
    options.nx = 6;
    options.ny = 6;
    const Geometry geometry = generate(options);
    radius = static_cast<double>(geometry.curves[0].default_radius);
    return geometry.curves[0];
}

} // namespace

void print_volumes() {
    std::printf(
        "## Volume of solid yarns\n\n"
        "Occupied volume against section x arc length, %% too much, by the yarn's radius in\n"
        "subvoxels. Helices: radius 4.2, pitch 5 yarn radii; circles: radius 4.2. Stockinette\n"
        "and plain weave: 6 x 6 of `heddle generate`. Copies turned and moved at random until "
        "they\n"
        "fill 400,000 subvoxels (the figures' own scatter is about 0.3 at the thinnest). Goal: 1 %%.\n"
        "The row of plain weave is of half a cloth: the warp yarns alone, which the benchmark takes.\n\n"
        "| yarns |");
    for (const double r : kRadii) std::printf(" %g |", r);
    std::printf("\n|---|");
    for (std::size_t i = 0; i < std::size(kRadii); ++i) std::printf("---|");
    std::printf("\n");
    print_row("straight", line(), 1.0);
    print_row("helices, Catmull-Rom, 12 points a turn", helix(12, Basis::CatmullRom), 1.2);
    print_row("helices, B-spline, 12 points a turn", helix(12, Basis::CubicBSpline), 1.2);
    print_row("helices, linear, 48 points a turn", helix(48, Basis::Linear), 1.2);
    print_row("closed circles, Catmull-Rom", circle(12, Basis::CatmullRom), 1.2);
    double radius = 0.0;
    CurveSet knit = knitted(GenerateKind::Knit, radius);
    print_row("stockinette", knit, radius);
    CurveSet weave = knitted(GenerateKind::Plain, radius);
    print_row("plain weave", weave, radius);
    std::printf("\n");
}

} // namespace heddle::bench
