#include <heddle/io/vdb/level_reader.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/io/vdb/grid_reader.h>
#include <heddle/io/vdb/level_grids.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <cstring>
#include <tuple>

namespace heddle {
namespace {

using Leaf = GridLeaves::Leaf;

auto key(Vec3i v) {
    return std::tuple(v.x, v.y, v.z);
}

/// Reads the values of one leaf, in step with the voxels of another grid.
class LeafCursor {
public:
    LeafCursor(const GridLeaves& grid, Vec3i origin) {
        const auto at =
            std::lower_bound(grid.leaves.begin(), grid.leaves.end(), origin,
                             [](const Leaf& leaf, Vec3i o) { return key(leaf.origin) < key(o); });
        if (at == grid.leaves.end() || !(at->origin == origin)) return;
        leaf_ = &*at;
        next_ = grid.values.data() + at->first * grid.value_bytes;
    }
    [[nodiscard]] bool active(std::size_t x, int bit) const {
        return leaf_ != nullptr && ((leaf_->active[x] >> bit) & 1) != 0;
    }
    /// Returns the next value; call it at most once for each active voxel.
    template <typename T>
    T take() {
        T value{};
        std::memcpy(&value, next_, sizeof(T));
        next_ += sizeof(T);
        return value;
    }

private:
    const Leaf* leaf_ = nullptr;
    const std::byte* next_ = nullptr;
};

/// Resizes the arrays that the fields require.
void size_arrays(VoxelBlock& block, const LevelGrids& of) {
    const std::size_t voxels = block.coverage.size(), lobes = block.lobes.size();
    const bool masks = has_masks(of.fields, of.level);
    const auto three = [](std::uint8_t n) { return n > 2; };
    if (of.fields.maps()) block.maps.resize(lobes);
    if (of.fields.tangents) block.tangents.resize(lobes);
    if (masks) block.columns.resize(voxels);
    if (masks) block.moments.resize(lobes);
    if (masks && of.fields.map_sums()) block.map_sums.resize(lobes);
    if (of.fields.footprints != 0) block.footprints.resize(voxels);
    if (of.fields.occupancy) block.occupancy.resize(voxels);
    if (of.fields.correlation) block.correlation.resize(voxels);
    if (of.fields.slabs) block.slabs.resize(voxels);
    if (of.merge && std::any_of(block.lobe_count.begin(), block.lobe_count.end(), three)) {
        block.merge_order.resize(voxels);
    }
    block.shrink_to_fit();
}

class LevelReader {
public:
    LevelReader(const std::string& path, const VdbContents& file, const VoxelLevelInfo& info)
        : path_(path), file_(file), grid_(std::make_unique<MemoryLevel>()) {
        grid_->set_info(info);
    }

    std::unique_ptr<MemoryLevel> run() {
        const VoxelLevelInfo& info = grid_->info();
        const int lobes = read_lobes();
        const LevelGrids of{info.level, info.fields, lobes,
                            file_.find(grid_name(GridKind::Merge, 0, info.level)) != nullptr};
        for (VoxelBlock& block : grid_->blocks) size_arrays(block, of);
        for_each_grid(of, [&](const std::string& name, const auto& values) {
            using Values = std::decay_t<decltype(values)>;
            constexpr bool kThere =
                std::is_same_v<Values, CoverageValues> || std::is_same_v<Values, LobeValues>;
            if constexpr (!kThere) fill(name, values);
        });
        if (of.merge) check_merges();
        if (of.fields.slabs) check_slabs();
        return std::move(grid_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::BadFile, what, "write it again with heddle", {.path = path_});
    }
    [[noreturn]] void fail_at(const std::string& what, std::size_t x, int bit, Vec3i origin) const {
        fail(str("voxel (", origin.x + static_cast<int>(x), ", ", origin.y + (bit >> 3), ", ",
                 origin.z + (bit & 7), ")",
                 grid_->info().level > 0 ? str(" of level ", grid_->info().level) : "", " ", what));
    }

