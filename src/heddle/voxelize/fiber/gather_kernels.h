#pragma once

#include <heddle/voxelize/chord/chord_body.h>
#include <heddle/voxelize/chord/expand_op.h>
#include <heddle/voxelize/chord/fiber_tile.h>
#include <heddle/voxelize/fiber/fiber_sums.h>

#include <cstdint>
#include <span>

namespace heddle {

/// Straight pieces of fibers as arrays, for eight or sixteen at once. Arrays are padded to a
/// multiple of 16; elements past `count` are read but ignored.
struct ChordArrays {
    const float* start[3]; ///< units, relative to the corner of the voxel `anchor`
    const float* dir[3];   ///< unit
    const float* bend[3];  ///< change of the fiber's direction along the chord
    const float* length;   ///< > 0; else there is no chord
    const float* before;   ///< see Chord
    const float* after;
    const float* radius;           ///< at most kThickRadius
    const std::int32_t* anchor[3]; ///< relative to the block's lo
    const std::uint32_t* color;
    int count = 0;
};

/// Adds thin chords to the voxels that they intersect, eight or sixteen at once, column by column.
/// Uses AVX-512 if the machine has it, else AVX2, else neither; the results have the same bits.
void gather_thin(const ChordArrays& chords, const GatherTarget& target);

/// Fills a tile with the fibers of `parts`, tile.fibers in total, at tile.chords + 3 samples. The
/// result has the same bits with and without AVX2.
void expand_fibers(FiberTile& tile,
                   std::span<const PlyPart> parts,
                   const PlySection& section,
                   const FiberTable& table);

/// The implementations of both functions; avx2 and avx512 exist only if HEDDLE_WITH_AVX2 is 1.
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
