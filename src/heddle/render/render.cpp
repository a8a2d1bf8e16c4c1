#include <heddle/render/render.h>

#include <heddle/base/parallel.h>

#include <algorithm>

namespace heddle {
namespace {

constexpr std::int32_t kTile = 4; // px: small pictures keep all threads busy too

} // namespace

void render_pass(const PathScene& scene,
                 const Camera& camera,
                 const PathOptions& options,
                 std::uint64_t seed,
                 std::uint32_t samples,
                 Picture& picture,
                 Progress& progress) {
    const std::int32_t across = (picture.width + kTile - 1) / kTile;
    const std::int32_t down = (picture.height + kTile - 1) / kTile;
    Picture next = picture;
    const auto tiles = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
    parallel_chunks(tiles, 1, [&](std::size_t tile, std::size_t) {
        progress.check();
        const std::int32_t x0 =
            static_cast<std::int32_t>(tile % static_cast<std::size_t>(across)) * kTile;
        const std::int32_t y0 =
            static_cast<std::int32_t>(tile / static_cast<std::size_t>(across)) * kTile;
        std::int64_t done = 0;
        for (std::int32_t y = y0; y < std::min(y0 + kTile, picture.height); ++y) {
            for (std::int32_t x = x0; x < std::min(x0 + kTile, picture.width); ++x) {
                const std::size_t pixel =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                    static_cast<std::size_t>(x);
                PixelSums& sums = next.pixels[pixel];
                for (std::uint32_t s = sums.samples; s < samples; ++s) {
                    PathSampler sampler(seed, pixel, s);
                    const auto [dx, dy] = sampler.pair();
                    const Ray ray = camera.ray(static_cast<float>(x) + dx,
                                               static_cast<float>(y) + dy, sampler.pair());
                    sums.add(trace_path(scene, options, ray, sampler));
                    ++done;
                }
            }
        }
        progress.advance(done);
    });
    picture = std::move(next);
}

} // namespace heddle
