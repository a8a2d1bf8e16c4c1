#pragma once

#include <heddle/voxel/accumulator.h>
#include <heddle/voxel/surface_sample.h>
#include <heddle/voxel/triangle_scan.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace heddle {

/// What was done for some triangles.
struct TriangleWork {
    std::int64_t hits = 0;    ///< centre lines met
    std::int64_t samples = 0; ///< times that normals and maps were read

    friend TriangleWork operator+(TriangleWork a, TriangleWork b) {
        return {a.hits + b.hits, a.samples + b.samples};
    }
};

/// Least weight of a hit, units^2: a voxel that a surface passes edge-on still gets its direction.
/// It adds at most a thousandth to what the other axes weigh.
constexpr double kLeastWeight = 1.0 / 1024.0;

/// A direction's second moment times a weight, in fixed point.
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

/// The weights of a triangle's hits along each axis, units^2 x kWeightScale.
inline std::array<float, 3> hit_weights(Vec3d normal, const LatticeUnits& units) {
    std::array<float, 3> weights{};
    for (int axis = 0; axis < 3; ++axis) {
        const double area = hit_weight(normal, axis, to_double(units.edge));
        weights[static_cast<std::size_t>(axis)] =
            static_cast<float>(std::max(area, kLeastWeight)) * kWeightScale;
    }
    return weights;
}

/// Where the hits of one material in one block go.
class BlockTarget {
public:
    BlockTarget(BlockSums& block, int subvoxels, std::uint32_t material, bool last)
        : block_(block),
          base_(block.lo() * subvoxels),
          shift_(std::countr_zero(static_cast<unsigned>(subvoxels))),
          mask_(subvoxels - 1),
          material_(material),
          last_(last),
          with_maps_(block.has_maps()) {}

    [[nodiscard]] SubvoxelBox box() const { return {base_, block_.hi() * (mask_ + 1)}; }

    /// Sets the column's and the subvoxel's bit.
    HEDDLE_INLINE VoxelSums& mark(int axis, std::int32_t i, std::int32_t j, std::int32_t k) const {
        const int x = i - base_.x;
        const int y = j - base_.y;
        const int z = k - base_.z;
        VoxelSums& voxel = block_.voxel(x >> shift_, y >> shift_, z >> shift_);
        const int sx = x & mask_;
        const int sy = y & mask_;
        const int sz = z & mask_;
        const int a = axis == 0 ? sy : sx;
        const int b = axis == 2 ? sy : sz;
        voxel.column[static_cast<std::size_t>(axis)] |= std::uint64_t{1} << (b << shift_ | a);
        const int sub = (sx << shift_ | sy) << shift_ | sz;
        voxel.sub[static_cast<std::size_t>(sub >> 6)] |= std::uint64_t{1} << (sub & 63);
        return voxel;
    }

    /// Pools `count` hits of one share, whose maps all read 1. How many follow each other depends on
    /// the block: FitMode::Last, which forgets, counts one.
    HEDDLE_INLINE void pool(VoxelSums& voxel, const Share& share, std::int64_t count) const {
        LobeSums& lobe = open_lobe(voxel);
        if (last_) count = 1;
        for (std::size_t i = 0; i < 6; ++i) lobe.moment[i] += share.moment[i] * count;
        lobe.weight += share.weight * count;
        if (with_maps_) add_maps(voxel, lobe, SurfaceSample{}, share.weight * count);
    }

    /// Pools a shaded sample.
    /// @param weight  units^2 x kWeightScale
    HEDDLE_INLINE void pool(VoxelSums& voxel, const SurfaceSample& s, float weight) const {
        LobeSums& lobe = open_lobe(voxel);
        const std::array<std::int64_t, 6> moment = weighted_moment(s.normal, weight);
        const std::int64_t whole = round_weight(weight);
        for (std::size_t i = 0; i < 6; ++i) lobe.moment[i] += moment[i];
        lobe.weight += whole;
        if (with_maps_) add_maps(voxel, lobe, s, whole);
    }

private:
    HEDDLE_INLINE LobeSums& open_lobe(VoxelSums& voxel) const {
        LobeSums& lobe = block_.lobe(voxel, material_);
        if (last_) lobe = {.weight = 0, .material = lobe.material, .next = lobe.next};
        return lobe;
    }

    void add_maps(VoxelSums& voxel,
                  const LobeSums& lobe,
                  const SurfaceSample& s,
                  std::int64_t weight) const {
        MapSums& maps = block_.maps(voxel, lobe);
        if (last_) maps = {};
        maps.albedo[0] += weight * map_byte(s.albedo.x);
        maps.albedo[1] += weight * map_byte(s.albedo.y);
        maps.albedo[2] += weight * map_byte(s.albedo.z);
        maps.roughness += weight * map_byte(s.roughness);
        maps.metalness += weight * map_byte(s.metalness);
        maps.anisotropy += weight * map_byte(s.anisotropy);
        // by strength: where the map says isotropic, its direction says nothing
        const std::array<std::int64_t, 6> tangent =
            weighted_moment(s.tangent, static_cast<float>(weight) * s.anisotropy);
        for (std::size_t i = 0; i < 6; ++i) maps.tangent[i] += tangent[i];
    }

