#include <heddle/lod/join_pieces.h>

#include <algorithm>
#include <bit>
#include <span>
#include <tuple>

namespace heddle {
namespace {

/// A leaf of a piece, and the position of its next voxel in the piece's arrays.
struct Part {
    Vec3i origin;
    const VoxelBlock* piece = nullptr;
    const VoxelLeaf* leaf = nullptr;
    std::size_t voxel = 0;
    std::size_t lobe = 0;
};

auto key(const Vec3i& origin) {
    return std::tuple(origin.x >> 5, origin.y >> 5, origin.z >> 5, origin.x, origin.y, origin.z);
}

template <typename T>
void copy(const std::vector<T>& from, std::size_t at, std::size_t count, std::vector<T>& to) {
    if (from.empty()) return;
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(at);
    to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(count));
}

/// Appends the part's next voxel to the block and advances the part.
void take_voxel(Part& part, bool with_order, VoxelBlock& out) {
    const VoxelBlock& from = *part.piece;
    const std::size_t lobes = from.lobe_count[part.voxel];
    copy(from.coverage, part.voxel, 1, out.coverage);
    copy(from.lobe_count, part.voxel, 1, out.lobe_count);
    copy(from.footprints, part.voxel, 1, out.footprints);
    copy(from.correlation, part.voxel, 1, out.correlation);
    copy(from.occupancy, part.voxel, 1, out.occupancy);
    copy(from.slabs, part.voxel, 1, out.slabs);
    if (with_order) {
        out.merge_order.push_back(from.merge_order.empty() ? 0 : from.merge_order[part.voxel]);
    }
    copy(from.lobes, part.lobe, lobes, out.lobes);
    copy(from.maps, part.lobe, lobes, out.maps);
    copy(from.tangents, part.lobe, lobes, out.tangents);
    part.voxel += 1;
    part.lobe += lobes;
}

void join_leaf(std::span<Part> parts, bool with_order, VoxelBlock& out) {
    VoxelLeaf leaf{.origin = parts[0].origin};
    leaf.first_voxel = static_cast<std::uint32_t>(out.coverage.size());
    leaf.first_lobe = static_cast<std::uint32_t>(out.lobes.size());
    for (std::size_t x = 0; x < 8; ++x) {
        Part* owner[64];
        for (Part& part : parts) {
            for (std::uint64_t w = part.leaf->active[x]; w != 0; w &= w - 1) {
                owner[std::countr_zero(w)] = &part;
            }
            leaf.active[x] |= part.leaf->active[x];
        }
        for (std::uint64_t w = leaf.active[x]; w != 0; w &= w - 1) {
            take_voxel(*owner[std::countr_zero(w)], with_order, out);
        }
    }
    out.leaves.push_back(leaf);
}

} // namespace

std::vector<VoxelBlock> join_pieces(std::vector<VoxelBlock> pieces) {
    std::vector<Part> parts;
    for (const VoxelBlock& piece : pieces) {
        for (const VoxelLeaf& leaf : piece.leaves) {
            parts.push_back({leaf.origin, &piece, &leaf, leaf.first_voxel, leaf.first_lobe});
        }
    }
    std::sort(parts.begin(), parts.end(),
              [](const Part& a, const Part& b) { return key(a.origin) < key(b.origin); });
    std::vector<VoxelBlock> blocks;
    const auto cell = [](const Vec3i& i) { return Vec3i{i.x >> 5, i.y >> 5, i.z >> 5}; };
    for (std::size_t i = 0; i < parts.size();) {
        std::size_t end = i;
        bool with_order = false;
        while (end < parts.size() && cell(parts[end].origin) == cell(parts[i].origin)) {
            with_order = with_order || !parts[end].piece->merge_order.empty();
            ++end;
        }
        VoxelBlock& block = blocks.emplace_back();
        while (i < end) {
            std::size_t leaf_end = i;
            while (leaf_end < end && parts[leaf_end].origin == parts[i].origin) ++leaf_end;
            join_leaf(std::span(parts).subspan(i, leaf_end - i), with_order, block);
            i = leaf_end;
        }
        block.shrink_to_fit();
    }
    return blocks;
}

} // namespace heddle
