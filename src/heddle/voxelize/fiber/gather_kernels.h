#pragma once

#include <heddle/voxelize/chord/chord_body.h>
#include <heddle/voxelize/chord/expand_op.h>
#include <heddle/voxelize/chord/fiber_tile.h>
#include <heddle/voxelize/fiber/fiber_sums.h>

#include <cstdint>
#include <span>

namespace heddle {

/// Straight pieces of fibers as arrays, for eight or sixteen at once. Arrays hold whole sixteens:
/// what lies behind `count` is read, and counts for nothing.
struct ChordArrays {
    const float* start[3]; ///< units, relative to the corner of the voxel `anchor`
    const float* dir[3];   ///< unit
    const float* bend[3];  ///< by how much the fiber's direction changes along the chord
    const float* length;   ///< > 0; else no chord
    const float* before;   ///< as in Chord
    const float* after;
    const float* radius;           ///< at most kThickRadius
    const std::int32_t* anchor[3]; ///< relative to the block's lo
    const std::uint32_t* color;
    int count = 0;
};

/// Adds thin chords to the voxels that they meet: eight or sixteen at once, column by column along
/// each.
/// The same bits with AVX-512, AVX2 and neither; the first that the machine has is used.
void gather_thin(const ChordArrays& chords, const GatherTarget& target);

/// Fills a tile with the fibers of `parts`, whose number is tile.fibers, at tile.chords + 3
/// samples.
/// The same bits with and without AVX2.
void expand_fibers(FiberTile& tile,
                   std::span<const PlyPart> parts,
                   const PlySection& section,
                   const FiberTable& table);

/// What the two above choose from; avx2 and avx512 are there where HEDDLE_WITH_AVX2 is 1.
namespace portable {
void gather(const ChordArrays& chords, const GatherTarget& target);
void expand(FiberTile& tile,
            std::span<const PlyPart> parts,
            const PlySection& section,
            const FiberTable& table);
} // namespace portable
namespace avx2 {
void gather(const ChordArrays& chords, const GatherTarget& target);
void expand(FiberTile& tile,
            std::span<const PlyPart> parts,
            const PlySection& section,
            const FiberTable& table);
} // namespace avx2
namespace avx512 {
void gather(const ChordArrays& chords, const GatherTarget& target);
} // namespace avx512

} // namespace heddle
