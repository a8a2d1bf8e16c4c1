#pragma once

#include <heddle/voxel/voxel_level.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace heddle {

/// The cost of writing a .vdb.
struct VdbBytes {
    std::int64_t memory = 0; ///< peak, in addition to the source
    std::int64_t file = 0;   ///< upper bound, provided that compression does not enlarge values
};

/// The fixed memory of write_vdb: one batch of encoded leaves and the stream.
inline constexpr std::int64_t kVdbWriterBytes = std::int64_t{20} << 20;

/// Memory per leaf: a row of the table of leaves, twice: while threads gather it, or for a grid
/// that lacks some voxels. There is no tree.
inline constexpr std::int64_t kVdbWriterBytesPerLeaf = 2 * 88;

/// Fixed bytes of a grid in the file: its description, and the masks of the root's children, of
/// which an object around the origin has eight.
inline constexpr std::int64_t kVdbEmptyGridBytes = 1024 + 8 * 8192;

namespace detail {

/// The bytes of the grids of one level.
[[nodiscard]] inline std::int64_t
predict_level_bytes(const LevelSize& of, const VoxelFields& fields, bool masks) {
    const std::int64_t per_leaf_masks = 64 + 64 + 1 + 16; // topology, buffer, flag, Blosc's header
    const std::int64_t sums = masks ? (fields.map_sums() ? 19 : 7) : 0;
    const std::int64_t lobe_grids = 1 + fields.albedo + fields.surface + fields.tangents + sums;
    const std::int64_t lobe_bytes =
        8 + 4 * fields.albedo + 4 * fields.surface + 8 * fields.tangents + 8 * sums;
    const std::int64_t footprints = fields.footprints == 8 ? 3 : fields.footprints == 4 ? 1 : 0;
    const std::int64_t columns = masks ? 3 : 0;
    std::int64_t voxel_grids = 3 + columns + footprints + fields.correlation;
    std::int64_t voxel_bytes = 4 + 6 + 8 + 8 * columns + 8 * footprints + 4 * fields.correlation;
    voxel_grids += fields.occupancy;
    voxel_bytes += 8 * fields.occupancy;
    voxel_grids += fields.slabs;
    voxel_bytes += 4 * fields.slabs;
    const std::int64_t merges = (of.lobes - of.voxels) / 2; // at most this many have three lobes
    const double lobes_per_voxel =
        of.voxels > 0 ? static_cast<double>(of.lobes) / static_cast<double>(of.voxels) : 1.0;
    const double grids = static_cast<double>(voxel_grids + (merges > 0)) +
                         static_cast<double>(lobe_grids) * lobes_per_voxel;
    const double bytes_per_grid =
        static_cast<double>(of.leaves * per_leaf_masks + kVdbEmptyGridBytes);
    return of.voxels * voxel_bytes + of.lobes * lobe_bytes + 4 * merges +
           static_cast<std::int64_t>(grids * bytes_per_grid);
}

} // namespace detail

/// Predicts the memory and bytes of write_vdb for an object's levels.
/// @param levels  finest first
/// @param fields  as the grids have them; masks are only counted for level 0
[[nodiscard]] inline VdbBytes predict_vdb_bytes(std::span<const LevelSize> levels,
                                                const VoxelFields& fields) {
    VdbBytes out{kVdbWriterBytes, std::int64_t{16} << 10};
    for (std::size_t l = 0; l < levels.size(); ++l) {
        out.memory += levels[l].leaves * kVdbWriterBytesPerLeaf;
        out.file += detail::predict_level_bytes(levels[l], fields, fields.masks && l == 0);
    }
    return out;
}

/// The same for an object of one level.
[[nodiscard]] inline VdbBytes predict_vdb_bytes(std::int64_t leaves,
                                                std::int64_t voxels,
                                                std::int64_t lobes,
                                                const VoxelFields& fields) {
    const LevelSize one{leaves, voxels, lobes};
    return predict_vdb_bytes({&one, 1}, fields);
}

} // namespace heddle
