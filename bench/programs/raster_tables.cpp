// raster_tables sort|slices|images: [LopezMoreno17]: figure 11, table 1, sizes of slice images.
#include <heddle/base/random.h>
#include <heddle/geom/generate.h>
#include <heddle/io/yarn/yarn_file.h>
#include <heddle/opengl/context.h>
#include <heddle/raster/test_difference.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/slice/test_slices.h>
#include <heddle/viewer/slice/radix_sort.h>
#include <heddle/yarn/slice_image.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heddle {
namespace {

constexpr int kRuns = 5;

double median(std::array<double, kRuns> seconds) {
    std::sort(seconds.begin(), seconds.end());
    return seconds[kRuns / 2];
}

template <typename Run>
double seconds_of(const Run& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The median seconds of std::sort over a fresh copy of `values`.
template <typename T>
double std_seconds(const std::vector<T>& values) {
    std::array<double, kRuns> seconds{};
    for (double& s : seconds) {
        std::vector<T> sorted = values;
        s = seconds_of([&] { std::sort(sorted.begin(), sorted.end()); });
    }
    return median(seconds);
}

/// The median seconds of the driver's sort, until its last pass is done.
double radix_seconds(const std::vector<std::uint32_t>& keys) {
    const viewer::RadixSort sort(static_cast<std::uint32_t>(keys.size()));
    std::array<std::uint32_t, 1> first{};
    const auto wait = [&] { sort.keys().read(std::as_writable_bytes(std::span(first))); };
    std::array<double, kRuns> seconds{};
    for (int run = -1; run < kRuns; ++run) { // the first one includes compilation
        sort.keys().write(std::as_bytes(std::span(keys)));
        sort.values().write(std::as_bytes(std::span(keys)));
        wait();
        const double s = seconds_of([&] {
            sort.sort();
            wait();
        });
        if (run >= 0) seconds[static_cast<std::size_t>(run)] = s;
    }
    return median(seconds);
}

void print_sort() {
    const opengl::Context context;
    std::puts(
        "| keys | RadixSort, ms | std::sort, ms | ratio | std::sort with numbers, ms | ratio |\n"
        "|---|---|---|---|---|---|");
    for (const std::uint32_t count : {10'000u, 100'000u, 1'000'000u, 10'000'000u}) {
        std::vector<std::uint32_t> keys(count);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            keys[i] = static_cast<std::uint32_t>(hash64(11, i));
            pairs[i] = {keys[i], i};
        }
        const double radix = radix_seconds(keys);
        const double alone = std_seconds(keys);
        const double both = std_seconds(pairs);
        std::printf("| %u | %.2f | %.2f | %.2f | %.2f | %.2f |\n", count, radix * 1e3, alone * 1e3,
                    alone / radix, both * 1e3, both / radix);
        context.check("sort");
    }
}

Geometry knit(std::int64_t nx, std::int64_t ny, const YarnType& yarn) {
    Geometry cloth = generate({.kind = GenerateKind::Knit, .nx = nx, .ny = ny});
    slice::test::set_yarn(cloth, yarn);
    cloth.yarns[0].radius = 0.1f;
    return cloth;
}

VoxelizeOptions options_of(std::uint64_t seed) {
    VoxelizeOptions options;
    options.voxel_size = {0.06, 0.06, 0.06};
    options.keep_sums = true;
    options.seed = seed;
    return options;
}

YarnType slice_of_cotton(std::int32_t size, std::uint64_t seed = 0) {
    return make_slice(read_yarn("cotton").yarn, {.size = size, .seed = seed}).yarn;
}

void print_slices() {
    std::puts(
        "| loops | slices | set-up, s | a pass, s | set-up, us a slice | a pass, us a slice |\n"
        "|---|---|---|---|---|---|");
    const YarnType yarn = slice_of_cotton(256);
    raster::SliceVoxelizer voxelizer({});
    Progress silent;
    // the first one includes compilation, and drawing the sections of eight yarns
    for (const auto& [nx, ny] : {std::pair{1, 8}, {2, 8}, {4, 8}, {8, 8}, {16, 16}}) {
        const Geometry cloth = knit(nx, ny, yarn);
        raster::RasterCounts counts;
        (void)voxelizer.voxelize(cloth, options_of(0), plan_voxelize(cloth, options_of(0)), silent,
                                 nullptr, &counts);
        const auto slices = static_cast<double>(counts.slices);
        const double pass = counts.draw_seconds / 3.0;
        std::printf("| %d x %d | %.0f | %.3f | %.2f | %.1f | %.0f |\n", nx, ny, slices,
                    counts.setup_seconds, pass, counts.setup_seconds * 1e6 / slices,
                    pass * 1e6 / slices);
        std::fflush(stdout);
    }
}

/// A knit of slices of `size` texels per side, rasterized.
struct Drawn {
    std::unique_ptr<VoxelLevel> voxels;
    double image_seconds = 0.0;
    raster::RasterCounts counts;
};

Drawn draw(std::int32_t size, std::uint64_t seed, raster::Composition composition) {
    Drawn out;
    YarnType yarn;
    out.image_seconds = seconds_of([&] { yarn = slice_of_cotton(size); });
    const Geometry cloth = knit(8, 4, yarn);
    Progress silent;
    out.voxels = raster::voxelize_slices(cloth, options_of(seed), {.composition = composition},
                                         plan_voxelize(cloth, options_of(seed)), silent, nullptr,
                                         &out.counts);
    return out;
}

void print_images() {
    std::puts(
        "| composition | image | seed | image, s | set-up, s | three passes, s | density | median angle | 9 of 10 below |\n|---|---|---|---|---|---|---|---|---|");
    for (const auto& [name, composition] :
         {std::pair{"accumulate", raster::Composition::Accumulate},
          {"average", raster::Composition::Average},
          {"max", raster::Composition::Max}}) {
        const Drawn first = draw(1024, 0, composition);
        for (const auto& [size, seed] :
             {std::pair{1024, 0}, {256, 0}, {64, 0}, {32, 0}, {1024, 1}}) {
            const Drawn drawn = draw(size, static_cast<std::uint64_t>(seed), composition);
            const raster::test::Difference d = raster::test::compare(*first.voxels, *drawn.voxels);
            std::printf("| %s | %d x %d | %d | %.3f | %.3f | %.2f | %.4f | %.2f | %.2f |\n", name,
                        size, size, seed, drawn.image_seconds, drawn.counts.setup_seconds,
                        drawn.counts.draw_seconds, d.density, d.angle_deg, d.far_deg);
        }
    }
}

} // namespace
} // namespace heddle

int main(int argc, char** argv) {
    const std::string_view table = argc == 2 ? argv[1] : "";
    if (table == "sort") {
        heddle::print_sort();
    } else if (table == "slices") {
        heddle::print_slices();
    } else if (table == "images") {
        heddle::print_images();
    } else {
        std::fputs("usage: heddle_raster_tables sort|slices|images\n", stderr);
        return 2;
    }
}
