// No include guard: included once for each instruction set, HEDDLE_ISA.
// The columns that eight thin chords meet, along one axis.

namespace heddle::HEDDLE_ISA {

/// Eight thin chords seen along one axis. `major` is that other axis along which a chord passes more
/// columns, `minor` the last one. What the test needs is linear in the column's indices (i, j) along
/// them.
struct LaneView {
    Mask swapped;                    ///< major is the later of the two other axes
    Real first, last;                ///< columns along major
    Real strip, strip_i;             ///< lower edge of the body at column i, in column indices j
    Real width;                      ///< of the body along minor, in columns
    Real across, across_i, across_j; ///< distance from the axis x sin, units
    Real axial, axial_i, axial_j;    ///< axial coordinate nearest to the centre line, units
    Real r2s2, inv_s2;               ///< (radius sin)^2, 1 / sin^2
    Real o_depth, d_depth;           ///< depth = o_depth + axial d_depth, units
    Real axial_enter, inv_d_depth;   ///< the end of the axial range at which depth is least
    Real depth_range;                ///< depth between the ends, where the flat ends cut
};

template <int kDepth>
inline LaneView view_along(const ChordLanes& k, const LatticeUnits& u) {
    constexpr int kA = kDepth == 0 ? 1 : 0;
    constexpr int kB = kDepth == 2 ? 1 : 2;
    LaneView v;
    v.swapped = abs(k.dir[kA] * Real(u.inv_edge[kA])) < abs(k.dir[kB] * Real(u.inv_edge[kB]));
    const auto pick_axis = [&](Real a, Real b, Real& major, Real& minor) {
        major = select(v.swapped, b, a);
        minor = select(v.swapped, a, b);
    };
    Real dM, dm, oM, om, eM, em, inv_eM, inv_em;
    pick_axis(k.dir[kA], k.dir[kB], dM, dm);
    pick_axis(k.start[kA], k.start[kB], oM, om);
    pick_axis(Real(u.edge[kA]), Real(u.edge[kB]), eM, em);
    pick_axis(Real(u.inv_edge[kA]), Real(u.inv_edge[kB]), inv_eM, inv_em);
    const Real lo = Real(0.0f) - k.before;
    const Real hi = k.length + k.after;
    const Real p0 = oM + dM * lo;
    const Real p1 = oM + dM * hi;
    v.first = ceil((min(p0, p1) - k.radius) * inv_eM - Real(0.5f));
    v.last = floor((max(p0, p1) + k.radius) * inv_eM - Real(0.5f));
    // Closer to the axis than 1/1000 the chord is taken as 1/1000 off it: a turn of less than 1/100
    // subvoxel over a voxel's depth, and every quotient below stays finite.
    Real s2 = dM * dM + dm * dm;
    const Mask along = s2 < Real(1e-6f);
    dM = select(along, Real(1e-3f), dM);
    dm = select(along, Real(0.0f), dm);
    s2 = max(s2, Real(1e-6f));
    v.inv_s2 = Real(1.0f) / s2;
    v.r2s2 = k.radius * k.radius * s2;
    const Real inv_major = Real(1.0f) / dM;
    const Real qM = Real(0.5f) * eM - oM; // of column (0, 0)
    const Real qm = Real(0.5f) * em - om;
    const Real slope = dm * inv_major * inv_em;
    // a hair wider than the body, so that rounding loses no column; the test itself is exact
    const Real half_width = k.radius * abs(sqrt(s2) * inv_major) * inv_em + Real(0.001f);
    v.width = half_width + half_width;
    v.strip = qM * slope - qm * inv_em - half_width;
    v.strip_i = eM * slope;
    v.across = qM * dm - qm * dM;
    v.across_i = eM * dm;
    v.across_j = (Real(0.0f) - em) * dM;
    v.axial = (qM * dM + qm * dm) * v.inv_s2;
    v.axial_i = eM * dM * v.inv_s2;
    v.axial_j = em * dm * v.inv_s2;
    v.o_depth = k.start[kDepth];
    v.d_depth = k.dir[kDepth];
    v.inv_d_depth = Real(1.0f) / select(Real(1e-6f) < abs(v.d_depth), v.d_depth, Real(1e-6f));
    v.axial_enter = select(Real(0.0f) < v.inv_d_depth, lo, hi);
    v.depth_range = abs(v.inv_d_depth) * (hi - lo);
    return v;
}

/// Columns that may be met: the chord's lane and the column's indices along major and minor.
struct Candidates {
    static constexpr int kMost = 256;
    int count = 0;
    alignas(32) std::int32_t lane[kMost + kLanes];
    alignas(32) float i[kMost + kLanes], j[kMost + kLanes];

