#pragma once

#include <heddle/raster/voxelize_slices.h>
#include <heddle/voxelize/block/accumulator.h>

#include <cstdint>
#include <span>

namespace heddle::raster {

/// 32-bit words of a voxel's sums in the driver's memory, and of a brick's 512 voxels
/// (segment_glsl.h).
constexpr std::size_t kVoxelWords = 32;
constexpr std::size_t kBrickWords = 512 * kVoxelWords;

/// How words are converted to the sums of the sampling voxelizer.
struct WordFormat {
    int subvoxels = 8;
    Composition composition = Composition::Accumulate;
    /// a directed area of 1 unit^2 has the weight 2^weight_bits in each of three passes
    int weight_bits = 0;
    std::uint32_t material = 0;
    friend bool operator==(const WordFormat&, const WordFormat&) = default;
};

/// Adds a brick's voxels to a block's sums.
/// @param words   kBrickWords words
/// @param corner  corner of the brick relative to the block's lo; voxels outside the block are
///                empty
void add_brick(std::span<const std::uint32_t> words,
               const WordFormat& form,
               Vec3i corner,
               BlockSums& sums);

/// Returns columns^2 bits, of which `count` are set, spread evenly in a fixed order. They represent
/// a density without known columns. `columns` is 1, 2, 4 or 8.
[[nodiscard]] std::uint64_t spread_columns(int count, int columns);

} // namespace heddle::raster
