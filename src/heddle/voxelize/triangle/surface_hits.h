#pragma once

#include <heddle/base/platform.h>
#include <heddle/surface/surface_op.h>
#include <heddle/voxel/lattice_units.h>
#include <heddle/voxel/sum_fields.h>
#include <heddle/voxelize/block/accumulator.h>
#include <heddle/voxelize/triangle/triangle_scan.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace heddle {

// Adds a triangle's hits to the sums of a block's voxels, by the same code on host and device.
// `Sums` is the sums of one block for the triangle's material. It has the functions
//
//   void or_column(int cell, int axis, std::uint64_t bits)
//   void or_subvoxels(int cell, int word, std::uint64_t bits)      see VoxelSums
//   void add_lobe(int cell, int field, std::int64_t x)             see LobeField
//   void add_map(int cell, int field, std::int64_t x)              see MapField
//   bool has_maps()
//   bool forget(int cell)    optional, for FitMode::Last: empties the lobe; false: other modes
//
// cell = (x 32 + y) 32 + z of a voxel relative to the block's lo. or_column is called first; the
// calls that follow have the same cell, and each such cell gets a weight.

/// Counts of the work for some triangles.
struct TriangleWork {
    std::int64_t hits = 0;    ///< centre lines that were hit
    std::int64_t samples = 0; ///< evaluations of normals and maps

    friend HEDDLE_HD TriangleWork operator+(TriangleWork a, TriangleWork b) {
        return {a.hits + b.hits, a.samples + b.samples};
    }
};

/// Smallest weight of a hit, units^2, so that a voxel that a surface crosses edge-on gets a
/// direction. It adds at most a thousandth to the weight of the other axes.
constexpr double kMinWeight = 1.0 / 1024.0;

/// The second moment of a direction times a weight, in fixed point.
struct Share {
    std::array<std::int64_t, 6> moment{};
    std::int64_t weight = 0;
};

HEDDLE_INLINE std::int64_t round_weight(float x) {
    return static_cast<std::int64_t>(x + (x < 0.0f ? -0.5f : 0.5f));
}

HEDDLE_INLINE std::int64_t map_byte(float x) {
    return static_cast<std::int64_t>(x * 255.0f + 0.5f);
}

/// @param weight  units^2 x kWeightScale
HEDDLE_INLINE std::array<std::int64_t, 6> weighted_moment(Vec3f d, float weight) {
    return {round_weight(d.x * d.x * weight), round_weight(d.y * d.y * weight),
            round_weight(d.z * d.z * weight), round_weight(d.x * d.y * weight),
            round_weight(d.x * d.z * weight), round_weight(d.y * d.z * weight)};
}

/// Returns the weight of a triangle's hits along each axis, units^2 x kWeightScale.
HEDDLE_HD inline std::array<float, 3> hit_weights(Vec3d normal, const LatticeUnits& units) {
    std::array<float, 3> weights{};
    for (int axis = 0; axis < 3; ++axis) {
        const double area = hit_weight(normal, axis, to_double(units.edge));
        weights[static_cast<std::size_t>(axis)] =
            static_cast<float>(area < kMinWeight ? kMinWeight : area) * kWeightScale;
    }
    return weights;
}

/// Adds the hits of one material to the sums of one block.
template <typename Sums>
class BlockTarget {
public:
    static constexpr bool kForgets = requires(Sums & s) { s.forget(0); };

    /// @param lo,hi  voxel range of the block, [lo, hi)
    HEDDLE_HD BlockTarget(Sums& sums, Vec3i lo, Vec3i hi, int subvoxels)
        : sums_(sums), base_(lo * subvoxels), end_(hi * subvoxels), mask_(subvoxels - 1) {
        for (shift_ = 0; 1 << shift_ < subvoxels;) ++shift_;
    }

    [[nodiscard]] HEDDLE_HD SubvoxelBox box() const { return {base_, end_}; }

    /// Returns the cell of the voxel that contains a subvoxel.
    [[nodiscard]] HEDDLE_INLINE int cell_of(std::int32_t i, std::int32_t j, std::int32_t k) const {
        const int x = i - base_.x;
        const int y = j - base_.y;
        const int z = k - base_.z;
        return ((x >> shift_) * kBlockVoxels + (y >> shift_)) * kBlockVoxels + (z >> shift_);
    }

