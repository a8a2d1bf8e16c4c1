#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/geom/mesh.h>
#include <heddle/voxelize/triangle/triangle_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace heddle {

// Height maps: a triangle is split into micro-triangles no longer than a subvoxel edge, which are
// moved along the normal and processed one by one.
//
// There are no cracks: the number of pieces of an edge depends on its length only, and its points
// are computed from its two ends only, in an order that is the same for both triangles. The grid
// inside has as many pieces as the longest edge. Its border points are moved to the nearest point
// of the edge, so that both sides have the same points; a micro-triangle that becomes flat has no
// hits. This holds if both triangles have the same position, normal and uv at the ends of the edge.
// Along a uv seam or a hard edge, with two normals at a vertex, the sides separate by the
// difference of their heights or along their two normals.

/// A triangle to be displaced, in scene units.
struct DisplaceTriangle {
    std::array<Vec3f, 3> p;
    std::array<Vec3f, 3> normal; ///< at the vertices, shared by the neighbours
    std::array<Uv, 3> uv;
};

/// A piece of a displaced triangle.
struct MicroTriangle {
    std::array<Vec3d, 3> p; ///< lattice coordinates
    std::array<Vec3f, 3> b; ///< barycentric coordinates of each corner in the parent
};

namespace displace_detail {

struct Vertex {
    Vec3d p; ///< lattice coordinates
    Vec3f b;
};

/// One row of the grid, for the columns [first, first + vertices.size()).
struct Row {
    std::int64_t first = 0;
    std::vector<Vertex> vertices;
    [[nodiscard]] const Vertex& at(std::int64_t column) const {
        return vertices[static_cast<std::size_t>(column - first)];
    }
};

/// The columns [lo, hi]; empty if lo > hi.
struct Range {
    std::int64_t lo = 0, hi = -1;
    [[nodiscard]] HEDDLE_HD bool empty() const { return lo > hi; }
};

[[nodiscard]] HEDDLE_HD inline Range join(Range a, Range b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

} // namespace displace_detail

/// The rows of displace_triangle(), so that a caller's loop allocates once. One per thread.
struct DisplaceScratch {
    displace_detail::Row above, below;
};

namespace displace_detail {

/// The barycentric grid of one triangle: row r in [0, n], column c in [0, r]; vertex 0 is row 0.
class Grid {
public:
    HEDDLE_HD Grid(const DisplaceTriangle& t, Vec3d subvoxel_size) : t_(t), size_(subvoxel_size) {
        for (int v = 0; v < 3; ++v) corner_[v] = to_lattice(t.p[index(v)], subvoxel_size);
        for (int e = 0; e < 3; ++e) {
            int a = e, b = (e + 1) % 3;
            if (!comes_first(t.p[index(a)], t.p[index(b)])) std::swap(a, b);
            edge_[e] = {a, b, pieces_of(corner_[b] - corner_[a])};
            n_ = std::max(n_, edge_[e].pieces);
        }
    }

    [[nodiscard]] HEDDLE_HD std::int64_t rows() const { return n_; }

    /// Returns the columns of row `r` whose undisplaced points may be inside the box [lo, hi].
    [[nodiscard]] HEDDLE_HD Range columns_in(std::int64_t r, Vec3d lo, Vec3d hi) const {
        if (r < 0 || r > n_) return {};
        const double down = static_cast<double>(r) / static_cast<double>(n_);
        const Vec3d from = corner_[0] + (corner_[1] - corner_[0]) * down;
        const Vec3d step = (corner_[2] - corner_[1]) * (1.0 / static_cast<double>(n_));
        double first = 0.0, last = static_cast<double>(r);
        for (int a = 0; a < 3; ++a) {
            if (step[a] == 0.0) {
                if (from[a] < lo[a] || from[a] > hi[a]) return {};
                continue;
            }
            const double s = (lo[a] - from[a]) / step[a], t = (hi[a] - from[a]) / step[a];
            first = std::max(first, std::min(s, t));
            last = std::min(last, std::max(s, t));
        }
        if (first > last + 1.0) return {};
        return {std::max<std::int64_t>(0, floor_to_int(first) - 1),
                std::min(r, floor_to_int(last) + 2)};
    }

