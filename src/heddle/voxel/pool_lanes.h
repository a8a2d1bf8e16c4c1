// No include guard: included once for each instruction set, HEDDLE_ISA.
// Directions of eight thin chords into the voxels that their centrelines pass.

namespace heddle::HEDDLE_ISA {

/// A voxel index as one number, x << 20 | y << 10 | z: adding adds all three, and a coordinate that
/// leaves 0 .. 31 shows in its upper bits. Enough for what lies within 400 voxels of the block.
constexpr int kFieldShift[3] = {20, 10, 0};
constexpr std::int32_t kFieldOverflow =
    static_cast<std::int32_t>(0xfe000000u) | 0x3e0 << 10 | 0x3e0;

/// Eight chords, units; and what has been found of them.
struct ChordLanes {
    Real start[3], dir[3];
    Real length, before, after, radius;
    Int anchor;    ///< voxel word, relative to the block's lo
    Mask active;   ///< may meet the block
    Int passed[4]; ///< the first voxel words that the centreline passes
    alignas(
        32) float moment[kLanes][kLanes]; ///< per chord: xx yy zz xy xz yz of its direction, 1, 0
    const std::uint32_t* color;
};

/// The block, as eight lanes see it.
struct LaneBlock {
    const GatherTarget& target;
    Int spare;  ///< 32 less the block's size, as a voxel word
    bool plain; ///< direction sums only: no maps, no FitMode::Last

    explicit LaneBlock(const GatherTarget& t)
        : target(t), plain(!t.block.has_maps() && !t.paint.last) {
        std::uint32_t word = 0;
        for (int a = 0; a < 3; ++a) {
            word += static_cast<std::uint32_t>(kBlockVoxels - t.size[a]) << kFieldShift[a];
        }
        spare = Int(static_cast<std::int32_t>(word));
    }
    [[nodiscard]] Mask holds(Int word) const {
        return ((word | (word + spare)) & Int(kFieldOverflow)) == Int(0);
    }
    /// Number of the voxel in the block's table.
    static Int cell(Int word) {
        return (word & Int(31)) | ((word >> 5) & Int(31 << 5)) | ((word >> 10) & Int(31 << 10));
    }
    [[nodiscard]] VoxelSums& voxel(std::uint32_t cell) const { return target.block.voxel_at(cell); }
};

/// Pools the direction of chord `lane`, `weight` in units^2.
inline void
pool_lane(const LaneBlock& b, const ChordLanes& k, int lane, std::uint32_t cell, float weight) {
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

/// Second moment of each chord's directions, a row a chord: the direction turns by `bend` along it, so
/// over the chord d d^T + bend bend^T / 12, brought back to trace 1.
inline void set_moments(ChordLanes& k, const Real (&bend)[3]) {
    const Real(&d)[3] = k.dir;
    const Real bend2 = bend[0] * bend[0] + bend[1] * bend[1] + bend[2] * bend[2];
    const Real inv = Real(1.0f) / (Real(1.0f) + bend2 * Real(1.0f / 12.0f));
    const Real part = inv * Real(1.0f / 12.0f);
    const auto moment = [&](int a, int b) { return d[a] * d[b] * inv + bend[a] * bend[b] * part; };
    Real rows[kLanes] = {moment(0, 0), moment(1, 1), moment(2, 2), moment(0, 1),
                         moment(0, 2), moment(1, 2), Real(1.0f),   Real(0.0f)};
    transpose(rows);
    for (int l = 0; l < kLanes; ++l) rows[l].store(k.moment[l]);
}

/// Pools every chord's direction, by the directed area 2 r length, in each voxel that its centreline
/// passes.
inline void pool_lanes(const LaneBlock& b, ChordLanes& k) {
    constexpr float kFar = 1e30f;
    const LatticeUnits& u = b.target.units;
    Real next[3]; // axial coordinate at which the centreline leaves its voxel
    Real gap[3];
    Int step[3];
    Int word = k.anchor;
    for (int a = 0; a < 3; ++a) {
        const Real v0 = floor(k.start[a] * Real(u.inv_voxel[a]));
        const Mask forward = Real(0.0f) < k.dir[a];
        const Mask flat = abs(k.dir[a]) < Real(1e-9f);
        const Real inv = Real(1.0f) / k.dir[a];
        const Real border = (v0 + select(forward, Real(1.0f), Real(0.0f))) * Real(u.voxel[a]);
        next[a] = select(flat, Real(kFar), (border - k.start[a]) * inv);
        gap[a] = select(flat, Real(kFar), Real(u.voxel[a]) * abs(inv));
        step[a] = select(forward, Int(1), Int(-1)) << kFieldShift[a];
        word = word + (to_int(v0) << kFieldShift[a]);
    }
    const Real width = Real(2.0f) * k.radius;
    Real from(0.0f);
    for (Int& passed : k.passed) passed = Int(-1); // in no block
    Mask open = k.active;
    for (int part = 0; open.bits() != 0; ++part) {
        const Real border = min(min(next[0], next[1]), next[2]);
        const Real to = min(border, k.length);
        const Mask some = from < to;
        if (part < 4) k.passed[part] = select(some, word, Int(-1));
        const std::uint32_t hits = (some & open & b.holds(word)).bits();
        if (hits != 0) {
            alignas(32) std::int32_t cell[kLanes];
            alignas(32) float weight[kLanes];
            LaneBlock::cell(word).store(cell);
            // a sliver counts as much as a graze: enough to name a direction
            max(width * (to - from), Real(kGrazeWeight)).store(weight);
            for (std::uint32_t m = hits; m != 0; m &= m - 1) {
                const int l = std::countr_zero(m);
                pool_lane(b, k, l, static_cast<std::uint32_t>(cell[l]), weight[l]);
            }
        }
        open = open & (border < k.length);
        for (int a = 0; a < 3; ++a) {
            const Mask crossed = next[a] <= border;
            word = word + select(crossed, step[a], Int(0));
            next[a] = next[a] + select(crossed, gap[a], Real(0.0f));
        }
        from = to;
    }
}

} // namespace heddle::HEDDLE_ISA
