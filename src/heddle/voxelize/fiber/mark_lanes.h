#pragma once

#include <heddle/voxelize/fiber/gather_kernels.h>
#include <heddle/voxelize/fiber/pool_lanes.h>

#include <bit>
#include <cstdint>

// Finds the columns along one axis that thin chords cover, as many at once as the lanes L have
// (lanes_*.h).

namespace heddle {

namespace lane_detail {

/// Columns that may be covered: the chord's lane and the column's indices along major and minor.
template <typename L>
struct Candidates {
    using Real = typename L::Real;
    static constexpr int kMax = 256;
    int count = 0;
    alignas(64) std::int32_t lane[kMax + L::kLanes];
    alignas(64) float i[kMax + L::kLanes], j[kMax + L::kLanes];

    void add(std::uint32_t mask, Real column_i, Real column_j) {
        const typename L::Int order = L::set_lanes(mask);
        order.store(lane + count);
        pick(column_i, order).store(i + count);
        pick(column_j, order).store(j + count);
        count += std::popcount(mask);
    }
};

/// Sets a column's bit in the voxel of each lane that hits, and along z the bits of a run of
/// subvoxels. If more than half of the lanes hit, all lanes are written; misses go to scratch
/// voxels, which avoids a branch. Otherwise hits are compacted and half of the lanes are written.
/// @param packed  cell | bit << 16
/// @param run     first subvoxel's bit | length << 9
template <typename L, int kDepth>
inline void set_columns(BlockSums::VoxelTable voxels,
                        typename L::Mask hits,
                        typename L::Int packed,
                        typename L::Int run) {
    using Int = typename L::Int;
    constexpr int kLanes = L::kLanes;
    alignas(64) std::int32_t cells[kLanes];
    alignas(64) std::int32_t runs[kLanes];
    packed = select(hits, packed, Int::iota() + Int(BlockSums::kVoxels));
    const std::uint32_t mask = hits.bits();
    const bool few = std::popcount(mask) <= kLanes / 2;
    if (few) { // repeats of lane 0 fill the rest: setting its bits again has no effect
        const Int order = L::set_lanes(mask);
        packed = pick(packed, order);
        run = pick(run, order);
    }
    packed.store(cells);
    run.store(runs);
    const auto set = [&, voxels](int l) {
        const auto p = static_cast<std::uint32_t>(cells[l]);
        VoxelSums& voxel = voxels[p & 0xffff];
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

/// Pools a small weight of the direction in voxels that chords touch beside their centrelines.
template <typename L>
inline void graze(const LaneBlock<L>& b,
                  const LaneChords<L>& k,
                  std::uint32_t hits,
                  typename L::Int cell,
                  typename L::Int lane) {
    alignas(64) std::int32_t cells[L::kLanes];
    alignas(64) std::int32_t lanes[L::kLanes];
    cell.store(cells);
    lane.store(lanes);
    for (; hits != 0; hits &= hits - 1) {
        const int l = std::countr_zero(hits);
        pool_lane(b, k, lanes[l], static_cast<std::uint32_t>(cells[l]), kGrazeWeight);
    }
}

/// Tests the candidates and sets the bits of those that hit.
template <typename L, int kDepth>
inline void mark_candidates(const LaneBlock<L>& b,
                            const LaneChords<L>& k,
                            const ChordProjection<L>& v,
                            const Candidates<L>& list) {
    using Real = typename L::Real;
    using Int = typename L::Int;
    using Mask = typename L::Mask;
    const int shift = b.target.shift;
    const BlockSums::VoxelTable voxels(b.target.block);
    for (int at = 0; at < list.count; at += L::kLanes) {
        const Int lane = Int::load(list.lane + at);
        const Real i = Real::load(list.i + at);
        const Real j = Real::load(list.j + at);
        ColumnDepths<L> depths = column_depths<L>(v.terms.picked(lane), i, j);
        depths.hit = depths.hit & (Int(list.count - at) > Int::iota());
        if (depths.hit.bits() == 0) continue;

        ColumnAddress<L, kDepth> place(pick(k.anchor, lane), pick(v.swapped, lane), i, j, depths,
                                       b.target.units, shift);
        const Int bit = place.bit << 16;
        for (Mask open = depths.hit; open.bits() != 0;) {
            const Int word = place.base + (place.depth << field_shift(kDepth));
            const Mask here = open & b.holds(word);
            if (here.bits() != 0) {
                const Int cell = LaneBlock<L>::cell(word);
                Int run(0);
                if constexpr (kDepth == 2) run = place.run(shift);
                set_columns<L, kDepth>(voxels, here, cell | bit, run);
                const Int passed[4] = {pick(k.passed[0], lane), pick(k.passed[1], lane),
                                       pick(k.passed[2], lane), pick(k.passed[3], lane)};
                const Mask grazed = without(here, is_passed<L>(passed, word));
                if (const std::uint32_t hits = grazed.bits(); hits != 0) {
                    graze(b, k, hits, cell, lane);
                }
            }
            open = open & (place.last > place.depth);
            place.depth = place.depth + Int(1);
        }
    }
}

/// Sets the bits of the columns along axis kDepth that the chords cover, and along z of subvoxels.
template <typename L, int kDepth>
inline void mark_columns(const LaneBlock<L>& b, const LaneChords<L>& k) {
    using Real = typename L::Real;
    using Int = typename L::Int;
    using Mask = typename L::Mask;
    const ChordProjection<L> v = project_along<L, kDepth>(k, b.target.units);
    Candidates<L> list;
    const auto flush = [&] {
        Int(0).store(list.lane + list.count); // pads the last group of lanes
        Real(0.0f).store(list.i + list.count);
        Real(0.0f).store(list.j + list.count);
        mark_candidates<L, kDepth>(b, k, v, list);
        list.count = 0;
    };
    // largest number of columns along minor in a strip, the same for all rows to avoid
    // mispredictions
    int tries = 1;
    while ((k.active & (Real(static_cast<float>(tries)) < v.width)).bits() != 0) ++tries;
    Real i = v.first;
    for (Mask row = k.active & (i <= v.last); row.bits() != 0; row = row & (i <= v.last)) {
        const Real edge = v.strip + v.strip_i * i;
        const Real end = edge + v.width;
        Real j = ceil(edge);
        for (int t = 0; t < tries; ++t) {
            list.add((row & (j <= end)).bits(), i, j);
            if (list.count > Candidates<L>::kMax - L::kLanes) flush();
            j = j + Real(1.0f);
        }
        i = i + Real(1.0f);
    }
    if (list.count > 0) flush();
}

} // namespace lane_detail

/// gather_thin() (gather_kernels.h) over lanes L.
template <typename L>
inline void gather_with(const ChordArrays& chords, const GatherTarget& target) {
    using namespace lane_detail;
    using Real = typename L::Real;
    using Int = typename L::Int;
    const LaneBlock<L> block(target);
    for (int at = 0; at < chords.count; at += L::kLanes) {
        LaneChords<L> k;
        Int anchor[3];
        k.anchor = Int(0);
        for (int a = 0; a < 3; ++a) {
            k.start[a] = Real::load(chords.start[a] + at);
            k.dir[a] = Real::load(chords.dir[a] + at);
            anchor[a] = Int::load(chords.anchor[a] + at);
            k.anchor = k.anchor + (anchor[a] << field_shift(a));
        }
        k.length = Real::load(chords.length + at);
        k.before = Real::load(chords.before + at);
        k.after = Real::load(chords.after + at);
        k.radius = Real::load(chords.radius + at);
        k.color = chords.color + at;
        // the arrays are padded to a multiple of 16 with unspecified values
        k.active = meets_block<L>(k, anchor, target.units, target.size) &
                   (Int(chords.count - at) > Int::iota());
        if (k.active.bits() == 0) continue;
        set_moments<L>(k, {Real::load(chords.bend[0] + at), Real::load(chords.bend[1] + at),
                           Real::load(chords.bend[2] + at)});
        pool_lanes(block, k);
        mark_columns<L, 0>(block, k);
        mark_columns<L, 1>(block, k);
        mark_columns<L, 2>(block, k);
    }
}

} // namespace heddle
