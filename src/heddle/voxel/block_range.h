#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/trig.h>
#include <heddle/geom/bounds.h>
#include <heddle/voxel/lattice_units.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace heddle {

/// The blocks that cover a voxel range: aligned to multiples of kBlockVoxels, numbered x-major.
struct BlockRange {
    Vec3i voxel_lo, voxel_hi; ///< [lo, hi)
    Vec3i lo, size;           ///< index of the first block; number of blocks per axis

    BlockRange() = default;
    BlockRange(Vec3i begin, Vec3i end) : voxel_lo(begin), voxel_hi(end) {
        for (int a = 0; a < 3; ++a) {
            lo[a] = floor_div(begin[a], kBlockVoxels);
            size[a] = floor_div(end[a] - 1, kBlockVoxels) - lo[a] + 1;
        }
    }
    [[nodiscard]] HEDDLE_HD std::uint64_t count() const {
        return static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) *
               static_cast<std::uint64_t>(size.z);
    }
    [[nodiscard]] HEDDLE_HD Vec3i index(std::uint64_t block) const {
        const auto ny = static_cast<std::uint64_t>(size.y);
        const auto nz = static_cast<std::uint64_t>(size.z);
        return lo + Vec3i{static_cast<std::int32_t>(block / (ny * nz)),
                          static_cast<std::int32_t>(block / nz % ny),
                          static_cast<std::int32_t>(block % nz)};
    }
    /// Returns the number of the block with index `at`.
    [[nodiscard]] HEDDLE_HD std::uint64_t number(Vec3i at) const {
        const Vec3i d = at - lo;
        return (static_cast<std::uint64_t>(d.x) * static_cast<std::uint64_t>(size.y) +
                static_cast<std::uint64_t>(d.y)) *
                   static_cast<std::uint64_t>(size.z) +
               static_cast<std::uint64_t>(d.z);
    }
    /// Sets [begin, end) to the voxel range of a block, clipped to [voxel_lo, voxel_hi).
    HEDDLE_HD void voxels(std::uint64_t block, Vec3i& begin, Vec3i& end) const {
        const Vec3i at = index(block);
        for (int a = 0; a < 3; ++a) {
            begin[a] = std::max(voxel_lo[a], at[a] * kBlockVoxels);
            end[a] = std::min(voxel_hi[a], (at[a] + 1) * kBlockVoxels);
        }
    }
};
static_assert(sizeof(BlockRange) == 48, "the same on host and device");

/// A box of block indices; `hi` is inclusive.
struct BlockBox {
    Vec3i lo, hi;
};

/// Returns the blocks of the range that the box touches. It is empty for a box outside the range.
/// @param box  scene units
[[nodiscard]] HEDDLE_HD inline BlockBox
blocks_of(const Bounds& box, const BlockRange& range, Vec3d voxel_size) {
    BlockBox out;
    for (int a = 0; a < 3; ++a) {
        const double edge = voxel_size[a] * kBlockVoxels;
        const double first = range.lo[a];
        const double last = first + range.size[a] - 1;
        // clamped in floating point: a box far outside must not overflow the conversion
        out.lo[a] =
            static_cast<std::int32_t>(std::clamp(std::floor(box.lo[a] / edge), first, last + 1));
        out.hi[a] =
            static_cast<std::int32_t>(std::clamp(std::floor(box.hi[a] / edge), first - 1, last));
    }
    return out;
}

} // namespace heddle