    template <typename Height>
    [[nodiscard]] HEDDLE_HD Vertex vertex(std::int64_t r,
                                          std::int64_t c,
                                          const Height& height) const {
        std::array<double, 3> b;
        if (c == 0) {
            b = edge_point(0, 0, r);
        } else if (c == r) {
            b = edge_point(2, 0, r);
        } else if (r == n_) {
            b = edge_point(1, 1, c);
        } else {
            const double n = static_cast<double>(n_);
            b = {static_cast<double>(n_ - r) / n, static_cast<double>(r - c) / n,
                 static_cast<double>(c) / n};
        }
        return displaced(b, height);
    }

private:
    struct Edge {
        int a = 0, b = 0; ///< its ends, in the order of their positions
        std::int64_t pieces = 1;
    };

    HEDDLE_HD static std::size_t index(int v) { return static_cast<std::size_t>(v); }

    HEDDLE_HD static bool comes_first(Vec3f a, Vec3f b) {
        if (a.x != b.x) return a.x < b.x;
        if (a.y != b.y) return a.y < b.y;
        return a.z < b.z;
    }

    HEDDLE_HD static std::int64_t pieces_of(Vec3d edge) {
        return std::max<std::int64_t>(1, -floor_to_int(-length(edge)));
    }

    /// Returns point `k` of `n_` along edge `e`, counted from vertex `from` and moved to the
    /// nearest of the edge's own points.
    [[nodiscard]] HEDDLE_HD std::array<double, 3>
    edge_point(int e, int from, std::int64_t k) const {
        const Edge& edge = edge_[e];
        const std::int64_t along = edge.a == from ? k : n_ - k;
        const std::int64_t m = (2 * along * edge.pieces + n_) / (2 * n_);
        std::array<double, 3> b{};
        b[index(edge.b)] = static_cast<double>(m) / static_cast<double>(edge.pieces);
        b[index(edge.a)] = 1.0 - b[index(edge.b)];
        return b;
    }

    /// Returns the weighted sum of the vertices' values. Vertices with weight 0 are left out and
    /// the order of two does not matter, so a point of an edge has the same value in both
    /// triangles.
    template <typename Value>
    HEDDLE_HD static double blend(const std::array<double, 3>& b, const Value& value) {
        double sum = 0.0;
        for (std::size_t v = 0; v < 3; ++v)
            if (b[v] != 0.0) sum += b[v] * value(v);
        return sum;
    }

    template <typename Height>
    [[nodiscard]] HEDDLE_HD Vertex displaced(const std::array<double, 3>& b,
                                             const Height& height) const {
        const auto component = [&](const std::array<Vec3f, 3>& v) {
            return Vec3d{blend(b, [&](std::size_t i) { return double{v[i].x}; }),
                         blend(b, [&](std::size_t i) { return double{v[i].y}; }),
                         blend(b, [&](std::size_t i) { return double{v[i].z}; })};
        };
        const Uv uv{
            static_cast<float>(blend(b, [&](std::size_t i) { return double{t_.uv[i].u}; })),
            static_cast<float>(blend(b, [&](std::size_t i) { return double{t_.uv[i].v}; }))};
        const Vec3d n = normalize(component(t_.normal), Vec3d{});
        const Vec3d p = component(t_.p) + n * static_cast<double>(height(uv));
        return {{p.x / size_.x, p.y / size_.y, p.z / size_.z},
                {static_cast<float>(b[0]), static_cast<float>(b[1]), static_cast<float>(b[2])}};
    }

    const DisplaceTriangle& t_;
    Vec3d size_;
    Vec3d corner_[3]; ///< lattice coordinates
    Edge edge_[3];    ///< between vertices e and e + 1, in either direction
    std::int64_t n_ = 1;
};

/// A box, in lattice coordinates, that contains the undisplaced points of all micro-triangles that
/// touch a given box.
struct ReachBox {
    Vec3d lo, hi;

