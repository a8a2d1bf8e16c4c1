#pragma once

#include <heddle/voxelize/chord/chord_body.h>
#include <heddle/voxelize/fiber/fiber_sums.h>

#include <bit>
#include <cstdint>

// Pools the directions of thin chords in the voxels that their centrelines cross, as many at once
// as the lanes L have (lanes_*.h).

namespace heddle::lane_detail {

/// One chord per lane, and what is needed to write their sums.
template <typename L>
struct LaneChords : ChordLanes<L> {
    alignas(32) float moment[L::kLanes][8]; ///< per chord: xx yy zz xy xz yz of its direction, 1, 0
    const std::uint32_t* color;
};

/// The block that the chords are added to.
template <typename L>
struct LaneBlock : BlockWords<L> {
    const GatherTarget& target;
    bool plain; ///< direction sums only: no maps, no FitMode::Last

    explicit LaneBlock(const GatherTarget& t)
        : BlockWords<L>(t.size), target(t), plain(!t.block.has_maps() && !t.paint.last) {}
    [[nodiscard]] VoxelSums& voxel(std::uint32_t cell) const { return target.block.voxel_at(cell); }
};

/// Pools the direction of chord `lane`, with a weight in units^2.
template <typename L>
inline void pool_lane(
    const LaneBlock<L>& b, const LaneChords<L>& k, int lane, std::uint32_t cell, float weight) {
    VoxelSums& voxel = b.voxel(cell);
    if (b.plain) {
        LobeSums& lobe = b.target.block.lobe(voxel, b.target.paint.material);
        L::add_scaled(&lobe, k.moment[lane], weight * kWeightScale);
    } else {
        FiberPaint paint = b.target.paint;
        paint.color = k.color[lane];
        pool_moment(b.target.block, voxel, k.moment[lane], weight, paint);
    }
}

template <typename L>
inline void set_moments(LaneChords<L>& k, const typename L::Real (&bend)[3]) {
    typename L::Real rows[8];
    chord_moments<L>(k, bend, rows);
    store_transposed(rows, k.moment);
}

/// Pools every chord's direction, weighted by the directed area 2 r length, in each voxel that its
/// centreline crosses.
template <typename L>
inline void pool_lanes(const LaneBlock<L>& b, LaneChords<L>& k) {
    using Real = typename L::Real;
    using Int = typename L::Int;
    using Mask = typename L::Mask;
    const Real width = Real(2.0f) * k.radius;
    for_each_chord_voxel<L>(b.target.units, k, [&](Mask some, Int word, Real length) {
        const std::uint32_t hits = (some & b.holds(word)).bits();
        if (hits == 0) return;
        alignas(32) std::int32_t cell[L::kLanes];
        alignas(32) float weight[L::kLanes];
        LaneBlock<L>::cell(word).store(cell);
        // short parts have at least the weight of a grazed voxel, so that the voxel has a direction
        max(width * length, Real(kGrazeWeight)).store(weight);
        for (std::uint32_t m = hits; m != 0; m &= m - 1) {
            const int l = std::countr_zero(m);
            pool_lane(b, k, l, static_cast<std::uint32_t>(cell[l]), weight[l]);
        }
    });
}

} // namespace heddle::lane_detail
