#include <heddle/lod/build_levels.h>

#include <heddle/base/error.h>
#include <heddle/base/object_pool.h>
#include <heddle/base/parallel.h>
#include <heddle/lod/built_block.h>
#include <heddle/lod/correlation.h>
#include <heddle/lod/join_pieces.h>
#include <heddle/voxel/block_store.h>
#include <heddle/voxel/index_box.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <tuple>

namespace heddle {
namespace {

/// The coarsest level on which one block consists of whole leaves.
constexpr int kWholeLeafLevel = 2;

/// CPU seconds for all levels, per voxel of level 0: measured on the sweater of 1024 voxels.
constexpr double kSecondsPerVoxel = 6e-7;

CoverageRule rule_of(LodMethod method, bool with_columns) {
    if (method == LodMethod::Naive) return CoverageRule::Mean;
    return with_columns ? CoverageRule::Union : CoverageRule::Product;
}

LevelOptions
level_options(const LodOptions& options, const VoxelLevelInfo& info, bool with_columns) {
    LevelOptions out;
    out.fields = info.fields;
    out.fields.masks = false;
    if (!with_columns || options.method == LodMethod::Naive) {
        out.fields.footprints = 0;
        out.fields.correlation = false;
    }
    out.merge = {.method = options.method,
                 .max_lobes = options.max_lobes > 0 ? options.max_lobes : info.max_lobes,
                 .with_maps = info.fields.map_sums()};
    out.coverage = rule_of(options.method, with_columns);
    out.lattice = info.lattice;
    out.seed = options.seed;
    for (std::uint32_t m = 0; m < std::min<std::size_t>(info.materials.size(), 256); ++m) {
        if (info.materials[m].kind == MaterialKind::Surface) out.normals.add(m);
    }
    return out;
}

/// Returns the box of a level's open voxels.
IndexBox box_of(const OpenLevel& level) {
    IndexBox box;
    const int n = level.edge();
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            for (int z = 0; z < n; ++z) {
                if (level.slot[level.cell({x, y, z})] == OpenLevel::kNone) continue;
                box.grow(level.origin + Vec3i{x, y, z});
            }
        }
    }
    return box;
}

/// The buffers of one thread, reused from block to block.
struct Workspace {
    std::array<OpenLevel, kBlockLevel + 1> level;
    LobePool pool;
    RecentFits fits;

    /// Builds levels 0 to `top` of a block.
    void build(const VoxelBlock& block, Vec3i index, int top, const LevelOptions& options) {
        open_block(block, index, options, level[0]);
        for (int l = 1; l <= top; ++l) {
            OpenLevel& here = level[static_cast<std::size_t>(l)];
            here.reset(l, index);
            build_level(level[static_cast<std::size_t>(l - 1)], options, pool, here);
        }
    }
    [[nodiscard]] std::int64_t byte_count() const {
        std::size_t sum = sizeof(*this);
        for (const OpenLevel& l : level) {
            sum += l.slot.capacity() * sizeof(std::uint16_t) +
                   l.voxels.capacity() * sizeof(OpenVoxel) +
                   l.columns.capacity() * sizeof(std::uint64_t) +
                   l.lobes.capacity() * sizeof(DirectionSums) + l.maps.capacity() * sizeof(MapSums);
        }
        return static_cast<std::int64_t>(sum);
    }
};

std::unique_ptr<MemoryLevel> make_grid(const VoxelLevelInfo& info, std::vector<VoxelBlock> blocks) {
    auto grid = std::make_unique<MemoryLevel>();
    grid->info() = info;
    grid->info().voxel_count = 0;
    grid->info().lobe_count = 0;
    for (const VoxelBlock& b : blocks) {
        grid->info().voxel_count += static_cast<std::int64_t>(b.coverage.size());
        grid->info().lobe_count += static_cast<std::int64_t>(b.lobes.size());
    }
    grid->blocks = std::move(blocks);
    return grid;
}

bool has_correlation(const std::vector<VoxelBlock>& blocks) {
    return std::any_of(blocks.begin(), blocks.end(),
                       [](const VoxelBlock& b) { return !b.correlation.empty(); });
}

std::int64_t count_leaves(const OpenLevel& level) {
    const int n = level.edge();
    std::array<bool, 64> there{};
    for (int i = 0; i < n * n * n; ++i) {
        if (level.slot[static_cast<std::size_t>(i)] == OpenLevel::kNone) continue;
        there[static_cast<std::size_t>(((i / (n * n)) >> 3) * 16 + ((i / n % n) >> 3) * 4 +
                                       ((i % n) >> 3))] = true;
    }
    return std::count(there.begin(), there.end(), true);
}

