#include <heddle/device/blocks_from_level.h>

#include <heddle/base/parallel.h>
#include <heddle/device/level_arrays.h>
#include <heddle/voxel/footprint.h>
#include <heddle/voxel/lobe_pool.h>

#include <algorithm>

namespace heddle {
namespace {

constexpr int kLeaf = 8;
constexpr std::uint64_t kLeafBits = 9; ///< of a key: the place in its leaf

/// Appends the voxels of one block.
class BlockFromLevel {
public:
    BlockFromLevel(const HostLevel& level, const FitOptions& options, VoxelBlock& out)
        : level_(level), options_(options), out_(out) {}

    /// @param begin, end  the leaf's voxels, in Z-order
    void append_leaf(Vec3i block, std::size_t begin, std::size_t end) {
        std::vector<std::pair<int, std::size_t>> order; // by (x, y, z)
        VoxelLeaf leaf;
        for (std::size_t v = begin; v < end; ++v) {
            const Vec3i at = place_of(static_cast<std::uint32_t>(level_.key[v] % kBlockCells));
            const Vec3i in{at.x % kLeaf, at.y % kLeaf, at.z % kLeaf};
            leaf.origin = block * kBlockVoxels + (at - in);
            leaf.active[static_cast<std::size_t>(in.x)] |= std::uint64_t{1}
                                                           << (in.y * kLeaf + in.z);
            order.emplace_back((in.x * kLeaf + in.y) * kLeaf + in.z, v);
        }
        std::sort(order.begin(), order.end());
        leaf.first_voxel = static_cast<std::uint32_t>(out_.coverage.size());
        leaf.first_lobe = static_cast<std::uint32_t>(out_.lobes.size());
        for (const auto& [place, v] : order) append_voxel(v);
        out_.leaves.push_back(leaf);
    }

private:
    void append_voxel(std::size_t v) {
        const int n = options_.subvoxels;
        const std::uint64_t* columns = &level_.columns[3 * v];
        const auto covered = [&](std::size_t axis) {
            return fraction16(count_bits(columns[axis]), n * n);
        };
        out_.coverage.push_back(
            {covered(0), covered(1), covered(2), fraction16(level_.hits[v], n * n * n)});
        if (options_.fields.footprints != 0) {
            std::array<std::uint64_t, 3>& bits = out_.footprints.emplace_back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Footprint face(0, n);
                face.add(0, columns[axis]);
                bits[axis] = face.bits(options_.fields.footprints);
            }
        }
        pool_.count = 0;
        const bool maps = !level_.maps.empty();
        for (std::size_t l = level_.first_lobe[v]; l < level_.first_lobe[v + 1]; ++l) {
            pool_.add(level_.lobes[l], maps ? &level_.maps[l] : nullptr);
            if (!options_.fields.masks) continue;
            LobeMoment& sums = out_.moments.emplace_back();
            std::copy_n(level_.lobes[l].moment, 6, sums.moment.begin());
            sums.weight = level_.lobes[l].weight;
            if (maps) out_.map_sums.push_back(level_.maps[l]);
        }
        if (options_.fields.masks) out_.columns.push_back({columns[0], columns[1], columns[2]});
        append_lobes(pool_, level_.order[v], options_.fields, fits_, out_);
    }

    const HostLevel& level_;
    const FitOptions& options_;
    VoxelBlock& out_;
    LobePool pool_;
    RecentFits fits_;
};

VoxelBlock block_from(const HostLevel& level,
                      Vec3i index,
                      std::size_t begin,
                      std::size_t end,
                      const FitOptions& options) {
    VoxelBlock out;
    BlockFromLevel block(level, options, out);
    std::vector<std::pair<Vec3i, std::size_t>> leaves; // corner, first voxel
    for (std::size_t v = begin; v < end; ++v) {
        if (v > begin && level.key[v] >> kLeafBits == level.key[v - 1] >> kLeafBits) continue;
        const Vec3i at = place_of(static_cast<std::uint32_t>(level.key[v] % kBlockCells));
        leaves.emplace_back(Vec3i{at.x / kLeaf, at.y / kLeaf, at.z / kLeaf}, v);
    }
    std::sort(leaves.begin(), leaves.end(), [](const auto& a, const auto& b) {
        const Vec3i p = a.first;
        const Vec3i q = b.first;
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    });
    for (const auto& [corner, first] : leaves) {
        std::size_t last = first;
        while (last < end && level.key[last] >> kLeafBits == level.key[first] >> kLeafBits) ++last;
        block.append_leaf(index, first, last);
    }
    return out;
}

} // namespace

std::vector<VoxelBlock> blocks_from_level(const HostLevel& level,
                                          std::span<const BatchBlock> blocks,
                                          const FitOptions& options) {
    std::vector<VoxelBlock> out(blocks.size());
    parallel_chunks(blocks.size(), 1, [&](std::size_t b, std::size_t) {
        const auto at = [&](std::uint64_t block) {
            const auto found =
                std::lower_bound(level.key.begin(), level.key.end(), block << block_shift(0));
            return static_cast<std::size_t>(found - level.key.begin());
        };
        out[b] = block_from(level, blocks[b].index, at(b), at(b + 1), options);
    });
    return out;
}

} // namespace heddle