    void add(std::uint32_t mask, Real column_i, Real column_j) {
        const Int order = set_lanes(mask);
        order.store(lane + count);
        pick(column_i, order).store(i + count);
        pick(column_j, order).store(j + count);
        count += std::popcount(mask);
    }
};

/// Sets a column's bit in each hit lane's voxel, and for z a run of its subvoxels: for all lanes where
/// most hit, the others in voxels that nobody reads (no branch to guess wrong), else hits first and for
/// half as many.
/// @param packed  cell | bit << 16
/// @param run     first subvoxel's bit | length << 9
template <int kDepth>
inline void set_columns(const LaneBlock& b, Mask hits, Int packed, Int run) {
    alignas(32) std::int32_t cells[kLanes];
    alignas(32) std::int32_t runs[kLanes];
    packed = select(hits, packed, Int::iota() + Int(BlockSums::kVoxels));
    const std::uint32_t mask = hits.bits();
    const bool few = std::popcount(mask) <= kLanes / 2;
    if (few) { // lane 0 fills up: setting its bits again changes nothing
        const Int order = set_lanes(mask);
        packed = pick(packed, order);
        run = pick(run, order);
    }
    packed.store(cells);
    run.store(runs);
    const auto set = [&](int l) {
        const auto p = static_cast<std::uint32_t>(cells[l]);
        VoxelSums& voxel = b.voxel(p & 0xffff);
        voxel.column[kDepth] |= std::uint64_t{1} << (p >> 16);
        if constexpr (kDepth == 2) {
            const auto r = static_cast<std::uint32_t>(runs[l]);
            voxel.sub[(r >> 6) & 7] |= ((std::uint64_t{1} << (r >> 9)) - 1) << (r & 63);
        }
    };
    for (int l = 0; l < kLanes / 2; ++l) set(l);
    if (few) return;
    for (int l = kLanes / 2; l < kLanes; ++l) set(l);
}

/// Names a direction in voxels that chords meet beside their centrelines.
inline void graze(const LaneBlock& b, const ChordLanes& k, std::uint32_t hits, Int cell, Int lane) {
    alignas(32) std::int32_t cells[kLanes];
    alignas(32) std::int32_t lanes[kLanes];
    cell.store(cells);
    lane.store(lanes);
    for (; hits != 0; hits &= hits - 1) {
        const int l = std::countr_zero(hits);
        pool_lane(b, k, lanes[l], static_cast<std::uint32_t>(cells[l]), kGrazeWeight);
    }
}

/// Tests the candidates and sets what they meet.
template <int kDepth>
inline void mark_candidates(const LaneBlock& b,
                            const ChordLanes& k,
                            const LaneView& v,
                            const Candidates& list) {
    constexpr int kA = kDepth == 0 ? 1 : 0;
    constexpr int kB = kDepth == 2 ? 1 : 2;
    constexpr int kC = kFieldShift[kDepth];
    const LatticeUnits& u = b.target.units;
    const int shift = b.target.shift;
    const Int low((1 << shift) - 1);
    const Real inv_voxel(u.inv_voxel[kDepth]);
    for (int at = 0; at < list.count; at += kLanes) {
        const Int lane = Int::load(list.lane + at);
        const Real i = Real::load(list.i + at);
        const Real j = Real::load(list.j + at);
        const Real across =
            pick(v.across, lane) + pick(v.across_i, lane) * i + pick(v.across_j, lane) * j;
        const Real axial =
            pick(v.axial, lane) + pick(v.axial_i, lane) * i + pick(v.axial_j, lane) * j;
        const Real disc = pick(v.r2s2, lane) - across * across;
        const Real center = pick(v.o_depth, lane) + axial * pick(v.d_depth, lane);
        const Real half = sqrt(max(disc, Real(0.0f))) * pick(v.inv_s2, lane);
        const Real end0 = center + (pick(v.axial_enter, lane) - axial) * pick(v.inv_d_depth, lane);
        const Real end1 = end0 + pick(v.depth_range, lane);
        const Real enter = max(center - half, end0);
        const Real leave = min(center + half, end1);
        const Mask hit =
            (Real(0.0f) < disc) & (enter < leave) & (Int(list.count - at) > Int::iota());
        if (hit.bits() == 0) continue;

        const Int column_i = to_int(i);
        const Int column_j = to_int(j);
        const Mask swapped = pick(v.swapped, lane);
        const Int ia = select(swapped, column_j, column_i);
        const Int ib = select(swapped, column_i, column_j);
        const Int base = pick(k.anchor, lane) + ((ia >> shift) << kFieldShift[kA]) +
                         ((ib >> shift) << kFieldShift[kB]);
        const Int bit = (((ib & low) << shift) | (ia & low)) << 16;
        Int depth = to_int(floor(enter * inv_voxel));
        const Int last = to_int(floor(leave * inv_voxel));
        Int z0(0), z1(0), row(0);
        if constexpr (kDepth == 2) {
            const Real inv_edge(u.inv_edge[2]);
            z0 = to_int(ceil(enter * inv_edge - Real(0.5f)));
            z1 = to_int(floor(leave * inv_edge - Real(0.5f)));
            row = (((ia & low) << shift) | (ib & low)) << shift;
        }
        for (Mask open = hit; open.bits() != 0;) {
            const Int word = base + (depth << kC);
            const Mask here = open & b.holds(word);
            if (here.bits() != 0) {
                const Int cell = LaneBlock::cell(word);
                Int run(0);
                if constexpr (kDepth == 2) { // the part of z0 .. z1 in this voxel
                    const Int from = max(z0, depth << shift);
                    const Int to = min(z1, (depth << shift) + low);
                    run = row | (from & low) | (max(to - from + Int(1), Int(0)) << 9);
                }
                set_columns<kDepth>(b, here, cell | bit, run);
                const Mask passed =
                    (word == pick(k.passed[0], lane)) | (word == pick(k.passed[1], lane)) |
                    (word == pick(k.passed[2], lane)) | (word == pick(k.passed[3], lane));
                if (const std::uint32_t grazed = without(here, passed).bits(); grazed != 0) {
                    graze(b, k, grazed, cell, lane);
                }
            }
            open = open & (last > depth);
            depth = depth + Int(1);
        }
    }
}

/// Sets the columns along axis kDepth that the chords meet, and for z the subvoxels.
template <int kDepth>
inline void mark_columns(const LaneBlock& b, const ChordLanes& k) {
    const LaneView v = view_along<kDepth>(k, b.target.units);
    Candidates list;
    const auto flush = [&] {
        Int(0).store(list.lane + list.count); // the last eight are read whole
        Real(0.0f).store(list.i + list.count);
        Real(0.0f).store(list.j + list.count);
        mark_candidates<kDepth>(b, k, v, list);
        list.count = 0;
    };
    // columns along minor that can lie in the strip: alike in all batches, so no branch is guessed wrong
    int tries = 1;
    while ((k.active & (Real(static_cast<float>(tries)) < v.width)).bits() != 0) ++tries;
    Real i = v.first;
    for (Mask row = k.active & (i <= v.last); row.bits() != 0; row = row & (i <= v.last)) {
        const Real edge = v.strip + v.strip_i * i;
        const Real end = edge + v.width;
        Real j = ceil(edge);
        for (int t = 0; t < tries; ++t) {
            list.add((row & (j <= end)).bits(), i, j);
            if (list.count > Candidates::kMost - kLanes) flush();
            j = j + Real(1.0f);
        }
        i = i + Real(1.0f);
    }
    if (list.count > 0) flush();
}

/// Chords whose round body comes into the block.
inline Mask
meets_block(const LaneBlock& b, const ChordLanes& k, const ChordArrays& chords, int at) {
    constexpr float kMargin = 0.01f; // of a voxel: rounding by the block's place decides nothing
    const LatticeUnits& u = b.target.units;
    Mask active = Real(0.0f) < k.length;
    for (int a = 0; a < 3; ++a) {
        const Real p0 = k.start[a] - k.dir[a] * k.before;
        const Real p1 = k.start[a] + k.dir[a] * (k.length + k.after);
        const Real shift = to_real(Int::load(chords.anchor[a] + at));
        const Real least = (min(p0, p1) - k.radius) * Real(u.inv_voxel[a]) + shift;
        const Real most = (max(p0, p1) + k.radius) * Real(u.inv_voxel[a]) + shift;
        const Real end(static_cast<float>(b.target.size[a]));
        active = active & (Real(-kMargin) < most) & (least < end + Real(kMargin));
    }
    return active;
}

void gather(const ChordArrays& chords, const GatherTarget& target) {
    const LaneBlock block(target);
    for (int at = 0; at < chords.count; at += kLanes) {
        ChordLanes k;
        k.anchor = Int(0);
        for (int a = 0; a < 3; ++a) {
            k.start[a] = Real::load(chords.start[a] + at);
            k.dir[a] = Real::load(chords.dir[a] + at);
            k.anchor = k.anchor + (Int::load(chords.anchor[a] + at) << kFieldShift[a]);
        }
        k.length = Real::load(chords.length + at);
        k.before = Real::load(chords.before + at);
        k.after = Real::load(chords.after + at);
        k.radius = Real::load(chords.radius + at);
        k.color = chords.color + at;
        k.active = meets_block(block, k, chords, at);
        if (k.active.bits() == 0) continue;
        set_moments(k, {Real::load(chords.bend[0] + at), Real::load(chords.bend[1] + at),
                        Real::load(chords.bend[2] + at)});
        pool_lanes(block, k);
        mark_columns<0>(block, k);
        mark_columns<1>(block, k);
        mark_columns<2>(block, k);
    }
}

} // namespace heddle::HEDDLE_ISA