    BlockSums& block_;
    Vec3i base_; ///< the block's first subvoxel
    int shift_;  ///< log2 of the subvoxels per axis
    int mask_;
    std::uint32_t material_;
    bool last_;
    bool with_maps_;
};

/// A triangle of a block. It is set up at its first hit: many of a fine mesh have none.
struct BlockTriangle {
    const BlockTarget target;
    const SurfaceSampler& sampler;
    const LatticeUnits& units;
    const Mesh& mesh;
    std::size_t index;
};

/// The hits of a triangle whose normal is the same everywhere. Those of one voxel that follow each
/// other are pooled together.
class ConstantHits {
public:
    explicit ConstantHits(const BlockTriangle& triangle) : t_(triangle) {}

    HEDDLE_INLINE void
    operator()(int axis, std::int32_t i, std::int32_t j, std::int32_t k, float, float, float) {
        if (hits_++ == 0) set_up();
        VoxelSums& voxel = t_.target.mark(axis, i, j, k);
        if (&voxel != voxel_ || axis != axis_) {
            flush();
            voxel_ = &voxel;
            axis_ = axis;
            count_ = 0;
        }
        ++count_;
    }

    /// Pools the last run.
    HEDDLE_INLINE void flush() {
        if (count_ != 0) t_.target.pool(*voxel_, share_[static_cast<std::size_t>(axis_)], count_);
    }
    [[nodiscard]] TriangleWork work() const { return {hits_, 0}; }

private:
    void __attribute__((noinline)) set_up() {
        const TriangleSetup setup = t_.sampler.setup(t_.mesh, t_.index);
        const std::array<float, 3> weight = hit_weights(setup.normal, t_.units);
        for (std::size_t a = 0; a < 3; ++a) {
            share_[a] = {weighted_moment(setup.face_normal, weight[a]), round_weight(weight[a])};
        }
    }

    const BlockTriangle t_;
    std::array<Share, 3> share_;
    std::int64_t hits_ = 0;
    // the run so far
    VoxelSums* voxel_ = nullptr;
    int axis_ = 0;
    std::int64_t count_ = 0;
};

/// The hits of a triangle that is shaded: each by itself where alpha may cut it, else in runs of up
/// to TriangleSetup::run. What a run is must not depend on the block: its columns lie in one group of
/// so many, in one row, in one voxel.
class ShadedHits {
public:
    explicit ShadedHits(const BlockTriangle& triangle) : t_(triangle) {}

    HEDDLE_INLINE void operator()(
        int axis, std::int32_t i, std::int32_t j, std::int32_t k, float b0, float b1, float b2) {
        if (hits_++ == 0) set_up();
        if (setup_.run == 1) {
            pool_covered({axis, i, j, k, b0, b1, b2});
            return;
        }
        VoxelSums& voxel = t_.target.mark(axis, i, j, k);
        const std::int32_t group = (axis == 0 ? j : axis == 1 ? k : i) & -setup_.run;
        const std::int32_t row = axis == 0 ? k : axis == 1 ? i : j;
        if (&voxel != voxel_ || axis != axis_ || group != group_ || row != row_) {
            flush();
            voxel_ = &voxel;
            axis_ = axis;
            group_ = group;
            row_ = row;
            at_ = {i, j, k};
            first_b1_ = b1;
            first_b2_ = b2;
            count_ = 0;
        }
        last_b1_ = b1;
        last_b2_ = b2;
        ++count_;
    }

    /// Pools the last run.
    void __attribute__((noinline)) flush() {
        if (count_ == 0) return;
        ++samples_;
        SurfaceHit middle{axis_, at_.x, at_.y, at_.z};
        middle.b1 = 0.5f * (first_b1_ + last_b1_);
        middle.b2 = 0.5f * (first_b2_ + last_b2_);
        middle.b0 = std::max(0.0f, 1.0f - middle.b1 - middle.b2);
        t_.target.pool(*voxel_, t_.sampler.sample(setup_, middle),
                       weight_[static_cast<std::size_t>(axis_)] * static_cast<float>(count_));
    }
    [[nodiscard]] TriangleWork work() const { return {hits_, samples_}; }

private:
    void __attribute__((noinline)) set_up() {
        setup_ = t_.sampler.setup(t_.mesh, t_.index);
        weight_ = hit_weights(setup_.normal, t_.units);
    }

    void __attribute__((noinline)) pool_covered(const SurfaceHit& hit) {
        ++samples_;
        const SurfaceSample s = t_.sampler.sample(setup_, hit);
        if (!s.covered) return;
        t_.target.pool(t_.target.mark(hit.axis, hit.i, hit.j, hit.k), s,
                       weight_[static_cast<std::size_t>(hit.axis)]);
    }

    const BlockTriangle t_;
    TriangleSetup setup_;
    std::array<float, 3> weight_{};
    std::int64_t hits_ = 0;
    std::int64_t samples_ = 0;
    // the run so far
    VoxelSums* voxel_ = nullptr;
    int axis_ = 0;
    std::int32_t group_ = 0;
    std::int32_t row_ = 0;
    Vec3i at_;
    float first_b1_ = 0.0f, first_b2_ = 0.0f, last_b1_ = 0.0f, last_b2_ = 0.0f;
    std::int64_t count_ = 0;
};

} // namespace heddle
