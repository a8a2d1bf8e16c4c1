#include <heddle/device/level/stored_level.h>

#include <heddle/device/level/store_level_op.h>

#include <algorithm>
#include <array>
#include <vector>

namespace heddle {
namespace {

/// Copies items [begin, end) of a buffer, if it has any.
template <typename T>
void cut_range(const HostBuffer<T>& from, std::size_t begin, std::size_t end, std::vector<T>& out) {
    if (from.size() > 0) out.assign(from.data() + begin, from.data() + end);
}

/// Copies items of three numbers each.
void cut_triples(const HostBuffer<std::uint64_t>& from,
                 std::size_t begin,
                 std::size_t end,
                 std::vector<std::array<std::uint64_t, 3>>& out) {
    if (from.size() == 0) return;
    out.resize(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
        std::copy_n(from.data() + 3 * i, 3, out[i - begin].begin());
    }
}

/// Returns a stored leaf. If blocks are smaller than a leaf, a block's cube is a part of it.
/// @param corner  corner of the cube, in voxels of the level
VoxelLeaf make_leaf(Vec3i corner, const std::uint64_t* active) {
    VoxelLeaf leaf;
    leaf.origin = {corner.x & ~7, corner.y & ~7, corner.z & ~7};
    const Vec3i in = corner - leaf.origin;
    for (std::size_t x = 0; x + static_cast<std::size_t>(in.x) < 8; ++x) {
        leaf.active[x + static_cast<std::size_t>(in.x)] = active[x] << (in.y * 8 + in.z);
    }
    return leaf;
}

} // namespace

void StoredLevel::cut(std::size_t slot, Vec3i index, VoxelBlock& out) const {
    const LeafCells cells{level};
    const std::size_t first_leaf = slot * cells.per_block();
    const std::size_t last_leaf = first_leaf + cells.per_block();
    const std::size_t voxel = first_voxel[first_leaf];
    const std::size_t voxel_end = first_voxel[last_leaf];
    const std::size_t lobe = first_lobe[first_leaf];
    const std::size_t lobe_end = first_lobe[last_leaf];
    out = VoxelBlock{};
    const Vec3i origin = index * (kBlockVoxels >> level);
    const int edge = cells.edge();
    for (std::size_t l = first_leaf; l < last_leaf; ++l) {
        if (first_voxel[l] == first_voxel[l + 1]) continue;
        const int cell = static_cast<int>(l - first_leaf);
        const Vec3i at{cell / (edge * edge), cell / edge % edge, cell % edge};
        VoxelLeaf& leaf = out.leaves.emplace_back(make_leaf(origin + at * 8, &active[8 * l]));
        leaf.first_voxel = static_cast<std::uint32_t>(first_voxel[l] - voxel);
        leaf.first_lobe = static_cast<std::uint32_t>(first_lobe[l] - lobe);
    }
    cut_range(coverage, voxel, voxel_end, out.coverage);
    cut_range(lobe_count, voxel, voxel_end, out.lobe_count);
    const auto many = [](std::uint8_t count) { return count > 2; };
    if (std::any_of(out.lobe_count.begin(), out.lobe_count.end(), many)) {
        cut_range(order, voxel, voxel_end, out.merge_order);
    }
    cut_range(lobes, lobe, lobe_end, out.lobes);
    cut_range(maps, lobe, lobe_end, out.maps);
    cut_range(tangents, lobe, lobe_end, out.tangents);
    cut_triples(footprint, voxel, voxel_end, out.footprints);
    cut_range(occupancy, voxel, voxel_end, out.occupancy);
    cut_triples(columns, voxel, voxel_end, out.columns);
    cut_range(moments, lobe, lobe_end, out.moments);
    cut_range(map_sums, lobe, lobe_end, out.map_sums);
    cut_range(slabs, voxel, voxel_end, out.slabs);
}

} // namespace heddle
