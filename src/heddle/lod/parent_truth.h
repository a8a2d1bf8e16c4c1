#pragma once

#include <heddle/lod/voxel_index.h>
#include <heddle/sggx/mixture_error.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

/// All directions below a voxel, tangents and normals apart.
struct ParentTruth {
    /// by "are normals"; null where there are none
    std::array<std::unique_ptr<DirectionTruth>, 2> of;

    /// Adds a child's.
    void add(const ParentTruth& child);
    [[nodiscard]] double weight() const;
};

/// By material: its lobes are of normals.
using NormalMaterials = std::array<bool, 256>;

/// Pools the finest lobes below a voxel, each by its sums or, without, by share and mean depth.
/// @param level  of the voxel, over that of `finest`
[[nodiscard]] ParentTruth
pool_truth(const VoxelIndex& finest, int level, Vec3i index, const NormalMaterials& normals);

/// Coarsest level of which union_of_columns() is computed: 2^(2 level) words an axis are held.
inline constexpr int kMaxUnionLevel = 11;

/// The union of all finest columns along each axis, seen through a voxel; 65535 = all.
/// @param finest  with columns
/// @param level   0 to kMaxUnionLevel
[[nodiscard]] std::array<std::uint16_t, 3>
union_of_columns(const VoxelIndex& finest, int level, Vec3i index);

} // namespace heddle