    template <typename Values>
    [[nodiscard]] GridLeaves read(const std::string& name, const Values&) const {
        const GridEntry* entry = file_.find(name);
        if (entry == nullptr) fail(str("grid '", name, "' is missing"));
        GridLeaves grid = read_grid(path_, *entry);
        if (grid.value_bytes != sizeof(typename Values::Value)) {
            fail(str("grid '", name, "' has values of ", grid.value_bytes,
                     " bytes (needed: ", sizeof(typename Values::Value), ")"));
        }
        return grid;
    }

    /// Makes the blocks with their voxels and lobes only.
    /// @return  the largest number of lobes of a voxel
    int read_lobes() {
        const VoxelLevelInfo& info = grid_->info();
        const GridLeaves coverage =
            read(grid_name(GridKind::Coverage, 0, info.level), CoverageValues{});
        std::vector<GridLeaves> lobes;
        std::size_t in_grids = 0;
        const auto name = [&](std::size_t k) {
            return grid_name(GridKind::Lobe, static_cast<int>(k), info.level);
        };
        while (lobes.size() < 8 && file_.find(name(lobes.size())) != nullptr) {
            lobes.push_back(read(name(lobes.size()), LobeValues{}));
            in_grids += lobes.back().size();
        }
        if (lobes.empty() && coverage.size() > 0) fail(str("grid '", name(0), "' is missing"));
        make_blocks(coverage, lobes);
        check_counts(in_grids);
        return static_cast<int>(lobes.size());
    }

