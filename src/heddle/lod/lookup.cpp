#include <heddle/lod/lookup.h>

#include <heddle/base/error.h>

#include <limits>

namespace heddle {
namespace {

template <typename T>
void append_to(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Index of the finest voxel that a place lies in; nothing outside the lattice's 32 bits.
std::optional<Vec3i> finest_index(const Lattice& lattice, Vec3d position) {
    constexpr double kFar = 2147483648.0;
    Vec3i index;
    for (int a = 0; a < 3; ++a) {
        const double i = std::floor(position[a] / lattice.voxel_size[a]);
        if (!(i >= -kFar && i < kFar)) return std::nullopt; // NaN too
        index[a] = static_cast<std::int32_t>(i);
    }
    return index;
}

} // namespace

LevelLookup::LevelLookup(const VoxelLevels& levels) : levels_(levels.size()) {
    for (std::size_t l = 0; l < levels.size(); ++l) {
        Level& level = levels_[l];
        level.info = levels[l]->info();
        VoxelBlock scratch;
        for (std::size_t b = 0; b < levels[l]->block_count(); ++b) {
            append(levels[l]->block(b, scratch), level);
        }
        level.arrays.shrink_to_fit();
        fill_slots(level);
    }
}

void LevelLookup::append(const VoxelBlock& block, Level& level) {
    VoxelBlock& to = level.arrays;
    const std::size_t first_voxel = to.coverage.size();
    const std::size_t first_lobe = to.lobes.size();
    for (const VoxelLeaf& from : block.leaves) {
        LookupLeaf& leaf = level.leaves.emplace_back();
        leaf.first_voxel = first_voxel + from.first_voxel;
        leaf.first_lobe = first_lobe + from.first_lobe;
        leaf.active = from.active;
        leaf.origin = from.origin;
        const std::size_t voxels = count_before(leaf.active, leaf.before);
        std::uint32_t lobe = 0;
        for (std::size_t v = from.first_voxel; v < from.first_voxel + voxels; ++v) {
            const std::uint32_t count = block.lobe_count[v];
            level.lobe_place.push_back(static_cast<std::uint16_t>(lobe | (count - 1) << 12));
            lobe += count;
        }
    }
    append_to(to.coverage, block.coverage);
    append_to(to.lobes, block.lobes);
    append_to(to.maps, block.maps);
    append_to(to.tangents, block.tangents);
    append_to(to.footprints, block.footprints);
    append_to(to.correlation, block.correlation);
    if (!block.merge_order.empty() || !to.merge_order.empty()) {
        to.merge_order.resize(first_voxel); // blocks without have no order anywhere
        append_to(to.merge_order, block.merge_order);
        to.merge_order.resize(to.coverage.size());
    }
}

void LevelLookup::fill_slots(Level& level) {
    if (level.leaves.size() >= std::size_t{1} << 31) {
        throw Error(ErrorCode::InvalidArgument,
                    str("lookup: ", level.leaves.size(), " leaves in a level (limit 2^31 - 1)"),
                    "use a larger voxel size");
    }
    level.slots.assign(std::bit_ceil(2 * level.leaves.size() + 1), LevelView::kNone);
    const std::size_t mask = level.slots.size() - 1;
    for (std::size_t n = 0; n < level.leaves.size(); ++n) {
        std::size_t i = LevelView::hash(level.leaves[n].origin) & mask;
        while (level.slots[i] != LevelView::kNone) i = (i + 1) & mask;
        level.slots[i] = static_cast<std::uint32_t>(n);
    }
}

LevelView LevelLookup::view(int level) const {
    const Level& of = at(level);
    LevelView out;
    out.slots = of.slots;
    out.leaves = of.leaves;
    out.coverage = of.arrays.coverage;
    out.lobe_place = of.lobe_place;
    out.lobes = of.arrays.lobes;
    out.maps = of.arrays.maps;
    out.tangents = of.arrays.tangents;
    out.merge_order = of.arrays.merge_order;
    out.footprints = of.arrays.footprints;
    out.correlation = of.arrays.correlation;
    return out;
}

std::optional<VoxelView> LevelLookup::find_index(int level, Vec3i finest) const {
    return view(level).find({finest.x >> level, finest.y >> level, finest.z >> level});
}

std::optional<VoxelView> LevelLookup::find(int level, Vec3d position) const {
    const std::optional<Vec3i> index = finest_index(at(0).info.lattice, position);
    return index ? find_index(level, *index) : std::nullopt;
}

LevelSample LevelLookup::sample(Vec3d position, float level) const {
    LevelSample out;
    out.weights = weights_of_level(level, level_count());
    const std::optional<Vec3i> index = finest_index(at(0).info.lattice, position);
    if (!index) return out;
    out.floor = find_index(out.weights.floor, *index);
    out.ceiling = out.weights.ceiling == out.weights.floor
                      ? out.floor
                      : find_index(out.weights.ceiling, *index);
    return out;
}

std::int64_t LevelLookup::byte_count() const {
    std::int64_t sum = 0;
    for (const Level& level : levels_) {
        sum += level.arrays.byte_count() +
               static_cast<std::int64_t>(level.leaves.capacity() * sizeof(LookupLeaf) +
                                         level.slots.capacity() * sizeof(std::uint32_t) +
                                         level.lobe_place.capacity() * sizeof(std::uint16_t));
    }
    return sum;
}

} // namespace heddle
