// No include guard: included once for each instruction set, HEDDLE_ISA.
// Directions of as many thin chords as there are lanes into the voxels that their centrelines pass.

namespace heddle::HEDDLE_ISA {

/// A chord a lane, as bodies over lanes have them; and what only writing their sums needs.
struct LaneChords : ChordLanes<Lanes> {
    alignas(32) float moment[kLanes][8]; ///< per chord: xx yy zz xy xz yz of its direction, 1, 0
    const std::uint32_t* color;
};

/// The block, as the lanes see it.
struct LaneBlock : BlockWords<Lanes> {
    const GatherTarget& target;
    bool plain; ///< direction sums only: no maps, no FitMode::Last

    explicit LaneBlock(const GatherTarget& t)
        : BlockWords<Lanes>(t.size), target(t), plain(!t.block.has_maps() && !t.paint.last) {}
    [[nodiscard]] VoxelSums& voxel(std::uint32_t cell) const { return target.block.voxel_at(cell); }
};

/// Pools the direction of chord `lane`, `weight` in units^2.
inline void
pool_lane(const LaneBlock& b, const LaneChords& k, int lane, std::uint32_t cell, float weight) {
    VoxelSums& voxel = b.voxel(cell);
    if (b.plain) {
        LobeSums& lobe = b.target.block.lobe(voxel, b.target.paint.material);
        add_scaled(&lobe, k.moment[lane], weight * kWeightScale);
    } else {
        FiberPaint paint = b.target.paint;
        paint.color = k.color[lane];
        pool_moment(b.target.block, voxel, k.moment[lane], weight, paint);
    }
}

inline void set_moments(LaneChords& k, const Real (&bend)[3]) {
    Real rows[8];
    chord_moments<Lanes>(k, bend, rows);
    store_transposed(rows, k.moment);
}

/// Pools every chord's direction, by the directed area 2 r length, in each voxel that its centreline
/// passes.
inline void pool_lanes(const LaneBlock& b, LaneChords& k) {
    const Real width = Real(2.0f) * k.radius;
    walk_voxels<Lanes>(b.target.units, k, [&](Mask some, Int word, Real length) {
        const std::uint32_t hits = (some & b.holds(word)).bits();
        if (hits == 0) return;
        alignas(32) std::int32_t cell[kLanes];
        alignas(32) float weight[kLanes];
        LaneBlock::cell(word).store(cell);
        // a sliver counts as much as a graze: enough to name a direction
        max(width * length, Real(kGrazeWeight)).store(weight);
        for (std::uint32_t m = hits; m != 0; m &= m - 1) {
            const int l = std::countr_zero(m);
            pool_lane(b, k, l, static_cast<std::uint32_t>(cell[l]), weight[l]);
        }
    });
}

} // namespace heddle::HEDDLE_ISA