/// Returns the number of cubes of 2^shift blocks per axis that contain a block.
std::int64_t count_cells(std::span<const Vec3i> blocks, int shift) {
    std::set<std::tuple<int, int, int>> cells;
    for (const Vec3i& b : blocks) cells.emplace(b.x >> shift, b.y >> shift, b.z >> shift);
    return static_cast<std::int64_t>(cells.size());
}

/// Returns the number of rows of blocks, summed over the axes: the size of the silhouettes that the
/// columns of large voxels store.
std::int64_t count_rows(std::span<const Vec3i> blocks) {
    std::int64_t sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::set<std::pair<int, int>> rows;
        for (const Vec3i& b : blocks) rows.emplace(b[axis == 0 ? 1 : 0], b[axis == 2 ? 1 : 2]);
        sum += static_cast<std::int64_t>(rows.size());
    }
    return sum;
}

} // namespace

int level_count(Vec3i lo, Vec3i hi) {
    int level = 0;
    const auto wide = [&](int a) { return (hi[a] >> level) - (lo[a] >> level) + 1 > 2; };
    while (level < kMaxLevel && (wide(0) || wide(1) || wide(2))) ++level;
    return level;
}

struct LevelBuilder::Impl {
    VoxelLevelInfo info;
    LevelOptions options;
    int top = 0; ///< coarsest level that is built, judged by the blocks alone
    std::vector<Vec3i> blocks;
    std::vector<std::unique_ptr<BlockStore>> whole; ///< levels 1 to kWholeLeafLevel
    std::vector<std::vector<VoxelBlock>> pieces;    ///< the levels above, from kWholeLeafLevel + 1
    std::unique_ptr<UpperLevels> upper;
    ObjectPool<Workspace> workspaces;
    std::mutex mutex;
    IndexBox box;
    double seconds = 0.0;
    std::array<std::vector<KeptColumns>, kBlockLevel + 1> kept; ///< with fields.correlation

    void store(int level, std::size_t number, VoxelBlock& block) {
        if (level <= kWholeLeafLevel) {
            whole[static_cast<std::size_t>(level - 1)]->keep(number, block);
        } else {
            block.shrink_to_fit();
            pieces[static_cast<std::size_t>(level - kWholeLeafLevel - 1)][number] =
                std::move(block);
        }
    }
};

struct LevelBuilder::Sample {
    std::mutex mutex;
    ObjectPool<Workspace> workspaces;
    std::array<LevelSize, kBlockLevel> level; ///< levels 1 to kBlockLevel
    std::int64_t workspace_bytes = 0;         ///< of the largest workspace
};

LevelBuilder::LevelBuilder(const LodOptions& options, bool with_columns)
    : options_(options), with_columns_(with_columns), sample_(std::make_unique<Sample>()) {
    if (options.max_lobes < 0 || options.max_lobes > kMaxLobes) {
        throw Error(ErrorCode::InvalidArgument, str("lod: lobes is ", options.max_lobes),
                    str("use 1 to ", kMaxLobes));
    }
}

LevelBuilder::~LevelBuilder() = default;

void LevelBuilder::begin(const VoxelLevelInfo& info,
                         std::span<const Vec3i> blocks,
                         const std::string& spool_dir) {
    impl_ = std::make_unique<Impl>();
    Impl& s = *impl_;
    s.info = info;
    s.options = level_options(options_, info, with_columns_);
    s.blocks.assign(blocks.begin(), blocks.end());
    IndexBox box;
    for (const Vec3i& b : blocks) {
        box.grow(IndexBox{b * kBlockVoxels, b * kBlockVoxels + Vec3i{31, 31, 31}});
    }
    s.top = blocks.empty() ? 0 : std::min(options_.max_levels, level_count(box.lo, box.hi));
    for (int l = 1; l <= s.top; ++l) {
        if (l <= kWholeLeafLevel) {
            VoxelLevelInfo of = info;
            of.fields = s.options.fields;
            s.whole.push_back(
                std::make_unique<BlockStore>(of, blocks.size(), !spool_dir.empty(), spool_dir));
        } else if (l <= kBlockLevel) {
            s.pieces.emplace_back(blocks.size());
        }
    }
    s.upper = std::make_unique<UpperLevels>(
        blocks, s.top, s.options,
        [&s](int level, std::size_t number, VoxelBlock& block) { s.store(level, number, block); });
    for (int l = kBlockLevel + 1; l <= s.top; ++l) s.pieces.emplace_back(s.upper->count(l));
    if (s.options.fields.correlation) {
        for (std::vector<KeptColumns>& of_level : s.kept) of_level.resize(blocks.size());
    }
}

