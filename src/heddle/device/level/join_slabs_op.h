#pragma once

#include <heddle/lod/open_level.h>
#include <heddle/voxel/parent_slab.h>
#include <heddle/voxelize/block/fit_options.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// Marks the voxels of level 0 that get a slab.
struct OpenSlabsOp {
    FitOptions options;
    const std::uint32_t* first_lobe; ///< per voxel
    const DirectionSums* lobes;
    OpenSlab* slabs;

    HEDDLE_HD void operator()(std::size_t v) const {
        const DirectionSums& first = lobes[first_lobe[v]];
        slabs[v] = OpenSlab();
        slabs[v].there = options.normals.has(first.material);
    }
};

/// Joins the slabs of each parent's children, after its lobes are merged.
struct JoinSlabsOp {
    FitOptions options; ///< of the parents
    const std::uint32_t* first_child;
    const std::uint8_t* child_mask; ///< bit 4 x + 2 y + z per existing child
    const OpenSlab* below;
    const std::uint32_t* hits;       ///< per child: occupied subvoxels
    const std::uint32_t* first_lobe; ///< per parent
    const DirectionSums* lobes;
    OpenSlab* slabs;

    HEDDLE_HD void operator()(std::size_t p) const {
        const DirectionSums& first = lobes[first_lobe[p]];
        if (!options.normals.has(first.material)) {
            slabs[p] = OpenSlab();
            return;
        }
        ParentNormal main;
        std::uint32_t child = first_child[p];
        for (int octant = 0; octant < 8; ++octant) {
            if ((child_mask[p] >> octant & 1) == 0) continue;
            const OpenSlab& of = below[child];
            if (of.there) main.add(slab_normal(of.planes), hits[child]);
            ++child;
        }
        OpenSlab out({0, 255, main.normal()}, options.voxel_size);
        ParentSlab joined{out.gradient};
        child = first_child[p];
        for (int octant = 0; octant < 8; ++octant) {
            if ((child_mask[p] >> octant & 1) == 0) continue;
            const OpenSlab& of = below[child++];
            if (of.there) joined.add(octant, of.gradient, of.planes);
        }
        out.planes = joined.slab(out.planes.normal);
        slabs[p] = out;
    }
};

/// Writes the slab of each stored voxel.
struct StoreSlabsOp {
    const std::uint32_t* voxel_at; ///< per stored voxel: its number in the level
    const OpenSlab* from;
    PlaneSlab* to;

    HEDDLE_HD void operator()(std::size_t rank) const { to[rank] = from[voxel_at[rank]].planes; }
};

} // namespace heddle
