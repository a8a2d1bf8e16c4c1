#pragma once

#include <heddle/voxel/voxel_grid.h>

#include <cstdint>

namespace heddle {

/// What writing a .vdb costs.
struct VdbBytes {
    std::int64_t memory = 0; ///< peak over the source that is written
    std::int64_t file = 0;   ///< at most, as long as values do not grow in compression
};

/// What write_vdb takes whatever it writes: one batch of encoded leaves and the stream.
inline constexpr std::int64_t kVdbWriterBytes = std::int64_t{20} << 20;

/// A row of the table of leaves, twice: while it is gathered from threads, or while a grid lacks
/// some voxels. There is no tree.
inline constexpr std::int64_t kVdbWriterBytesPerLeaf = 2 * 88;

/// Predicts what write_vdb takes.
/// @param leaves  of 8^3 voxels with at least one active
/// @param voxels  active ones
/// @param lobes   of all voxels; >= voxels
/// @param fields  as the grid has them
[[nodiscard]] inline VdbBytes predict_vdb_bytes(std::int64_t leaves,
                                                std::int64_t voxels,
                                                std::int64_t lobes,
                                                VoxelGridFields fields) {
    const std::int64_t per_leaf_masks = 64 + 64 + 1 + 16; // topology, buffer, flag, Blosc's head
    const std::int64_t fields_of_lobe = 1 + fields.albedo + fields.surface + fields.tangents;
    const std::int64_t lobe_bytes =
        8 + 4 * fields.albedo + 4 * fields.surface + 8 * fields.tangents;
    const double lobes_per_voxel =
        voxels > 0 ? static_cast<double>(lobes) / static_cast<double>(voxels) : 1.0;
    const double masks = static_cast<double>(leaves * per_leaf_masks) *
                         (3.0 + static_cast<double>(fields_of_lobe) * lobes_per_voxel);
    VdbBytes out;
    out.memory = leaves * kVdbWriterBytesPerLeaf + kVdbWriterBytes;
    out.file = voxels * (4 + 6 + 8) + lobes * lobe_bytes + static_cast<std::int64_t>(masks) +
               (std::int64_t{64} << 10);
    return out;
}

} // namespace heddle