void LevelBuilder::visit(std::size_t rank, const VoxelBlock& block) {
    Impl& s = *impl_;
    const auto start = std::chrono::steady_clock::now();
    std::unique_ptr<UpperVoxel> top;
    s.workspaces.with([&](Workspace& work) {
        const int last = std::min(s.top, kBlockLevel);
        work.build(block, s.blocks[rank], last, s.options);
        for (int l = 1; l <= last; ++l) {
            const auto at = static_cast<std::size_t>(l);
            VoxelBlock stored;
            store_level(work.level[at], s.options, work.pool, work.fits, stored,
                        s.options.fields.correlation ? &s.kept[at][rank] : nullptr);
            s.store(l, rank, stored);
        }
        if (s.options.fields.correlation) { // level 0 is opened in the stored order
            s.kept[0][rank] = work.level[0].columns;
        }
        if (s.top > kBlockLevel) top = take_upper(work.level[kBlockLevel]);
        const IndexBox box = box_of(work.level[0]);
        const std::scoped_lock lock(s.mutex);
        s.box.grow(box);
    });
    s.upper->take(rank, std::move(top));
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    const std::scoped_lock lock(s.mutex);
    s.seconds += spent.count();
}

const LevelOptions* LevelBuilder::options_of_built() const {
    const LevelOptions& options = impl_->options;
    const bool can = options.merge.method == LodMethod::Moments &&
                     options.coverage == CoverageRule::Union && !options.fields.correlation;
    return can ? &options : nullptr;
}

int LevelBuilder::built_levels() const {
    return std::min(impl_->top, kBlockLevel);
}

bool LevelBuilder::wants_top() const {
    return impl_->top > kBlockLevel;
}

void LevelBuilder::accept(std::size_t rank, const VoxelBlock& block, BuiltBlock& built) {
    Impl& s = *impl_;
    const auto start = std::chrono::steady_clock::now();
    for (int l = 1; l <= built_levels(); ++l) {
        s.store(l, rank, built.level[static_cast<std::size_t>(l - 1)]);
    }
    s.upper->take(rank, std::move(built.top));
    IndexBox box;
    for (const VoxelLeaf& leaf : block.leaves) box.grow(box_of(leaf));
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    const std::scoped_lock lock(s.mutex);
    s.box.grow(box);
    s.seconds += spent.count();
}

double LevelBuilder::visit_seconds() const {
    return impl_ ? impl_->seconds : 0.0;
}

/// Fills the correlation of a level's voxels and frees the level's columns.
void LevelBuilder::fill_shared(int level, std::span<VoxelBlock> blocks) {
    Impl& s = *impl_;
    if (!s.options.fields.correlation) return;
    const double edge = std::ldexp(static_cast<double>(s.options.lattice.subvoxels), level);
    if (level > kBlockLevel) {
        fill_upper_correlation(s.upper->index_of(level), blocks, s.upper->take_columns(level),
                               edge * edge);
        return;
    }
    std::vector<KeptColumns>& kept = s.kept[static_cast<std::size_t>(level)];
    fill_correlation(s.blocks, blocks, kept, level, edge * edge);
    kept = {};
}

VoxelLevels LevelBuilder::finish(std::unique_ptr<VoxelLevel> level0) {
    Impl& s = *impl_;
    VoxelLevels levels;
    levels.push_back(std::move(level0));
    const int needed = s.box.empty() ? 0 : level_count(s.box.lo, s.box.hi);
    const int top = std::min(s.top, needed);
    std::vector<VoxelBlock>* const finest = levels[0]->blocks_in_memory();
    if (finest != nullptr && !has_correlation(*finest)) fill_shared(0, *finest);
    for (int l = 1; l <= top; ++l) {
        std::unique_ptr<VoxelLevel> made;
        if (l <= kWholeLeafLevel) {
            made = s.whole[static_cast<std::size_t>(l - 1)]->finish();
            if (auto* const blocks = made->blocks_in_memory()) fill_shared(l, *blocks);
        } else {
            const auto at = static_cast<std::size_t>(l - kWholeLeafLevel - 1);
            fill_shared(l, s.pieces[at]);
            made = make_grid(s.info, join_pieces(std::move(s.pieces[at])));
        }
        levels.push_back(std::move(made));
    }
    for (std::size_t l = 0; l < levels.size(); ++l) {
        VoxelLevelInfo info = levels[l]->info();
        info.level = static_cast<std::int32_t>(l);
        info.lattice = lattice_of_level(s.info.lattice, static_cast<int>(l));
        info.lod = top > 0 ? name_of(options_.method) : "";
        if (l > 0) info.fields = s.options.fields;
        info.max_lobes = l > 0 ? s.options.merge.max_lobes : info.max_lobes;
        levels[l]->set_info(std::move(info));
    }
    return levels;
}

