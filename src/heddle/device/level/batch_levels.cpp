#include <heddle/device/level/batch_levels.h>

#include <heddle/device/level/store_level_op.h>

#include <algorithm>

namespace heddle {
namespace {

/// The largest number of voxels and lobes of a level.
struct LevelCounts {
    std::int64_t voxels = 0;
    std::int64_t lobes = 0;
};

std::int64_t array_bytes(int level, const LevelCounts& count, const BatchOptions& options) {
    const bool maps = options.with_maps();
    const std::int64_t cells = options.level0.fields.occupancy ? 8 : 0;
    const std::int64_t slab = options.level0.fields.slabs ? sizeof(OpenSlab) : 0;
    const std::int64_t words = std::int64_t{1} << (2 * level);
    const std::size_t per_lobe = sizeof(DirectionSums) + (maps ? sizeof(MapSums) : 0);
    return count.voxels * (8 + 3 * 4 + 24 * words + cells + slab) + 4 +
           count.lobes * static_cast<std::int64_t>(per_lobe);
}

/// Bytes in addition to a level's own arrays while it is stored.
std::int64_t
store_bytes(std::int64_t blocks, int level, const LevelCounts& count, const FitOptions& options) {
    const VoxelFields& fields = options.fields;
    const auto leaves = blocks * static_cast<std::int64_t>(LeafCells{level}.per_block());
    const std::int64_t order = count.voxels * 8 + 4; // in use all the time
    const std::int64_t leaf = leaves * 64 + (leaves + 1) * 8 + count.voxels;
    const std::int64_t face = count.voxels * (8 + (fields.footprints != 0 ? 24 : 0));
    const std::int64_t lobe =
        count.voxels * 4 + count.lobes * (8 + (fields.maps() ? 6 : 0) + (fields.tangents ? 6 : 0));
    const auto per_lobe =
        static_cast<std::int64_t>(sizeof(LobeMoment) + (fields.map_sums() ? sizeof(MapSums) : 0));
    const std::int64_t sums = fields.masks ? count.voxels * 24 + count.lobes * per_lobe : 0;
    return order + std::max({leaf, face, lobe, sums});
}

/// Bytes in addition to the arrays of both levels while one is built from the other.
std::int64_t join_bytes(const LevelCounts& below, const LevelCounts& here) {
    return below.voxels * 5 + here.voxels * 6 + 8;
}

} // namespace

std::unique_ptr<UpperVoxel> TopLevel::take(std::size_t slot) const {
    const std::span<const std::uint64_t> keys = key.span();
    const auto found = std::lower_bound(keys.begin(), keys.end(), slot);
    if (found == keys.end() || *found != slot) return nullptr;
    const auto v = static_cast<std::size_t>(found - keys.begin());
    const std::size_t begin = first_lobe[v];
    const std::size_t end = first_lobe[v + 1];
    auto out = std::make_unique<UpperVoxel>();
    out->voxel.hits = hits[v];
    out->voxel.order = order[v];
    if (occupancy.size() > 0) out->voxel.cells = occupancy[v];
    out->voxel.lobe_count = static_cast<std::uint8_t>(end - begin);
    if (slabs.size() > 0) out->voxel.slab = slabs[v];
    out->lobes.assign(lobes.data() + begin, lobes.data() + end);
    if (maps.size() > 0) out->maps.assign(maps.data() + begin, maps.data() + end);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        auto run = std::make_unique<UpperVoxel::Run::element_type>();
        std::copy_n(columns.data() + (3 * v + axis) * UpperVoxel::kRunWords, UpperVoxel::kRunWords,
                    run->begin());
        out->columns[axis].emplace_back(0, std::move(run));
    }
    return out;
}

void BatchLevels::cut(std::size_t slot, Vec3i index, VoxelBlock& level0, BuiltBlock& built) const {
    level[0].cut(slot, index, level0);
    for (std::size_t l = 1; l <= static_cast<std::size_t>(options.levels); ++l) {
        level[l].cut(slot, index, built.level[l - 1]);
    }
    built.top = options.top ? top.take(slot) : nullptr;
}

std::int64_t predict_level_bytes(std::int64_t blocks,
                                 std::int64_t voxels,
                                 std::int64_t lobes,
                                 const BatchOptions& options) {
    LevelCounts below{voxels, lobes};
    std::int64_t most =
        array_bytes(0, below, options) + store_bytes(blocks, 0, below, options.level0);
    for (int level = 1; level <= options.levels; ++level) {
        const std::int64_t cells = blocks * (std::int64_t{kVoxelsPerBlock} >> (3 * level));
        LevelCounts here;
        here.voxels = std::min(below.voxels, cells);
        here.lobes = std::min(below.lobes, here.voxels * options.above.max_lobes);
        const std::int64_t own = array_bytes(level, here, options);
        most =
            std::max({most, array_bytes(level - 1, below, options) + own + join_bytes(below, here),
                      own + store_bytes(blocks, level, here, options.above)});
        below = here;
    }
    return most;
}

} // namespace heddle