    HEDDLE_HD ReachBox(const SubvoxelBox& box, double reach, Vec3d subvoxel_size) {
        // All undisplaced corners of a micro-triangle in the box are within the reach plus its own
        // size of the box: under 3 subvoxels, including edge points that were moved.
        for (int a = 0; a < 3; ++a) {
            const double margin = reach / subvoxel_size[a] + 3.0;
            lo[a] = static_cast<double>(box.lo[a]) - margin;
            hi[a] = static_cast<double>(box.hi[a]) + margin;
        }
    }
};

HEDDLE_HD inline MicroTriangle micro(const Vertex& a, const Vertex& b, const Vertex& c) {
    return {{a.p, b.p, c.p}, {a.b, b.b, c.b}};
}

/// Computes row `r` at the columns of a range and at one more on either side, for the corners of
/// micro-triangles.
template <typename Height>
void fill_row(const Grid& grid, std::int64_t r, Range range, const Height& height, Row& row) {
    row.first = std::max<std::int64_t>(0, range.lo - 1);
    row.vertices.clear();
    if (range.empty()) return;
    for (std::int64_t c = row.first; c <= std::min(r, range.hi + 1); ++c) {
        row.vertices.push_back(grid.vertex(r, c, height));
    }
}

/// Emits the micro-triangles between row `r` and the next row, at the columns of a strip.
template <typename Emit>
void emit_strip(const Row& above, const Row& below, std::int64_t r, Range strip, Emit& emit) {
    for (std::int64_t c = strip.lo; c <= std::min(r, strip.hi); ++c) {
        emit(micro(above.at(c), below.at(c), below.at(c + 1)));
        if (c < r) emit(micro(above.at(c), below.at(c + 1), above.at(c + 1)));
    }
}

} // namespace displace_detail

/// Splits and displaces a triangle, and calls `emit(const MicroTriangle&)` for at least all of the
/// micro-triangles that touch `box`. A micro-triangle does not depend on the box.
///
/// @param subvoxel_size  scene units per axis, > 0
/// @param reach          upper bound of |height|, from max_displacement(), scene units
/// @param height         float height(Uv): distance along the normal, scene units
/// @param scratch        two rows; at most 80 bytes per piece of an edge near the box
template <typename Height, typename Emit>
void displace_triangle(const DisplaceTriangle& t,
                       Vec3d subvoxel_size,
                       double reach,
                       const SubvoxelBox& box,
                       const Height& height,
                       Emit&& emit,
                       DisplaceScratch& scratch) {
    using namespace displace_detail;
    const Grid grid(t, subvoxel_size);
    const ReachBox near(box, reach, subvoxel_size);
    Row& above = scratch.above;
    Row& below = scratch.below;
    Range range_above = grid.columns_in(0, near.lo, near.hi);
    Range range_below = grid.columns_in(1, near.lo, near.hi);
    fill_row(grid, 0, join(range_above, range_below), height, above);
    for (std::int64_t r = 0; r < grid.rows(); ++r) {
        const Range range_next = grid.columns_in(r + 2, near.lo, near.hi);
        const Range strip = join(range_above, range_below);
        fill_row(grid, r + 1, join(strip, range_next), height, below);
        emit_strip(above, below, r, strip, emit);
        std::swap(above, below);
        range_above = range_below;
        range_below = range_next;
    }
}

/// Replaces a DisplaceScratch where there is no memory for one.
struct NoScratch {};

/// Emits the same micro-triangles without scratch. Each vertex is computed twice: for the strip
/// above it and for the strip below.
template <typename Height, typename Emit>
HEDDLE_HD inline void displace_triangle(const DisplaceTriangle& t,
                                        Vec3d subvoxel_size,
                                        double reach,
                                        const SubvoxelBox& box,
                                        const Height& height,
                                        Emit&& emit,
                                        NoScratch) {
    using namespace displace_detail;
    const Grid grid(t, subvoxel_size);
    const ReachBox near(box, reach, subvoxel_size);
    for (std::int64_t r = 0; r < grid.rows(); ++r) {
        const Range strip =
            join(grid.columns_in(r, near.lo, near.hi), grid.columns_in(r + 1, near.lo, near.hi));
        if (strip.empty() || strip.lo > r) continue;
        Vertex above = grid.vertex(r, strip.lo, height);
        Vertex below = grid.vertex(r + 1, strip.lo, height);
        for (std::int64_t c = strip.lo; c <= std::min(r, strip.hi); ++c) {
            const Vertex below_next = grid.vertex(r + 1, c + 1, height);
            emit(micro(above, below, below_next));
            if (c == r) break;
            const Vertex above_next = grid.vertex(r, c + 1, height);
            emit(micro(above, below_next, above_next));
            above = above_next;
            below = below_next;
        }
    }
}

} // namespace heddle