    /// Sets the bits of the column and of the subvoxel.
    /// @param cell  cell_of(i, j, k)
    HEDDLE_INLINE void
    mark(int cell, int axis, std::int32_t i, std::int32_t j, std::int32_t k) const {
        const int x = i - base_.x;
        const int y = j - base_.y;
        const int z = k - base_.z;
        const int sx = x & mask_;
        const int sy = y & mask_;
        const int sz = z & mask_;
        const int a = axis == 0 ? sy : sx;
        const int b = axis == 2 ? sy : sz;
        sums_.or_column(cell, axis, std::uint64_t{1} << (b << shift_ | a));
        const int sub = (sx << shift_ | sy) << shift_ | sz;
        sums_.or_subvoxels(cell, sub >> 6, std::uint64_t{1} << (sub & 63));
    }

    /// Pools `count` hits with the same share and without maps. With FitMode::Last only one counts,
    /// as the length of a run depends on the block.
    HEDDLE_INLINE void pool(int cell, const Share& share, std::int64_t count) const {
        if constexpr (kForgets) count = sums_.forget(cell) ? 1 : count;
        add_share(cell, share, count);
        if (sums_.has_maps()) add_maps(cell, SurfaceSample{}, share.weight * count);
    }

    /// Pools a shaded sample.
    /// @param weight  units^2 x kWeightScale
    HEDDLE_INLINE void pool(int cell, const SurfaceSample& s, float weight) const {
        if constexpr (kForgets) sums_.forget(cell);
        const Share share{weighted_moment(s.normal, weight), round_weight(weight)};
        add_share(cell, share, 1);
        if (sums_.has_maps()) add_maps(cell, s, share.weight);
    }

private:
    HEDDLE_INLINE void add_share(int cell, const Share& share, std::int64_t count) const {
        for (int i = 0; i < 6; ++i) {
            sums_.add_lobe(cell, LobeField::Moment + i,
                           share.moment[static_cast<std::size_t>(i)] * count);
        }
        sums_.add_lobe(cell, LobeField::Weight, share.weight * count);
    }

    HEDDLE_INLINE void add_maps(int cell, const SurfaceSample& s, std::int64_t weight) const {
        // weighted by strength: the direction of an isotropic texel has no meaning
        const std::array<std::int64_t, 6> tangent =
            weighted_moment(s.tangent, static_cast<float>(weight) * s.anisotropy);
        for (int i = 0; i < 6; ++i) {
            sums_.add_map(cell, MapField::Tangent + i, tangent[static_cast<std::size_t>(i)]);
        }
        for (int i = 0; i < 3; ++i) {
            sums_.add_map(cell, MapField::Albedo + i, weight * map_byte(s.albedo[i]));
        }
        sums_.add_map(cell, MapField::Roughness, weight * map_byte(s.roughness));
        sums_.add_map(cell, MapField::Metalness, weight * map_byte(s.metalness));
        sums_.add_map(cell, MapField::Anisotropy, weight * map_byte(s.anisotropy));
    }

    Sums& sums_;
    Vec3i base_, end_; ///< the block's subvoxels
    int shift_;        ///< log2 of the subvoxels per axis
    int mask_;
};

/// A triangle of a block. It is set up at its first hit, since many triangles of a fine mesh have
/// none.
template <typename Sums>
struct BlockTriangle {
    const BlockTarget<Sums> target;
    const SurfaceView& surfaces;
    const LatticeUnits& units;
    TriangleId place;

    [[nodiscard]] HEDDLE_HD const MeshView& mesh() const { return surfaces.meshes[place.mesh]; }
    [[nodiscard]] HEDDLE_HD TriangleSetup set_up() const {
        return set_up_triangle(surfaces, mesh(), place.triangle);
    }
};

/// The hits of a triangle with a constant normal. Consecutive hits in one voxel are pooled
/// together.
template <typename Sums>
class ConstantHits {
public:
    HEDDLE_HD explicit ConstantHits(const BlockTriangle<Sums>& triangle) : t_(triangle) {}

    HEDDLE_INLINE void
    operator()(int axis, std::int32_t i, std::int32_t j, std::int32_t k, float, float, float) {
        if (hits_++ == 0) set_up();
        const int cell = t_.target.cell_of(i, j, k);
        if (cell != cell_ || axis != axis_) {
            flush();
            cell_ = cell;
            axis_ = axis;
            count_ = 0;
        }
        t_.target.mark(cell, axis, i, j, k);
        ++count_;
    }

