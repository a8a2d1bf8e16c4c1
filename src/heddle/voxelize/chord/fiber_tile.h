#pragma once

#include <heddle/base/trig.h>
#include <heddle/base/vec.h>
#include <heddle/yarn/fiber_table.h>

#include <cstddef>

namespace heddle {

/// Cross-section frame of one ply at one sample, units: a fiber lies at center + x u + y v.
struct PlyFrame {
    Vec3f center, u, v;
    SinCos fiber, migration; ///< turned by so much since the yarn's start
};

/// Shape of a ply's section: what all fibers of a yarn share.
struct PlySection {
    float offset, short_axis, long_axis;
    float mean, amplitude; ///< migrating radius = R (mean + amplitude cos phase)
};

/// Some fibers of a yarn at the samples of one run of chords, fiber by fiber in each row.
struct FiberTile {
    static constexpr int kFibers = 192;
    static constexpr int kRow = kFibers + 8; ///< lanes write whole eights
    static constexpr int kChords = 16;
    static constexpr int kSamples = kChords + 3;

    int fibers = 0;
    int chords = 0;
    bool loops = false; ///< `loop` is not all 1

    /// Samples: one before the first chord, and one after the last, for the second differences.
    alignas(64) float x[kSamples][kRow], y[kSamples][kRow], z[kSamples][kRow];
    alignas(64) float loop[kSamples][kRow]; ///< factor of the distance from the ply's axis
    float radius[kSamples];                 ///< of a fiber, units

    // of chord j, between samples j + 1 and j + 2
    alignas(64) float dx[kChords][kRow], dy[kChords][kRow], dz[kChords][kRow];
    alignas(64) float length[kChords][kRow];
    /// By how much the fiber's direction changes along the chord.
    alignas(64) float bx[kChords][kRow], by[kChords][kRow], bz[kChords][kRow];
    alignas(64) float before[kChords][kRow], after[kChords][kRow]; ///< as in Chord
};

/// Fibers [begin, end) of a table that share a ply's frames, one a sample.
struct PlyPart {
    std::size_t begin, end;
    const PlyFrame* frames;
};

} // namespace heddle
