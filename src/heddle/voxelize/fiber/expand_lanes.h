#pragma once

#include <heddle/voxelize/chord/expand_op.h>
#include <heddle/voxelize/chord/fiber_tile.h>
#include <heddle/yarn/fiber_table.h>

#include <cstddef>
#include <span>

// Expands the fibers of a yarn from their table, as many at once as the lanes L have (lanes_*.h).

namespace heddle {

namespace lane_detail {

template <typename L>
inline void expand_sample(FiberTile& tile,
                          int sample,
                          std::size_t row,
                          const PlyPart& part,
                          const PlySection& section,
                          const FiberTable& table) {
    using Real = typename L::Real;
    const PlyFrame at = part.frames[sample];
    for (std::size_t f = 0; f < part.end - part.begin; f += L::kLanes) {
        const std::size_t i = part.begin + f;
        const FiberConstants<Real> fiber{
            Real::load(table.radius.data() + i), Real::load(table.cos_angle.data() + i),
            Real::load(table.sin_angle.data() + i), Real::load(table.cos_migration.data() + i),
            Real::load(table.sin_migration.data() + i)};
        Real loop(1.0f);
        if (tile.loops) loop = Real::load(tile.loop[sample] + row + f);
        const LanePoint<Real> p = fiber_point(fiber, at, section, tile.loops ? &loop : nullptr);
        p.x.store(tile.x[sample] + row + f);
        p.y.store(tile.y[sample] + row + f);
        p.z.store(tile.z[sample] + row + f);
    }
}

/// Computes the chords between samples and moves the samples to the ends of the chords.
template <typename L>
inline void make_chords(FiberTile& tile, int f) {
    using Real = typename L::Real;
    const auto sample = [&](int j) {
        return LanePoint<Real>{Real::load(tile.x[j] + f), Real::load(tile.y[j] + f),
                               Real::load(tile.z[j] + f)};
    };
    LanePoint<Real> p0 = sample(0);
    LanePoint<Real> p1 = sample(1);
    ChordEnd<Real> from{};
    for (int j = 1; j <= tile.chords + 1; ++j) {
        const LanePoint<Real> p2 = sample(j + 1);
        const ChordEnd<Real> to = chord_end(p0, p1, p2);
        to.at.x.store(tile.x[j] + f);
        to.at.y.store(tile.y[j] + f);
        to.at.z.store(tile.z[j] + f);
        if (j > 1) {
            const int c = j - 2;
            const LaneChord<Real> chord =
                chord_between(from, to, tile.radius[j - 1], tile.radius[j]);
            chord.dir.x.store(tile.dx[c] + f);
            chord.dir.y.store(tile.dy[c] + f);
            chord.dir.z.store(tile.dz[c] + f);
            chord.length.store(tile.length[c] + f);
            chord.bend.x.store(tile.bx[c] + f);
            chord.bend.y.store(tile.by[c] + f);
            chord.bend.z.store(tile.bz[c] + f);
            chord.before.store(tile.before[c] + f);
            chord.after.store(tile.after[c] + f);
        }
        from = to;
        p0 = p1;
        p1 = p2;
    }
}

} // namespace lane_detail

/// expand_fibers() (gather_kernels.h) over lanes L.
template <typename L>
inline void expand_with(FiberTile& tile,
                        std::span<const PlyPart> parts,
                        const PlySection& section,
                        const FiberTable& table) {
    using namespace lane_detail;
    for (int j = 0; j < tile.chords + 3; ++j) {
        std::size_t row = 0;
        // the excess lanes of a part are overwritten by the next part
        for (const PlyPart& part : parts) {
            expand_sample<L>(tile, j, row, part, section, table);
            row += part.end - part.begin;
        }
    }
    for (int f = 0; f < tile.fibers; f += L::kLanes) make_chords<L>(tile, f);
    for (int f = tile.fibers; f % L::kLanes != 0; ++f) {
        for (int c = 0; c < tile.chords; ++c) tile.length[c][f] = 0.0f; // no chord
    }
}

} // namespace heddle
