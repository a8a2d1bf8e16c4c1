// gl_speed [MILLIONS OF SLICES ...]: a table of OpenGL with this machine's driver: slices placed,
// sorted, drawn and voxelized. [LopezMoreno17, table 1]: 17.6 and 35.2 M slices on a TITAN Black
// take 8.67 and 17.32 s of set-up, 0.15 and 0.4 s per pass.
#include <heddle/geom/generate.h>
#include <heddle/raster/test_difference.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/viewer/slice/slice_renderer.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

namespace heddle {
namespace {

constexpr double kSlicesOfLoop = 72.0; ///< of the yarn below, approximately
constexpr std::int32_t kSize = 1024;   ///< size of pictures, pixels
constexpr int kFrames = 5;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Geometry knit(double millions) {
    const auto edge = static_cast<std::int64_t>(
        std::max(2.0, std::round(std::sqrt(millions * 1e6 / kSlicesOfLoop))));
    Geometry cloth = generate({.kind = GenerateKind::Knit, .nx = edge, .ny = edge});
    slice::test::set_yarn(cloth, slice::test::slice_yarn(0.1f, 60));
    return cloth;
}

/// Mean milliseconds of pictures from all around, without the first one, which has its shadow map.
struct Seen {
    std::int64_t slices = 0;
    bool split = false;
    double setup_s = 0.0;
    viewer::SliceTimes each;
    double shadow_s = 0.0;
};

Seen look_at(const Geometry& cloth, bool weighted) {
    const opengl::Context context;
    const auto start = std::chrono::steady_clock::now();
    viewer::SliceRenderer view(context, cloth, {});
    Seen out{view.slice_count(), view.is_split(), seconds_since(start), {}, 0.0};
    viewer::Orbit orbit{.view_angle = 0.6};
    orbit.frame(view.ball(), 1.0);
    const viewer::RenderTarget target(kSize, kSize);
    for (int frame = -1; frame < kFrames; ++frame) {
        viewer::SliceTimes times;
        target.clear();
        view.draw(target, orbit.camera(), {.weighted = weighted}, nullptr, &times);
        orbit.turn(0.3, 0.0);
        if (frame < 0) {
            out.shadow_s = times.shadow;
            continue;
        }
        out.each.sort += times.sort / kFrames;
        out.each.draw += times.draw / kFrames;
    }
    return out;
}

std::unique_ptr<VoxelLevel>
draw(const Geometry& cloth, raster::RasterPath path, raster::RasterCounts& counts) {
    VoxelizeOptions options;
    options.voxels = 512;
    Progress silent;
    return raster::voxelize_slices(cloth, options, {.path = path}, plan_voxelize(cloth, options),
                                   silent, nullptr, &counts);
}

void print_row(double millions) {
    const Geometry cloth = knit(millions);
    const Seen sorted = look_at(cloth, false);
    const Seen weighted = look_at(cloth, true);
    raster::RasterCounts fragment;
    raster::RasterCounts compute;
    const auto a = draw(cloth, raster::RasterPath::Fragment, fragment);
    const auto b = draw(cloth, raster::RasterPath::Compute, compute);
    const bool same = raster::test::stored(*a) == raster::test::stored(*b);
    std::printf("| %.2f%s | %.2f | %.1f | %.0f | %.1f | %.1f | %.2f | %.0f | %.0f | %s |\n",
                static_cast<double>(sorted.slices) * 1e-6, sorted.split ? " (split)" : "",
                sorted.setup_s, sorted.each.sort * 1e3, sorted.shadow_s * 1e3,
                sorted.each.draw * 1e3, weighted.each.draw * 1e3, compute.setup_seconds,
                fragment.draw_seconds / 3.0 * 1e3, compute.draw_seconds / 3.0 * 1e3,
                same ? "yes" : "NO");
    std::fflush(stdout);
}

} // namespace
} // namespace heddle

int main(int argc, char** argv) {
    try {
        std::printf("driver: %s\n\n", heddle::opengl::Context().driver().c_str());
        std::puts(
            "| M slices | view: set-up, s | sort, ms | shadow map, ms | draw, ms | by weights, ms | voxels: set-up, s | a pass by fragments, ms | by compute, ms | same bits |\n"
            "|---|---|---|---|---|---|---|---|---|---|");
        if (argc < 2) heddle::print_row(0.01);
        for (int i = 1; i < argc; ++i) heddle::print_row(std::atof(argv[i]));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