    /// Makes one block for each cell of 32^3 voxels that contains any.
    void make_blocks(const GridLeaves& coverage, const std::vector<GridLeaves>& lobes) {
        const auto cell = [&](std::size_t i) {
            const Vec3i at = coverage.leaves[i].origin;
            return std::tuple(at.x >> 5, at.y >> 5, at.z >> 5);
        };
        std::vector<std::size_t> order(coverage.leaves.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return cell(a) < cell(b); });
        std::vector<std::size_t> first;
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i == 0 || cell(order[i]) != cell(order[i - 1])) first.push_back(i);
        }
        first.push_back(order.size());
        grid_->blocks.resize(first.size() - 1);
        parallel_chunks(grid_->blocks.size(), 1, [&](std::size_t b, std::size_t) {
            for (std::size_t i = first[b]; i < first[b + 1]; ++i) {
                add_leaf(grid_->blocks[b], coverage, lobes, coverage.leaves[order[i]]);
            }
        });
    }

    void add_leaf(VoxelBlock& block,
                  const GridLeaves& coverage,
                  const std::vector<GridLeaves>& lobes,
                  const Leaf& leaf) const {
        block.leaves.push_back({leaf.origin, leaf.active,
                                static_cast<std::uint32_t>(block.coverage.size()),
                                static_cast<std::uint32_t>(block.lobes.size())});
        LeafCursor covered(coverage, leaf.origin);
        std::vector<LeafCursor> cursors;
        for (const GridLeaves& of : lobes) cursors.emplace_back(of, leaf.origin);
        for_each_active(leaf.active, [&](std::size_t x, int bit) {
            std::size_t n = 0;
            for (; n < cursors.size() && cursors[n].active(x, bit); ++n) {
                block.lobes.push_back(cursors[n].take<Lobe>());
                check_lobe(block.lobes.back(), x, bit, leaf.origin);
            }
            if (n == 0) fail_at("has coverage and no lobe", x, bit, leaf.origin);
            block.coverage.push_back(covered.take<Coverage>());
            block.lobe_count.push_back(static_cast<std::uint8_t>(n));
        });
    }

    void check_lobe(const Lobe& lobe, std::size_t x, int bit, Vec3i origin) const {
        const std::size_t materials = grid_->info().materials.size();
        if (lobe.weight == 0) fail_at("has a lobe of weight 0 (allowed: 1 to 255)", x, bit, origin);
        if (lobe.material >= materials) {
            fail_at(str("names material ", int{lobe.material}, " of ", materials), x, bit, origin);
        }
        if (!is_positive_definite(lobe.sggx)) {
            fail_at("has a lobe that is not positive definite", x, bit, origin);
        }
    }

    void check_counts(std::size_t lobes_in_grids) const {
        const VoxelLevelInfo& info = grid_->info();
        const std::string level = info.level > 0 ? str("level ", info.level, " ") : "";
        std::int64_t voxels = 0, lobes = 0;
        for (const VoxelBlock& b : grid_->blocks) {
            voxels += static_cast<std::int64_t>(b.coverage.size());
            lobes += static_cast<std::int64_t>(b.lobes.size());
        }
        if (static_cast<std::size_t>(lobes) != lobes_in_grids) {
            fail(str(level, "has ", lobes_in_grids, " lobes, of which ", lobes,
                     " belong to voxels"));
        }
        if (voxels != info.voxel_count || lobes != info.lobe_count) {
            fail(str(level, "holds ", voxels, " voxels and ", lobes, " lobes, the metadata says ",
                     info.voxel_count, " and ", info.lobe_count));
        }
    }

    /// Reads a grid into the voxels that must be active in it.
    template <typename Values>
    void fill(const std::string& name, const Values& values) {
        const GridLeaves grid = read(name, values);
        const auto put = [&](std::size_t begin, std::size_t end) {
            std::size_t taken = 0;
            for (std::size_t b = begin; b < end; ++b) {
                taken += fill_block(grid_->blocks[b], grid, name, values);
            }
            return taken;
        };
        const std::size_t taken =
            reduce_chunks(grid_->blocks.size(), 1, std::size_t{0}, put, std::plus<std::size_t>());
        if (taken != grid.size()) {
            fail(str("grid '", name, "' has ", grid.size(), " values, of which ", taken,
                     " belong to voxels"));
        }
    }

    template <typename Values>
    std::size_t fill_block(VoxelBlock& block,
                           const GridLeaves& grid,
                           const std::string& name,
                           const Values& values) const {
        std::size_t taken = 0;
        for (const VoxelLeaf& leaf : block.leaves) {
            LeafCursor cursor(grid, leaf.origin);
            for_each_in_grid(
                block, leaf, values, [&](std::size_t x, int bit, std::size_t v, std::size_t l) {
                    if (!cursor.active(x, bit)) {
                        fail_at(str("has no value in grid '", name, "'"), x, bit, leaf.origin);
                    }
                    values.put(block, v, l, cursor.take<typename Values::Value>());
                    ++taken;
                });
        }
        return taken;
    }

    void check_merges() const {
        const auto check = [&](const VoxelBlock& block, const VoxelLeaf& leaf) {
            for_each_in_grid(block, leaf, MergeValues{},
                             [&](std::size_t x, int bit, std::size_t v, std::size_t) {
                                 for (int lobe = 2; lobe < block.lobe_count[v]; ++lobe) {
                                     const int target = merge_target(block.merge_order[v], lobe);
                                     if (target < lobe) continue;
                                     fail_at(str("merges lobe ", lobe, " into lobe ", target,
                                                 " (allowed: 0 to ", lobe - 1, ")"),
                                             x, bit, leaf.origin);
                                 }
                             });
        };
        for (const VoxelBlock& block : grid_->blocks) {
            for (const VoxelLeaf& leaf : block.leaves) check(block, leaf);
        }
    }

    void check_slabs() const {
        for (const VoxelBlock& block : grid_->blocks) {
            for (const VoxelLeaf& leaf : block.leaves) {
                for_each_in_grid(block, leaf, SlabValues{},
                                 [&](std::size_t x, int bit, std::size_t v, std::size_t) {
                                     const PlaneSlab& slab = block.slabs[v];
                                     if (slab.lo <= slab.hi) return;
                                     fail_at(str("has planes ", int{slab.lo}, " and ", int{slab.hi},
                                                 " (allowed: ascending)"),
                                             x, bit, leaf.origin);
                                 });
            }
        }
    }

    const std::string& path_;
    const VdbContents& file_;
    std::unique_ptr<MemoryLevel> grid_;
};

} // namespace

std::unique_ptr<MemoryLevel>
read_level(const std::string& path, const VdbContents& file, const VoxelLevelInfo& info) {
    return LevelReader(path, file, info).run();
}

} // namespace heddle
