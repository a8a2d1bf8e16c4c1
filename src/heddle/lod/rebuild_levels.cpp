#include <heddle/lod/rebuild_levels.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/leaf_table/leaf_table.h>
#include <heddle/voxel/z_order.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace heddle {
namespace {

/// Replaces the coverage, footprints and correlation in `made` by those of `old`.
/// @throws Error  BadFile: the old level has other voxels
void keep_columns(const VoxelLevel& old, VoxelLevel& made) {
    std::vector<VoxelBlock>* const blocks = made.blocks_in_memory();
    if (blocks == nullptr) return;
    LeafTable<3> table;
    std::vector<std::pair<std::size_t, std::size_t>> leaves; // block, number in the block
    VoxelBlock scratch;
    for (std::size_t b = 0; b < old.block_count(); ++b) {
        const VoxelBlock& block = old.block(b, scratch);
        for (std::size_t i = 0; i < block.leaves.size(); ++i) {
            table.add(block.leaves[i].origin);
            leaves.emplace_back(b, i);
        }
    }
    VoxelLevelInfo info = made.info();
    VoxelFields& fields = info.fields;
    fields.footprints = old.info().fields.footprints;
    fields.correlation = old.info().fields.correlation;
    made.set_info(info);
    for (VoxelBlock& block : *blocks) {
        if (fields.footprints != 0) block.footprints.resize(block.coverage.size());
        if (fields.correlation) block.correlation.resize(block.coverage.size());
        for (const VoxelLeaf& leaf : block.leaves) {
            const std::uint32_t number = table.find(leaf.origin).leaf;
            const VoxelBlock* from = nullptr;
            const VoxelLeaf* old_leaf = nullptr;
            if (number != LeafTable<3>::kNone) {
                from = &old.block(leaves[number].first, scratch);
                old_leaf = &from->leaves[leaves[number].second];
            }
            if (old_leaf == nullptr || old_leaf->active != leaf.active) {
                throw Error(ErrorCode::BadFile,
                            str("lod: level ", old.info().level, " of '", old.info().name,
                                "' has other voxels than its level 0"),
                            "voxelize it again");
            }
            const auto copy = [&](const auto& of, auto& to) {
                if (to.empty()) return;
                std::copy_n(of.begin() + old_leaf->first_voxel, leaf.voxel_count(),
                            to.begin() + leaf.first_voxel);
            };
            copy(from->coverage, block.coverage);
            copy(from->footprints, block.footprints);
            copy(from->correlation, block.correlation);
        }
    }
}

/// Removes footprints and correlation from a level.
void drop_shared(VoxelLevel& level) {
    VoxelLevelInfo info = level.info();
    info.fields.footprints = 0;
    info.fields.correlation = false;
    level.set_info(std::move(info));
    std::vector<VoxelBlock>* const blocks = level.blocks_in_memory();
    if (blocks == nullptr) return;
    for (VoxelBlock& block : *blocks) {
        block.footprints = {};
        block.correlation = {};
    }
}

/// The blocks of a level in Z-order, with their indices.
struct SourceOrder {
    std::vector<std::size_t> number;
    std::vector<Vec3i> index;

    explicit SourceOrder(const VoxelLevel& source) {
        std::vector<std::pair<Vec3i, std::size_t>> all;
        VoxelBlock scratch;
        for (std::size_t b = 0; b < source.block_count(); ++b) {
            const VoxelBlock& block = source.block(b, scratch);
            if (block.leaves.empty()) continue;
            const auto cell = [](Vec3i o) { return Vec3i{o.x >> 5, o.y >> 5, o.z >> 5}; };
            const Vec3i here = cell(block.leaves[0].origin);
            for (const VoxelLeaf& leaf : block.leaves) {
                if (cell(leaf.origin) == here) continue;
                throw Error(ErrorCode::Internal,
                            "lod: a block does not lie in a cell of 32^3 voxels");
            }
            all.emplace_back(here, b);
        }
        std::sort(all.begin(), all.end(),
                  [](const auto& a, const auto& b) { return z_order_less(a.first, b.first); });
        for (const auto& [at, b] : all) {
            index.push_back(at);
            number.push_back(b);
        }
    }
};

} // namespace

VoxelLevels
rebuild_levels(VoxelLevels old, const LodOptions& options, bool exact, Progress& progress) {
    const VoxelLevel& finest = *old.at(0);
    const bool masks = finest.info().fields.masks;
    if (exact && !masks) {
        throw Error(ErrorCode::InvalidArgument,
                    str("lod: '", finest.info().name, "' was stored without columns and sums"),
                    "voxelize it with --keep-masks, or leave out --exact");
    }
    const SourceOrder order(finest);
    LevelBuilder builder(options, masks);
    builder.begin(finest.info(), order.index, {});
    progress.begin("levels", "voxels", finest.info().voxel_count);
    parallel_chunks(order.number.size(), 1, [&](std::size_t i, std::size_t) {
        progress.check();
        VoxelBlock scratch;
        const VoxelBlock& block = finest.block(order.number[i], scratch);
        builder.visit(i, block);
        progress.advance(static_cast<std::int64_t>(block.coverage.size()));
    });
    VoxelLevels levels = builder.finish(std::move(old[0]));
    const bool naive = options.method == LodMethod::Naive;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        VoxelLevelInfo info = levels[l]->info();
        info.approximate = !masks && levels.size() > 1;
        levels[l]->set_info(std::move(info));
        if (masks || naive || l == 0 || l >= old.size()) continue;
        keep_columns(*old[l], *levels[l]);
    }
    if (naive || (!masks && old.size() < levels.size())) { // some levels cannot have these fields
        for (const auto& level : levels) drop_shared(*level);
    }
    return levels;
}

} // namespace heddle
