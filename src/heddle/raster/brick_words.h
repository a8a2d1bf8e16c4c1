#pragma once

#include <heddle/raster/voxelize_slices.h>
#include <heddle/voxelize/block/accumulator.h>

#include <cstdint>
#include <span>

namespace heddle::raster {

/// 32-bit words of a voxel's sums in the driver's memory, and of a brick's 512 voxels
/// (slab_glsl.h).
constexpr std::size_t kVoxelWords = 32;
constexpr std::size_t kBrickWords = 512 * kVoxelWords;

/// What turns words into the sampling voxelizer's sums.
struct WordFormat {
    int subvoxels = 8;
    Composition composition = Composition::Accumulate;
    /// a directed area of 1 unit^2 weighs 2^weight_bits, in each of three passes
    int weight_bits = 0;
    std::uint32_t material = 0;
    friend bool operator==(const WordFormat&, const WordFormat&) = default;
};

/// Adds a brick's voxels to a block's sums.
/// @param words   kBrickWords of them
/// @param corner  of the brick, relative to the block's lo; voxels outside the block are empty
void add_brick(std::span<const std::uint32_t> words,
               const WordFormat& form,
               Vec3i corner,
               BlockSums& sums);

/// Bits [0, columns^2) of which the first `count` in a fixed order that spreads them evenly are
/// set: what stands for a density that knows no columns. `columns` is 1, 2, 4 or 8.
[[nodiscard]] std::uint64_t spread_columns(int count, int columns);

} // namespace heddle::raster