    /// Pools the last run.
    HEDDLE_INLINE void flush() {
        if (count_ != 0) t_.target.pool(cell_, share_[static_cast<std::size_t>(axis_)], count_);
    }
    [[nodiscard]] HEDDLE_HD TriangleWork work() const { return {hits_, 0}; }

private:
    HEDDLE_COLD void set_up() {
        const TriangleSetup setup = t_.set_up();
        const std::array<float, 3> weight = hit_weights(setup.normal, t_.units);
        for (std::size_t a = 0; a < 3; ++a) {
            share_[a] = {weighted_moment(setup.face_normal, weight[a]), round_weight(weight[a])};
        }
    }

    const BlockTriangle<Sums> t_;
    std::array<Share, 3> share_;
    std::int64_t hits_ = 0;
    // the run so far
    int cell_ = -1;
    int axis_ = 0;
    std::int64_t count_ = 0;
};

/// The hits of a shaded triangle. With alpha they are sampled one by one, else in runs of up to
/// TriangleSetup::run. Runs must not depend on the block: the columns of a run are in one aligned
/// group of that size, in one row and in one voxel.
template <typename Sums>
class ShadedHits {
public:
    HEDDLE_HD explicit ShadedHits(const BlockTriangle<Sums>& triangle) : t_(triangle) {}

    HEDDLE_INLINE void operator()(
        int axis, std::int32_t i, std::int32_t j, std::int32_t k, float b0, float b1, float b2) {
        if (hits_++ == 0) set_up();
        if (setup_.run == 1) {
            pool_covered({axis, i, j, k, b0, b1, b2});
            return;
        }
        const int cell = t_.target.cell_of(i, j, k);
        const std::int32_t group = (axis == 0 ? j : axis == 1 ? k : i) & -setup_.run;
        const std::int32_t row = axis == 0 ? k : axis == 1 ? i : j;
        if (cell != cell_ || axis != axis_ || group != group_ || row != row_) {
            flush();
            cell_ = cell;
            axis_ = axis;
            group_ = group;
            row_ = row;
            at_ = {i, j, k};
            first_b1_ = b1;
            first_b2_ = b2;
            count_ = 0;
        }
        t_.target.mark(cell, axis, i, j, k);
        last_b1_ = b1;
        last_b2_ = b2;
        ++count_;
    }

    /// Pools the last run.
    HEDDLE_COLD void flush() {
        if (count_ == 0) return;
        ++samples_;
        SurfaceHit middle{axis_, at_.x, at_.y, at_.z};
        middle.b1 = 0.5f * (first_b1_ + last_b1_);
        middle.b2 = 0.5f * (first_b2_ + last_b2_);
        middle.b0 = std::max(0.0f, 1.0f - middle.b1 - middle.b2);
        t_.target.pool(cell_, sample_at(t_.surfaces.seed, setup_, middle),
                       weight_[static_cast<std::size_t>(axis_)] * static_cast<float>(count_));
    }
    [[nodiscard]] HEDDLE_HD TriangleWork work() const { return {hits_, samples_}; }

private:
    HEDDLE_COLD void set_up() {
        setup_ = t_.set_up();
        weight_ = hit_weights(setup_.normal, t_.units);
    }

    HEDDLE_COLD void pool_covered(const SurfaceHit& hit) {
        ++samples_;
        const SurfaceSample s = sample_at(t_.surfaces.seed, setup_, hit);
        if (!s.covered) return;
        const int cell = t_.target.cell_of(hit.i, hit.j, hit.k);
        t_.target.mark(cell, hit.axis, hit.i, hit.j, hit.k);
        t_.target.pool(cell, s, weight_[static_cast<std::size_t>(hit.axis)]);
    }

    const BlockTriangle<Sums> t_;
    TriangleSetup setup_;
    std::array<float, 3> weight_{};
    std::int64_t hits_ = 0;
    std::int64_t samples_ = 0;
    // the run so far
    int cell_ = -1;
    int axis_ = 0;
    std::int32_t group_ = 0;
    std::int32_t row_ = 0;
    Vec3i at_;
    float first_b1_ = 0.0f, first_b2_ = 0.0f, last_b1_ = 0.0f, last_b2_ = 0.0f;
    std::int64_t count_ = 0;
};

} // namespace heddle