namespace {

/// Bytes per block of the pieces of leaves and nodes that are held on the levels above the blocks.
constexpr std::int64_t kPieceBytes = 700;

/// Predicts the size of each level: up to kBlockLevel from the sampled blocks, above by counting
/// the ancestors of the blocks.
/// @param sample  sums over the sampled blocks of levels 1 to kBlockLevel
std::vector<LevelSize>
predict_levels(std::span<const LevelSize> sample, const LevelPlanInput& input, int top) {
    const auto scaled = [&](std::int64_t n) {
        return static_cast<std::int64_t>(static_cast<double>(n) * input.scale + 0.5);
    };
    std::vector<LevelSize> levels;
    double lobes_per_voxel = 1.0;
    for (int l = 1; l <= top; ++l) {
        LevelSize& level = levels.emplace_back();
        if (l <= kBlockLevel) {
            const LevelSize& seen = sample[static_cast<std::size_t>(l - 1)];
            level = {scaled(seen.leaves), scaled(seen.voxels), scaled(seen.lobes)};
            if (seen.voxels > 0) {
                lobes_per_voxel =
                    static_cast<double>(seen.lobes) / static_cast<double>(seen.voxels);
            }
        } else {
            level.voxels = count_cells(input.blocks, l - kBlockLevel);
            level.lobes =
                static_cast<std::int64_t>(static_cast<double>(level.voxels) * lobes_per_voxel);
        }
        if (l > kWholeLeafLevel) level.leaves = count_cells(input.blocks, l - kWholeLeafLevel);
    }
    return levels;
}

/// Returns the bytes of the columns of unfinished voxels above the blocks: of two voxels per level.
std::int64_t predict_open_columns(std::span<const Vec3i> blocks, int top) {
    const std::int64_t rows = count_rows(blocks);
    std::int64_t runs = 0;
    for (int l = kBlockLevel; l <= top; ++l) {
        const std::int64_t whole = std::int64_t{3} << (2 * std::min(l - kBlockLevel, 20));
        runs += 2 * std::min(whole, rows);
    }
    return runs * static_cast<std::int64_t>(sizeof(UpperVoxel::Run::element_type));
}

/// Returns the bytes of all columns of all levels, which are kept to the end for the correlation.
std::int64_t predict_kept_columns(const LevelPlanInput& input,
                                  const std::vector<LevelSize>& levels) {
    if (!input.correlation) return 0;
    const auto column_bytes = [](int level) { return std::int64_t{24} << (2 * level); };
    const auto voxels = [&](int level) {
        return levels[static_cast<std::size_t>(level - 1)].voxels;
    };
    const int top = static_cast<int>(levels.size());
    std::int64_t kept = column_bytes(0) * input.voxels;
    for (int l = 1; l <= std::min(top, kBlockLevel); ++l) kept += column_bytes(l) * voxels(l);
    if (top > kBlockLevel) { // each level above needs at most half of the memory of the level below
        kept += column_bytes(kBlockLevel) * voxels(kBlockLevel);
    }
    return kept;
}

} // namespace

void LevelBuilder::sample(const VoxelLevelInfo& info, Vec3i index, const VoxelBlock& block) {
    const LevelOptions options = level_options(options_, info, with_columns_);
    sample_->workspaces.with([&](Workspace& work) {
        const int last = std::min(options_.max_levels, kBlockLevel);
        work.build(block, index, last, options);
        const std::scoped_lock lock(sample_->mutex);
        for (int l = 1; l <= last; ++l) {
            LevelSize& plan = sample_->level[static_cast<std::size_t>(l - 1)];
            const OpenLevel& level = work.level[static_cast<std::size_t>(l)];
            plan.voxels += static_cast<std::int64_t>(level.voxels.size());
            plan.lobes += static_cast<std::int64_t>(level.lobes.size());
            plan.leaves += count_leaves(level);
        }
        sample_->workspace_bytes = std::max(sample_->workspace_bytes, work.byte_count());
    });
}

LevelPlan LevelBuilder::plan(const LevelPlanInput& input) {
    const int top =
        std::min(options_.max_levels, level_count(input.voxel_lo, input.voxel_hi - Vec3i{1, 1, 1}));
    LevelPlan plan;
    plan.levels = predict_levels(sample_->level, input, top);
    const auto blocks = static_cast<std::int64_t>(input.blocks.size());
    plan.workspace_bytes = predict_kept_columns(input, plan.levels) +
                           thread_count() * sample_->workspace_bytes +
                           predict_open_columns(input.blocks, top) +
                           blocks * kPieceBytes * std::clamp(top - kWholeLeafLevel, 0, 4);
    plan.thread_seconds = top > 0 ? kSecondsPerVoxel * static_cast<double>(input.voxels) : 0.0;
    return plan;
}

} // namespace heddle
