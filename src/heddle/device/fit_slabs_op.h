#pragma once

#include <heddle/device/block_pairs_op.h>
#include <heddle/device/level/dense_sums.h>
#include <heddle/executor/atomic.h>
#include <heddle/lod/open_level.h>
#include <heddle/voxelize/block/fit_options.h>
#include <heddle/voxelize/triangle/slab_op.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The slabs of a batch's voxels while triangles widen them. Two numbers of a voxel grow: 256 - lo
/// and 1 + hi, 0 before the first triangle.
struct BatchSlabs {
    const std::uint64_t* key; ///< per voxel, ascending (LevelArrays)
    const std::uint32_t* first_lobe;
    const DirectionSums* lobes;
    const OpenSlab* slabs;
    std::uint64_t* moment; ///< 6 per voxel: of normals by area
    std::uint32_t* reach;  ///< 2 per voxel
    std::size_t voxel_count;
    int max_lobes;
    Vec3d faces; ///< slab_faces()
};

/// The slabs of one block for the triangles of one material (slab_op.h): the counterpart of
/// SlabFitter::Slabs.
class DenseSlabs {
public:
    static constexpr bool kMeasuresAreas = false;

    HEDDLE_HD DenseSlabs(const BatchSlabs& of,
                         const BatchBlock& block,
                         std::uint32_t slot,
                         std::uint32_t material)
        : of_(of),
          slot_(slot),
          material_(material),
          corner_(block.lo - block.index * kBlockVoxels),
          begin_(lower_bound(std::uint64_t{slot} << 15, 0, of.voxel_count)),
          end_(lower_bound((std::uint64_t{slot} + 1) << 15, begin_, of.voxel_count)) {}

    [[nodiscard]] HEDDLE_HD int find(int cell) const {
        const Vec3i at = corner_ + Vec3i{cell >> 10, cell >> 5 & 31, cell & 31};
        const std::uint64_t key = std::uint64_t{slot_} << 15 | z_order_from_index(at);
        const std::size_t v = lower_bound(key, begin_, end_);
        if (v == end_ || of_.key[v] != key || !of_.slabs[v].there) return -1;
        return counts(v) ? static_cast<int>(v) : -1;
    }
    [[nodiscard]] HEDDLE_HD Vec3d gradient(int voxel) const { return of_.slabs[voxel].gradient; }
    HEDDLE_HD void widen(int voxel, int lo, int hi) const {
        std::uint32_t* reach = of_.reach + 2 * static_cast<std::size_t>(voxel);
        executor::atomic_max(reach, static_cast<std::uint32_t>(256 - lo));
        executor::atomic_max(reach + 1, static_cast<std::uint32_t>(1 + hi));
    }

protected:
    const BatchSlabs& of_;

private:
    [[nodiscard]] HEDDLE_HD std::size_t
    lower_bound(std::uint64_t key, std::size_t begin, std::size_t end) const {
        while (begin < end) {
            const std::size_t middle = begin + (end - begin) / 2;
            if (of_.key[middle] < key) {
                begin = middle + 1;
            } else {
                end = middle;
            }
        }
        return begin;
    }
    /// Returns true if the material has the first lobe, or may have been merged into it.
    [[nodiscard]] HEDDLE_HD bool counts(std::size_t v) const {
        const std::uint32_t first = of_.first_lobe[v];
        const std::uint32_t end = of_.first_lobe[v + 1];
        if (of_.lobes[first].material == material_) return true;
        if (static_cast<int>(end - first) < of_.max_lobes) return false;
        for (std::uint32_t l = first; l < end; ++l) {
            if (of_.lobes[l].material == material_) return false;
        }
        return true;
    }

    std::uint32_t slot_;
    std::uint32_t material_;
    Vec3i corner_;            ///< of the block's range in its cube of 32^3 voxels
    std::size_t begin_, end_; ///< the block's voxels
};

/// The same for the normals: the counterpart of SlabFitter::Areas.
class DenseAreas : public DenseSlabs {
public:
    static constexpr bool kMeasuresAreas = true;
    using DenseSlabs::DenseSlabs;

    HEDDLE_HD void add_area(int voxel, Vec3d area) const {
        std::int64_t moment[6] = {};
        add_area_moment(area * of_.faces, moment);
        std::uint64_t* const to = of_.moment + 6 * static_cast<std::size_t>(voxel);
        for (int i = 0; i < 6; ++i) {
            executor::atomic_add(to + i, static_cast<std::uint64_t>(moment[i]));
        }
    }
};

/// Adds one triangle to the normals or to the slabs of one block.
/// @tparam Slabs  DenseAreas or DenseSlabs
template <SurfaceKind Kind, typename Slabs>
struct WidenSlabsOp {
    SurfaceView surfaces;
    int subvoxels;
    const BatchBlock* blocks;
    const BlockPair* pairs;
    BatchSlabs slabs;

    HEDDLE_HD void operator()(std::size_t i) const {
        const BatchBlock& block = blocks[pairs[i].slot];
        const TriangleId at = surfaces.place(triangle_of(pairs[i].primitive));
        const Slabs of(slabs, block, pairs[i].slot, surfaces.meshes[at.mesh].material);
        widen_slabs<Kind>(surfaces, at, subvoxels, block.lo, block.lo + block.size, of,
                          NoScratch{});
    }
};

/// Sets the normal of each voxel's slab after the areas are added.
struct TurnSlabsOp {
    const std::uint64_t* moment;
    Vec3d edges;
    OpenSlab* slabs;

    HEDDLE_HD void operator()(std::size_t v) const {
        if (!slabs[v].there) return;
        std::int64_t sums[6];
        for (int i = 0; i < 6; ++i) sums[i] = static_cast<std::int64_t>(moment[6 * v + i]);
        slabs[v] = OpenSlab({0, 255, main_normal(sums)}, edges);
    }
};

/// Writes the planes of each voxel that a triangle widened.
struct CloseSlabsOp {
    const std::uint32_t* reach;
    OpenSlab* slabs;

    HEDDLE_HD void operator()(std::size_t v) const {
        if (reach[2 * v] == 0) return;
        slabs[v].planes.lo = static_cast<std::uint8_t>(256 - reach[2 * v]);
        slabs[v].planes.hi = static_cast<std::uint8_t>(reach[2 * v + 1] - 1);
    }
};

} // namespace heddle
