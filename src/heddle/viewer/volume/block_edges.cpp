#include <heddle/viewer/volume/block_edges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace heddle::viewer {
namespace {

bool comes_before(const Vec3i& a, const Vec3i& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

Vec3d to_places(Vec3i v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

struct Range {
    double begin, end;
};

/// The part of the ray inside lo to hi.
Range clip(Vec3d from, Vec3d way, Vec3d lo, Vec3d hi, double begin) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    Range out{begin, kNever};
    for (int a = 0; a < 3; ++a) {
        if (way[a] == 0.0) {
            if (from[a] < lo[a] || from[a] >= hi[a]) return {0.0, -kNever};
            continue;
        }
        const double u = (lo[a] - from[a]) / way[a], v = (hi[a] - from[a]) / way[a];
        out.begin = std::max(out.begin, std::min(u, v));
        out.end = std::min(out.end, std::max(u, v));
    }
    return out;
}

} // namespace

std::vector<std::array<float, 4>>
edges_of_blocks(std::span<const Vec3i> blocks, Vec3d size, Vec3d middle) {
    using Edge = std::tuple<int, int, int, int>; // corner and axis
    std::vector<Edge> edges;
    edges.reserve(12 * blocks.size());
    for (const Vec3i b : blocks) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int side = 0; side < 4; ++side) {
                Vec3i at = b;
                at[(axis + 1) % 3] += side & 1;
                at[(axis + 2) % 3] += side >> 1;
                edges.emplace_back(at.x, at.y, at.z, axis);
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<std::array<float, 4>> out;
    out.reserve(edges.size());
    for (const auto& [x, y, z, axis] : edges) {
        const Vec3f at = to_float(size * to_places({x, y, z}) - middle);
        out.push_back({at.x, at.y, at.z, static_cast<float>(axis)});
    }
    return out;
}

std::optional<Vec3i> first_block(std::span<const Vec3i> blocks, Vec3d from, Vec3d way, bool whole) {
    if (blocks.empty()) return std::nullopt;
    Vec3i lo = blocks.front(), hi = blocks.front();
    for (const Vec3i b : blocks) {
        for (int a = 0; a < 3; ++a) {
            lo[a] = std::min(lo[a], b[a]);
            hi[a] = std::max(hi[a], b[a]);
        }
    }
    const double begin = whole ? -std::numeric_limits<double>::infinity() : 0.0;
    const Range range = clip(from, way, to_places(lo), to_places(hi + Vec3i{1, 1, 1}), begin);
    if (!(range.begin < range.end)) return std::nullopt;
    Vec3i at, step;
    Vec3d next;
    for (int a = 0; a < 3; ++a) {
        const double x = std::floor(from[a] + way[a] * range.begin);
        at[a] = std::clamp(static_cast<std::int32_t>(x), lo[a], hi[a]);
        step[a] = way[a] > 0.0 ? 1 : -1;
    }
    while (true) {
        if (std::binary_search(blocks.begin(), blocks.end(), at, comes_before)) return at;
        for (int a = 0; a < 3; ++a) {
            const double face = at[a] + (way[a] > 0.0 ? 1.0 : 0.0);
            next[a] =
                way[a] != 0.0 ? (face - from[a]) / way[a] : std::numeric_limits<double>::infinity();
        }
        const int a = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
        at[a] += step[a];
        if (at[a] < lo[a] || at[a] > hi[a]) return std::nullopt;
    }
}

} // namespace heddle::viewer
