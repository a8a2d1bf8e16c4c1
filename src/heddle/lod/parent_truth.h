#pragma once

#include <heddle/lod/voxel_index.h>
#include <heddle/sggx/mixture_error.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

/// All directions below a voxel, tangents and normals separately.
struct ParentTruth {
    /// [0]: tangents, [1]: normals; null if there are none
    std::array<std::unique_ptr<DirectionTruth>, 2> of;

    /// Adds a child's directions.
    void add(const ParentTruth& child);
    [[nodiscard]] double weight() const;
};

/// For each material: whether its lobes describe normals.
using NormalMaterials = std::array<bool, 256>;

/// Pools the finest lobes below a voxel, weighted by their sums, or by share and mean depth if
/// there are no sums.
/// @param level  level of the voxel relative to `finest`
[[nodiscard]] ParentTruth
pool_truth(const VoxelIndex& finest, int level, Vec3i index, const NormalMaterials& normals);

/// The coarsest level that union_of_columns() takes. It needs 2^(2 level) words per axis.
inline constexpr int kMaxUnionLevel = 11;

/// Returns the fraction of a voxel's columns that finest voxels cover, along each axis; 65535 =
/// all.
/// @param finest  a level with columns
/// @param level   0 to kMaxUnionLevel
[[nodiscard]] std::array<std::uint16_t, 3>
union_of_columns(const VoxelIndex& finest, int level, Vec3i index);

} // namespace heddle
