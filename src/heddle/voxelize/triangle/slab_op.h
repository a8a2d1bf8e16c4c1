#pragma once

#include <heddle/base/platform.h>
#include <heddle/voxel/plane_slab.h>
#include <heddle/voxelize/triangle/triangle_op.h>

#include <cmath>
#include <cstdint>

namespace heddle {

// Widens the slabs of a block's voxels until they hold a triangle, by the same code on host and
// device. `Slabs` is the slabs of one block for the triangle's material. It has the functions
//
//   int find(int cell)                      the voxel of a cell where the triangle counts; -1: none
//   Vec3d gradient(int voxel)               slab_gradient() of the voxel
//   void widen(int voxel, int lo, int hi)   makes the slab hold these values
//
// or, in the pass before that finds the normals, Slabs::kMeasuresAreas and
//
//   void add_area(int voxel, Vec3d area)    vector area of a piece, in units of the voxel's faces
//
// cell = (x 32 + y) 32 + z of a voxel relative to the block's lo.
//
// A triangle has the snapped vertices of the scan (triangle_scan.h), so that what is clipped is
// what was hit. It is cut into slices of a voxel's width along one axis, these into columns along
// the next, and these into voxels along the axis in which the triangle is largest, where a column
// has few. Coordinates are relative to the voxel that contains the triangle's lower corner, and
// each piece is rounded to whole steps before it is joined with others: neither blocks nor the
// order of triangles change a bit.

namespace slab_detail {

/// A convex polygon, in voxels.
struct Piece {
    double p[9][3]; ///< three vertices, and one more for each of six planes
    int count = 0;

    HEDDLE_HD void find_range(int axis, double& min, double& max) const {
        min = p[0][axis];
        max = min;
        for (int i = 1; i < count; ++i) {
            min = p[i][axis] < min ? p[i][axis] : min;
            max = p[i][axis] > max ? p[i][axis] : max;
        }
    }
    HEDDLE_HD void append(const double* from) {
        for (int a = 0; a < 3; ++a) p[count][a] = from[a];
        ++count;
    }
};

/// Sets `out` to the part of `in` where sign * (p[axis] - at) <= 0.
HEDDLE_HD inline void clip(const Piece& in, int axis, double at, double sign, Piece& out) {
    out.count = 0;
    const double* a = in.p[in.count - 1];
    double over_a = sign * (a[axis] - at);
    for (int i = 0; i < in.count; ++i) {
        const double* b = in.p[i];
        const double over_b = sign * (b[axis] - at);
        if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) {
            const double share = over_a / (over_a - over_b);
            double* cut = out.p[out.count++];
            for (int c = 0; c < 3; ++c) cut[c] = a[c] + (b[c] - a[c]) * share;
            cut[axis] = at;
        }
        if (over_b <= 0.0) out.append(b);
        a = b;
        over_a = over_b;
    }
}

/// The cells [first, last] along an axis that a range of coordinates touches. What only touches
/// the upper face of a cell is not in it, and what lies in the plane of a face belongs to the cell
/// above it, as its hits do.
struct CellRange {
    std::int64_t first = 0, last = 0;

    HEDDLE_HD CellRange(double min, double max)
        : first(floor_to_int(min)), last(max > min ? -floor_to_int(-max) - 1 : first) {}
    HEDDLE_HD void clip(const CellRange& to) {
        first = first > to.first ? first : to.first;
        last = last < to.last ? last : to.last;
    }
};

/// Cuts pieces to one cell after another along an axis.
class Cutter {
public:
    /// @param from   not empty
    /// @param cells  the cells that are wanted
    HEDDLE_HD Cutter(const Piece& from, int axis, const CellRange& cells)
        : from_(from), axis_(axis), cells_(cells) {
        from.find_range(axis, min_, max_);
        CellRange own(min_, max_);
        own.clip(cells_);
        cells_ = own;
    }
    [[nodiscard]] HEDDLE_HD const CellRange& cells() const { return cells_; }

