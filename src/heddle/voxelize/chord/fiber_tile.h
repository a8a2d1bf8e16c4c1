#pragma once

#include <heddle/base/trig.h>
#include <heddle/base/vec.h>
#include <heddle/yarn/fiber_table.h>

#include <cstddef>

namespace heddle {

/// The frame of one ply's cross-section at one sample, in units: fibers are at center + x u + y v.
struct PlyFrame {
    Vec3f center, u, v;
    SinCos fiber, migration; ///< angles since the yarn's start
};

/// The shape of a ply's section, which is the same for all fibers of a yarn.
struct PlySection {
    float offset, short_axis, long_axis;
    float mean, amplitude; ///< migrating radius = R (mean + amplitude cos phase)
};

/// Some fibers of a yarn at the samples of one run of chords: a row per sample, fiber by fiber.
struct FiberTile {
    static constexpr int kFibers = 192;
    static constexpr int kRow = kFibers + 8; ///< lanes write groups of eight
    static constexpr int kChords = 16;
    static constexpr int kSamples = kChords + 3;

    int fibers = 0;
    int chords = 0;
    bool loops = false; ///< some of `loop` are not 1

    /// Samples, including one before the first chord and one after the last for second differences.
    alignas(64) float x[kSamples][kRow], y[kSamples][kRow], z[kSamples][kRow];
    alignas(64) float loop[kSamples][kRow]; ///< factor of the distance from the ply's axis
    float radius[kSamples];                 ///< radius of a fiber, units

    // direction and length of chord j, between samples j + 1 and j + 2
    alignas(64) float dx[kChords][kRow], dy[kChords][kRow], dz[kChords][kRow];
    alignas(64) float length[kChords][kRow];
    /// Change of the fiber's direction along the chord.
    alignas(64) float bx[kChords][kRow], by[kChords][kRow], bz[kChords][kRow];
    alignas(64) float before[kChords][kRow], after[kChords][kRow]; ///< see Chord
};

/// Fibers [begin, end) of a table, and the frames of their ply, one per sample.
struct PlyPart {
    std::size_t begin, end;
    const PlyFrame* frames;
};

} // namespace heddle
