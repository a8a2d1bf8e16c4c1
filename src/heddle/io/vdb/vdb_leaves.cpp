#include <heddle/io/vdb/vdb_leaves.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/io/vdb/level_grids.h>
#include <heddle/voxel/index_box.h>

#include <algorithm>
#include <tuple>

namespace heddle {
namespace {

[[noreturn]] void fail(const char* what) {
    throw Error(ErrorCode::Internal, str("write vdb: ", what));
}

/// Throws unless every array has the length that the writer assumes.
void check_arrays(const VoxelBlock& block, const VoxelLevelInfo& info) {
    const std::size_t voxels = block.coverage.size(), lobes = block.lobes.size();
    const VoxelFields& has = info.fields;
    const bool masks = has_masks(has, info.level);
    const auto is = [](const auto& array, bool wanted, std::size_t size) {
        return !wanted || array.size() == size;
    };
    const bool whole = is(block.lobe_count, true, voxels) && is(block.maps, has.maps(), lobes) &&
                       is(block.tangents, has.tangents, lobes) &&
                       is(block.columns, masks, voxels) && is(block.moments, masks, lobes) &&
                       is(block.map_sums, masks && has.map_sums(), lobes) &&
                       is(block.footprints, has.footprints != 0, voxels) &&
                       is(block.occupancy, has.occupancy, voxels) &&
                       is(block.correlation, has.correlation, voxels) &&
                       is(block.merge_order, !block.merge_order.empty(), voxels);
    const bool placed = is(block.slabs, has.slabs, voxels);
    if (!whole || !placed) fail("a block's arrays are not as long as its fields say");
}

void add_leaf(VdbLeaves& found,
              const VoxelBlock& block,
              const VoxelLeaf& leaf,
              const std::vector<Material>& materials) {
    const std::size_t end = std::size_t{leaf.first_voxel} + leaf.voxel_count();
    if (end > block.coverage.size()) fail("a leaf names voxels that its block lacks");
    std::size_t l = leaf.first_lobe;
    for (std::size_t v = leaf.first_voxel; v < end; ++v) {
        const std::uint8_t n = block.lobe_count[v];
        if (n == 0 || l + n > block.lobes.size() || block.lobes[l].material >= materials.size()) {
            fail("a voxel without lobe or material");
        }
        const bool fiber = materials[block.lobes[l].material].kind == MaterialKind::Fiber;
        ++(fiber ? found.fiber_voxels : found.surface_voxels);
        found.most_lobes = std::max<std::int32_t>(found.most_lobes, n);
        if (n > 2) ++(block.merge_order.empty() ? found.unmerged_voxels : found.merge_voxels);
        found.lobe_count += n;
        l += n;
    }
    found.voxel_count += static_cast<std::int64_t>(end - leaf.first_voxel);
    found.box.grow(box_of(leaf));
}

VdbLeaves combine(VdbLeaves a, const VdbLeaves& b) {
    a.leaves.insert(a.leaves.end(), b.leaves.begin(), b.leaves.end());
    a.box.grow(b.box);
    a.voxel_count += b.voxel_count;
    a.lobe_count += b.lobe_count;
    a.most_lobes = std::max(a.most_lobes, b.most_lobes);
    a.merge_voxels += b.merge_voxels;
    a.unmerged_voxels += b.unmerged_voxels;
    a.fiber_voxels += b.fiber_voxels;
    a.surface_voxels += b.surface_voxels;
    return a;
}

auto tree_order(const LeafRef& ref) {
    const Vec3i root = node_origin(ref.origin, 12);
    return std::tuple(root.x, root.y, root.z, child_offset(ref.origin, 12, 7),
                      child_offset(ref.origin, 7, 3));
}

} // namespace

VdbLeaves list_vdb_leaves(const VoxelLevel& source, const Progress& progress) {
    const VoxelLevelInfo& info = source.info();
    const auto walk = [&](std::size_t begin, std::size_t end) {
        VdbLeaves part;
        VoxelBlock scratch;
        for (std::size_t b = begin; b < end; ++b) {
            progress.check();
            const VoxelBlock& block = source.block(b, scratch);
            check_arrays(block, info);
            for (std::size_t i = 0; i < block.leaves.size(); ++i) {
                const VoxelLeaf& leaf = block.leaves[i];
                if (leaf.voxel_count() == 0) continue;
                part.leaves.push_back({leaf.origin, static_cast<std::uint32_t>(b),
                                       static_cast<std::uint32_t>(i), leaf.active});
                add_leaf(part, block, leaf, info.materials);
            }
        }
        return part;
    };
    VdbLeaves found = reduce_chunks(source.block_count(), 16, VdbLeaves{}, walk, combine);
    std::sort(found.leaves.begin(), found.leaves.end(),
              [](const LeafRef& a, const LeafRef& b) { return tree_order(a) < tree_order(b); });
    for (std::size_t i = 1; i < found.leaves.size(); ++i) {
        if (found.leaves[i].origin == found.leaves[i - 1].origin) {
            fail("two blocks hold the same leaf");
        }
    }
    if (found.merge_voxels > 0 && found.unmerged_voxels > 0) {
        fail("some voxels of more than two lobes have a merge order, others have none");
    }
    return found;
}

} // namespace heddle