    /// Returns the part in a cell; valid until the next call.
    [[nodiscard]] HEDDLE_HD const Piece& cut(std::int64_t cell) {
        const auto lo = static_cast<double>(cell);
        const Piece* now = &from_;
        if (min_ < lo) {
            clip(*now, axis_, lo, -1.0, above_);
            now = &above_;
        }
        if (max_ > lo + 1.0 && now->count > 0) {
            clip(*now, axis_, lo + 1.0, 1.0, below_);
            now = &below_;
        }
        return *now;
    }

private:
    const Piece& from_;
    int axis_;
    CellRange cells_;
    double min_ = 0.0, max_ = 0.0;
    Piece above_, below_;
};

/// Returns the axis along which a triangle is largest; -1: it has no area.
[[nodiscard]] HEDDLE_HD inline int largest_axis(const Piece& t) {
    double n[3];
    for (int a = 0; a < 3; ++a) {
        const int u = (a + 1) % 3;
        const int v = (a + 2) % 3;
        const double area = (t.p[1][u] - t.p[0][u]) * (t.p[2][v] - t.p[0][v]) -
                            (t.p[2][u] - t.p[0][u]) * (t.p[1][v] - t.p[0][v]);
        n[a] = area < 0.0 ? -area : area;
    }
    const int w = n[0] >= n[1] ? (n[0] >= n[2] ? 0 : 2) : (n[1] >= n[2] ? 1 : 2);
    return n[w] > 0.0 ? w : -1;
}

/// Widens the slabs of one block.
template <typename Slabs>
class SlabWidener {
public:
    /// @param lo,hi  voxel range of the block, [lo, hi)
    HEDDLE_HD SlabWidener(const Slabs& slabs, Vec3i lo, Vec3i hi, int subvoxels)
        : slabs_(slabs), lo_(lo), hi_(hi), box_{lo * subvoxels, hi * subvoxels} {
        for (int n = 1; n < subvoxels; n *= 2) ++shift_;
    }

    [[nodiscard]] HEDDLE_HD SubvoxelBox box() const { return box_; }

    HEDDLE_HD void add(const ScanTriangle& t) const {
        Piece whole;
        whole.count = 3;
        int origin[3]; // block's voxel that the coordinates are relative to
        const double scale = 1.0 / static_cast<double>(kScanOne << shift_);
        for (int a = 0; a < 3; ++a) {
            const std::int32_t voxel = t.anchor[a] >> shift_;
            const std::int64_t move = (t.anchor[a] - (voxel << shift_)) * kScanOne;
            for (int v = 0; v < 3; ++v) {
                whole.p[v][a] = static_cast<double>(t.p[v][a] + move) * scale;
            }
            origin[a] = voxel - lo_[a];
        }
        cut_to_slices(whole, origin);
    }

    /// DisplacedHits' counterpart.
    HEDDLE_HD void operator()(const MicroTriangle& micro) const {
        if (triangle_detail::is_outside(micro, box_)) return;
        add(prepare_triangle(micro.p[0], micro.p[1], micro.p[2]));
    }

private:
    /// Returns the cells of the block along an axis.
    [[nodiscard]] HEDDLE_HD CellRange cells_of(int axis, const int (&origin)[3]) const {
        CellRange out(0.0, 0.0);
        out.first = -origin[axis];
        out.last = hi_[axis] - lo_[axis] - 1 - origin[axis];
        return out;
    }

    HEDDLE_HD void cut_to_slices(const Piece& whole, const int (&origin)[3]) const {
        const int w = largest_axis(whole);
        if (w < 0) return; // it has no hits either
        const int u = w == 0 ? 1 : 0;
        const int v = w == 2 ? 1 : 2;
        const CellRange in_v = cells_of(v, origin);
        const CellRange in_w = cells_of(w, origin);
        std::int64_t cell[3];
        Cutter slices(whole, u, cells_of(u, origin));
        for (cell[u] = slices.cells().first; cell[u] <= slices.cells().last; ++cell[u]) {
            const Piece& slice = slices.cut(cell[u]);
            if (slice.count == 0) continue;
            Cutter columns(slice, v, in_v);
            for (cell[v] = columns.cells().first; cell[v] <= columns.cells().last; ++cell[v]) {
                const Piece& column = columns.cut(cell[v]);
                if (column.count == 0) continue;
                Cutter voxels(column, w, in_w);
                for (cell[w] = voxels.cells().first; cell[w] <= voxels.cells().last; ++cell[w]) {
                    add_to(voxels, cell[w], cell, origin);
                }
            }
        }
    }

