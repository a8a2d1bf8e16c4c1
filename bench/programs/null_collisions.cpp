// Prints, as markdown, the cost of a free flight per level: exact traversal of voxels, as heddle
// renders, against null collisions with local majorants (delta tracking).
//
//     heddle_null_collisions X.vdb [RAYS]
//
// Both sample the same distribution, the product of independent voxels; the fraction of rays that
// pass is printed for both. Majorants are those of bricks of 8^3 voxels along the ray's own
// direction, the tightest that a brick can have; bricks and tiles of 64^3 skip empty space.

#include <heddle/base/error.h>
#include <heddle/geom/affine.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/render/volume/clip.h>
#include <heddle/render/volume/transport_law.h>
#include <heddle/render/volume/walk.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace heddle::bench {
namespace {

/// Free flights by null collisions.                                      [Woodcock 1965]
class DeltaTracker {
public:
    explicit DeltaTracker(const TraversalLevel& level)
        : level_(level), majorants_(static_cast<std::size_t>(level.info().voxel_count)) {}

    /// @return  whether the ray is stopped between t0 and t1
    [[nodiscard]] bool stops(const VoxelRay& voxel_ray, float t0, float t1, StreamRandom& random) {
        const detail::LocalRay ray = detail::localize(voxel_ray, t0);
        const Vec3f rate{std::fabs(ray.direction.x), std::fabs(ray.direction.y),
                         std::fabs(ray.direction.z)};
        const float end = t1 - t0;
        Vec3i at{};
        for (float t = 0.0f; t < end;) {
            const Vec3i index = ray.base + at;
            const TraversalLevel::LeafLookup place = level_.find_leaf(index);
            const std::int32_t mask = ~(place.size - 1);
            const Vec3i low = Vec3i{index.x & mask, index.y & mask, index.z & mask} - ray.base;
            const detail::Exit exit = detail::find_exit(ray, low, place.size);
            if (place.leaf != nullptr) {
                const float out = std::min(exit.t, end);
                const float majorant = combine_depths(majorant_of(*place.leaf) * rate);
                for (;;) {
                    t -= std::log(1.0f - random.uniform()) / majorant;
                    if (!(t < out)) break;
                    const std::int64_t v = place.leaf->find(ray.base + cell(ray, low, t));
                    if (v < 0) continue;
                    const float depth = combine_depths(level_.depths(v) * rate);
                    if (random.uniform() * majorant < depth) return true;
                }
            }
            at = detail::step_over(ray, low, place.size, exit);
            t = exit.t;
        }
        return false;
    }

private:
    [[nodiscard]] static Vec3i cell(const detail::LocalRay& ray, Vec3i low, float t) {
        Vec3i out;
        for (int a = 0; a < 3; ++a) {
            const auto i =
                static_cast<std::int32_t>(std::floor(ray.from[a] + ray.direction[a] * t));
            out[a] = std::clamp(i, low[a], low[a] + 7);
        }
        return out;
    }
    Vec3f majorant_of(const TraversalLeaf& leaf) {
        Vec3f& most = majorants_[leaf.first_voxel];
        if (most.x == 0.0f) {
            for (int i = 0; i < 512; ++i) {
                const std::int64_t v = leaf.find({i >> 6, i >> 3 & 7, i & 7});
                if (v < 0) continue;
                const Vec3f d = level_.depths(v);
                for (int a = 0; a < 3; ++a) most[a] = std::max({most[a], d[a], 1e-6f});
            }
        }
        return most;
    }
    const TraversalLevel& level_;
    std::vector<Vec3f> majorants_; ///< of a brick's voxels along each axis, by first voxel
};

struct LevelRays {
    std::vector<VoxelRay> rays;
    std::vector<RayRange> ranges;
};

/// Rays through the object's box: from a point on a sphere around it to a point inside it.
LevelRays make_rays(const TraversalLevel& level, std::size_t count) {
    const Vec3d h = level.info().lattice.voxel_size;
    const auto corner = [&](Vec3i i) {
        return Vec3d{static_cast<double>(i.x), static_cast<double>(i.y), static_cast<double>(i.z)};
    };
    const Bounds box{corner(level.lo()), corner(level.hi())};
    const Vec3d size = (box.hi - box.lo) * h;
    StreamRandom random{7};
    const auto uniform = [&] { return static_cast<double>(random.uniform()); };
    LevelRays out;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 2.0 * uniform() - 1.0, phi = 2.0 * std::numbers::pi * uniform();
        const double r = std::sqrt(1.0 - z * z);
        const Vec3d from = Vec3d{r * std::cos(phi), r * std::sin(phi), z} * length(size);
        const Vec3d to{(uniform() - 0.5) * size.x, (uniform() - 0.5) * size.y,
                       (uniform() - 0.5) * size.z};
        const Vec3d per{1.0 / h.x, 1.0 / h.y, 1.0 / h.z};
        const Vec3d middle = (box.lo + box.hi) * 0.5;
        const VoxelRay ray{middle + (to + from) * per, normalize(from * -1.0) * per};
        out.rays.push_back(ray);
        out.ranges.push_back(clip(ray.origin, ray.direction, 0.0f, 1e30f, box));
    }
    return out;
}

struct Cost {
    double nanoseconds = 0.0, passed = 0.0;
};

template <typename Stops>
Cost measure(const LevelRays& rays, const Stops& stops) {
    StreamRandom random{11};
    std::size_t passed = 0;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < rays.rays.size(); ++i) {
        passed += stops(rays.rays[i], rays.ranges[i], random) ? 0 : 1;
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const auto n = static_cast<double>(rays.rays.size());
    return {1e9 * took.count() / n, static_cast<double>(passed) / n};
}

void run(const std::string& path, std::size_t count) {
    const VoxelLevels levels = read_levels(path);
    std::printf("| level | ns a flight, walked | null collisions | times | pass, walked | null |\n"
                "|---|---|---|---|---|---|\n");
    for (const auto& grid : levels) {
        const TraversalLevel level(*grid);
        const LevelRays rays = make_rays(level, count);
        const auto walk = [&](const VoxelRay& ray, const RayRange& range, StreamRandom& random) {
            RayPassage passage(true, random);
            ProductLaw law(level, ray, passage);
            traverse_voxels(level, ray, range.t0, range.t1,
                            [&](const VoxelStep& step) { return law.pass(step); });
            return passage.stopped();
        };
        DeltaTracker tracker(level);
        const auto track = [&](const VoxelRay& ray, const RayRange& range, StreamRandom& random) {
            return tracker.stops(ray, range.t0, range.t1, random);
        };
        static_cast<void>(measure(rays, track)); // computes the majorants of bricks
        const Cost walked = measure(rays, walk), drawn = measure(rays, track);
        std::printf("| %d | %.0f | %.0f | %.2f | %.4f | %.4f |\n", grid->info().level,
                    walked.nanoseconds, drawn.nanoseconds, drawn.nanoseconds / walked.nanoseconds,
                    walked.passed, drawn.passed);
    }
}

} // namespace
} // namespace heddle::bench

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: heddle_null_collisions X.vdb [RAYS]\n");
        return 2;
    }
    try {
        heddle::bench::run(argv[1], argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 200000);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "heddle_null_collisions: %s\n", e.what());
        return 1;
    }
}
