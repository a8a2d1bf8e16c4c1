#pragma once

#include <heddle/base/progress.h>
#include <heddle/surface/surface_source.h>
#include <heddle/voxelize/block/fit_options.h>
#include <heddle/voxelize/block/primitive.h>
#include <heddle/voxelize/triangle/displace.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// Fits the slabs (plane_slab.h) of a block's voxels to its triangles, in two passes after the
/// lobes are fitted: one finds the normals, the other widens the slabs along them.
///
/// A triangle counts in a voxel if the voxel's first lobe has its material, or if it has as many
/// lobes as are stored and none has this material: then the material was merged into one of them,
/// perhaps the first. Parts that alpha cuts away count too. Each thread needs its own.
class SlabFitter {
public:
    /// @param surfaces,options  must outlive this
    SlabFitter(const SurfaceSource& surfaces, const FitOptions& options);

    /// Fills block.slabs.
    /// @param triangles  all triangles of the block, with kTriangleBit set
    /// @param lo,hi      voxel range of the block, [lo, hi)
    /// @throws Error     Cancelled
    void fit(std::span<const Primitive> triangles,
             Vec3i lo,
             Vec3i hi,
             const Progress& progress,
             VoxelBlock& block);

    /// Returns the resident bytes of a fitter.
    [[nodiscard]] static std::int64_t byte_count();

private:
    /// What a voxel of a block has while its slab is fitted.
    struct Voxel {
        std::int64_t moment[6] = {}; ///< of normals by area
        PackedNormal normal;
        Vec3d gradient;
        std::uint32_t first_lobe = 0;
        std::uint8_t lobe_count = 0;
        std::uint8_t material = 0; ///< of the first lobe
        std::uint8_t lo = 255;     ///< above `hi`: no triangle yet
        std::uint8_t hi = 0;
    };
    struct Slabs;
    struct Areas;
    static constexpr std::uint16_t kNone = 0xffff;

    void list_voxels(const VoxelBlock& block, Vec3i lo);

    const SurfaceSource& surfaces_;
    const FitOptions& options_;
    std::vector<std::uint16_t> number_; ///< per cell: of its voxel in the block, or kNone
    std::vector<Voxel> voxels_;         ///< in the order of the block
    DisplaceScratch scratch_;
};

} // namespace heddle