    HEDDLE_HD void add_to(Cutter& voxels,
                          std::int64_t w,
                          const std::int64_t (&cell)[3],
                          const int (&origin)[3]) const {
        int at[3];
        for (int a = 0; a < 3; ++a) at[a] = static_cast<int>(cell[a] + origin[a]);
        const int voxel = slabs_.find((at[0] * kBlockVoxels + at[1]) * kBlockVoxels + at[2]);
        if (voxel < 0) return;
        const Piece& piece = voxels.cut(w);
        if (piece.count == 0) return;
        if constexpr (Slabs::kMeasuresAreas) {
            slabs_.add_area(voxel, area_of(piece));
        } else {
            widen(voxel, piece, cell);
        }
    }
    /// Returns the vector area, in units of the voxel's faces.
    HEDDLE_HD static Vec3d area_of(const Piece& piece) {
        const auto from_first = [&](int i) {
            return Vec3d{piece.p[i][0] - piece.p[0][0], piece.p[i][1] - piece.p[0][1],
                         piece.p[i][2] - piece.p[0][2]};
        };
        Vec3d sum{};
        for (int i = 2; i < piece.count; ++i) {
            sum = sum + cross(from_first(i - 1), from_first(i)) * 0.5;
        }
        return sum;
    }
    HEDDLE_HD void widen(int voxel, const Piece& piece, const std::int64_t (&cell)[3]) const {
        const Vec3d g = slabs_.gradient(voxel);
        const double base =
            slab_value(g, {-0.5 - static_cast<double>(cell[0]), -0.5 - static_cast<double>(cell[1]),
                           -0.5 - static_cast<double>(cell[2])});
        double min = 1e300;
        double max = -1e300;
        for (int i = 0; i < piece.count; ++i) {
            const double x = dot(g, {piece.p[i][0], piece.p[i][1], piece.p[i][2]});
            min = x < min ? x : min;
            max = x > max ? x : max;
        }
        slabs_.widen(voxel, round_slab_value(base + min), round_slab_value(base + max));
    }

    Slabs slabs_;
    Vec3i lo_, hi_;
    SubvoxelBox box_;
    int shift_ = 0; ///< log2 of the subvoxels per axis
};

} // namespace slab_detail

/// Widens the slabs of a block's voxels until they hold one triangle, or what a height map makes
/// of it.
/// @tparam Kind    kind of the mesh
/// @param lo,hi    voxel range of the block, [lo, hi), at most kBlockVoxels per axis
/// @param slabs    slabs of the block for the material of the triangle's mesh
/// @param scratch  DisplaceScratch or NoScratch
template <SurfaceKind Kind, typename Slabs, typename Scratch>
HEDDLE_HD inline void widen_slabs(const SurfaceView& surfaces,
                                  TriangleId place,
                                  int subvoxels,
                                  Vec3i lo,
                                  Vec3i hi,
                                  const Slabs& slabs,
                                  Scratch&& scratch) {
    const slab_detail::SlabWidener<Slabs> widener(slabs, lo, hi, subvoxels);
    const MeshView& mesh = surfaces.meshes[place.mesh];
    if constexpr (Kind == SurfaceKind::Displaced) {
        displace_triangle(triangle_detail::displaced(mesh, place.triangle), surfaces.subvoxel_size,
                          mesh.displacement, widener.box(), surfaces.height_of(mesh), widener,
                          scratch);
    } else {
        const std::array<std::uint32_t, 3> corner = mesh.triangles[place.triangle];
        Vec3d p[3];
        for (std::size_t v = 0; v < 3; ++v) {
            p[v] = to_lattice(mesh.positions[corner[v]], surfaces.subvoxel_size);
        }
        widener.add(prepare_triangle(p[0], p[1], p[2]));
    }
}

/// Does the same for a triangle of any kind.
template <typename Slabs, typename Scratch>
HEDDLE_HD inline void widen_slabs(const SurfaceView& surfaces,
                                  TriangleId place,
                                  int subvoxels,
                                  Vec3i lo,
                                  Vec3i hi,
                                  const Slabs& slabs,
                                  Scratch&& scratch) {
    if (surfaces.meshes[place.mesh].kind == SurfaceKind::Displaced) {
        widen_slabs<SurfaceKind::Displaced>(surfaces, place, subvoxels, lo, hi, slabs, scratch);
    } else {
        widen_slabs<SurfaceKind::Constant>(surfaces, place, subvoxels, lo, hi, slabs, scratch);
    }
}

} // namespace heddle
