#include <heddle/lod/voxel_index.h>

#include <heddle/voxel/z_order.h>

#include <algorithm>

namespace heddle {

VoxelIndex::VoxelIndex(const VoxelLevel& source) : source_(source) {
    VoxelBlock scratch;
    for (std::size_t b = 0; b < source.block_count(); ++b) {
        const VoxelBlock& block = source.block(b, scratch);
        for (std::size_t i = 0; i < block.leaves.size(); ++i) {
            const Vec3i& o = block.leaves[i].origin;
            leaves_.push_back({{o.x >> 3, o.y >> 3, o.z >> 3},
                               static_cast<std::uint32_t>(b),
                               static_cast<std::uint32_t>(i)});
        }
    }
    std::sort(leaves_.begin(), leaves_.end(),
              [](const LeafEntry& a, const LeafEntry& b) { return z_order_less(a.cell, b.cell); });
}

std::size_t VoxelIndex::first_in(Vec3i cell) const {
    const auto at =
        std::lower_bound(leaves_.begin(), leaves_.end(), cell,
                         [](const LeafEntry& a, Vec3i b) { return z_order_less(a.cell, b); });
    return static_cast<std::size_t>(at - leaves_.begin());
}

} // namespace heddle
