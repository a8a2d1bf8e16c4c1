// The time to evaluate a yarn's fibers alone: the lower bound of bench/voxelize_speed.py.
#include <heddle/voxelize/fiber/gather_kernels.h>

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

namespace heddle {
namespace {

/// Three plies of 50 fibers with 4 chords (7 samples): a span of the sweater at 1024 voxels. Items
/// are chords; one chord is 4.2 steps there.
void expand_span(benchmark::State& state) {
    YarnType yarn;
    yarn.model = YarnModel::Procedural;
    yarn.plies = 3;
    yarn.fibers_per_ply = 50;
    const FiberTable table = place_fibers(yarn, 1, 0);
    std::vector<PlyFrame> frames;
    for (int j = 0; j < 7; ++j) {
        const float t = static_cast<float>(j);
        frames.push_back({{4.0f * t, 0.1f * t * t, 0.0f},
                          {0.0f, 1.0f, 0.1f * t},
                          {0.0f, -0.1f * t, 1.0f},
                          sincos_turns(0.05 * j),
                          sincos_turns(0.07 * j)});
    }
    const std::vector<PlyPart> parts{
        {0, 50, frames.data()}, {50, 100, frames.data()}, {100, 150, frames.data()}};
    const auto tile = std::make_unique<FiberTile>();
    tile->fibers = 150;
    tile->chords = 4;
    for (float& radius : tile->radius) radius = 0.48f;
    for (auto _ : state) {
        expand_fibers(*tile, parts, {3.0f, 3.0f, 2.5f, 0.8f, 0.2f}, table);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * 4 * 150);
}
BENCHMARK(expand_span);

} // namespace
} // namespace heddle
