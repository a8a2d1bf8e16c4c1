#include <heddle/raster/rasterize_bricks.h>

#include <heddle/base/error.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace heddle::raster {
namespace {

constexpr std::size_t kBrickBytes = kBrickWords * sizeof(std::uint32_t);
constexpr std::size_t kBlockBricks = 64; ///< largest number of bricks of a block
constexpr std::size_t kTriedBlocks = 16; ///< number of blocks on which paths are timed

std::vector<std::uint32_t> materials_of(std::span<const slice::SliceChunk> chunks) {
    std::vector<std::uint32_t> out;
    for (const slice::SliceChunk& c : chunks) out.push_back(c.material);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

std::size_t
capacity_of(const opengl::Context& context, const DrawOptions& options, std::size_t materials) {
    const std::int64_t max_bytes =
        std::min<std::int64_t>(context.limits().storage_bytes, options.memory_bytes) /
        static_cast<std::int64_t>(std::max<std::size_t>(materials, 1));
    const std::size_t fit =
        std::max(static_cast<std::size_t>(max_bytes) / kBrickBytes, kBlockBricks);
    return std::min(fit, static_cast<std::size_t>(options.bricks));
}

std::uint32_t most_slices(std::span<const slice::SliceChunk> chunks) {
    std::uint32_t max_count = 0;
    for (const slice::SliceChunk& c : chunks) max_count = std::max(max_count, c.count);
    return max_count;
}

void check_last(std::span<const slice::SliceChunk> chunks, Composition composition) {
    std::uint64_t total = 0;
    for (const slice::SliceChunk& c : chunks) total += c.count;
    if (composition != Composition::Last || total <= (std::uint64_t{1} << 23)) return;
    throw Error(ErrorCode::Unsupported,
                str("raster: ", total, " slices are too many to tell which was last (limit 2^23)"),
                "use another composition, or larger voxels");
}

} // namespace

BrickRasterizer::BrickRasterizer(const opengl::Context& context,
                                 SegmentResources& kit,
                                 const BrickGrid& grid,
                                 const slice::SectionTextures& textures,
                                 std::span<const slice::SliceChunk> chunks,
                                 const DrawOptions& options)
    : context_(context),
      kit_(kit),
      grid_(grid),
      chunks_(chunks),
      options_(options),
      capacity_(capacity_of(context, options, materials_of(chunks).size())),
      materials_(materials_of(chunks)),
      textures_(textures),
      slots_(grid.size()),
      slot_buffer_("slots of bricks", grid.size() * sizeof(std::uint32_t)),
      pool_(kit.pool(capacity_ * kBrickBytes)),
      list_("a batch's slices", most_slices(chunks) * sizeof(std::uint32_t)),
      command_("a batch's draw", 8 * sizeof(std::uint32_t)) {
    check_last(chunks, kit.composition());
    grid.set_uniforms(kit.list());
}

void BrickRasterizer::use_path(RasterPath path) {
    pass_ = &kit_.pass(path);
    grid_.set_uniforms(pass_->program());
    pass_->program().set("weight_scale", std::ldexp(1.0f, options_.weight_bits));
}

RasterWindow BrickRasterizer::choose(std::span<const TouchedBlock> blocks,
                                     RasterBatch& batch) const {
    const std::int32_t n = grid_.units.n;
    Vec3i lo;
    Vec3i hi;
    for (std::size_t i = batch.begin; i < blocks.size(); ++i) {
        if (batch.bricks + blocks[i].bricks.size() > capacity_) break;
        Vec3i low = lo;
        Vec3i high = hi;
        for (const std::uint32_t number : blocks[i].bricks) {
            const Vec3i brick = grid_.brick(number);
            const bool first = i == batch.begin && number == blocks[i].bricks.front();
            for (int a = 0; a < 3; ++a) {
                low[a] = first ? brick[a] : std::min(low[a], brick[a]);
                high[a] = first ? brick[a] + 1 : std::max(high[a], brick[a] + 1);
            }
        }
        const Vec3i size = high - low;
        const std::int32_t window = std::max({size.x, size.y, size.z}) * kBrickEdge * n;
        if (i > batch.begin && window > context_.limits().viewport) break;
        lo = low;
        hi = high;
        batch.first_slot.push_back(batch.bricks);
        batch.bricks += blocks[i].bricks.size();
        batch.end = i + 1;
    }
    return {lo * (kBrickEdge * n), (hi - lo) * (kBrickEdge * n)};
}

void BrickRasterizer::set_slots(std::span<const TouchedBlock> blocks, const RasterBatch& batch) {
    std::fill(slots_.begin(), slots_.end(), 0u);
    std::uint32_t slot = 0;
    for (std::size_t i = batch.begin; i < batch.end; ++i) {
        for (const std::uint32_t number : blocks[i].bricks) slots_[number] = ++slot;
    }
    slot_buffer_.write(std::as_bytes(std::span(slots_)));
}

void BrickRasterizer::list_slices(const slice::SliceChunk& chunk) {
    constexpr std::array<std::uint32_t, 8> kNone{4, 0, 0, 0, 0, 0, 1, 0}; // as kListGlsl has it
    command_.write(std::as_bytes(std::span(kNone)));
    list_.bind_storage(2);
    command_.bind_storage(3);
    kit_.list().set("slice_count", chunk.count);
    kit_.list().dispatch(chunk.count);
    opengl::finish_writes();
}

void BrickRasterizer::draw_chunk(const slice::SliceChunk& chunk, const RasterWindow& window) {
    chunk.slices.bind_storage(0);
    slot_buffer_.bind_storage(1);
    list_slices(chunk);
    pass_->program().set("first_slice", chunk.first);
    pool_.bind_storage(3);
    textures_.bind();
    pass_->draw(command_, window);
}

void BrickRasterizer::draw_material(std::uint32_t material, const RasterWindow& window) {
    for (const slice::SliceChunk& chunk : chunks_) {
        if (chunk.material == material) draw_chunk(chunk, window);
    }
}

RasterPath BrickRasterizer::try_paths(std::span<const TouchedBlock> blocks, std::size_t begin) {
    using Clock = std::chrono::steady_clock;
    const auto few = blocks.first(std::min(blocks.size(), begin + kTriedBlocks));
    std::array<Clock::duration, 2> time{};
    std::array<RasterBatch, 2> drawn;
    for (std::size_t i = 0; i < 2; ++i) {
        use_path(i == 0 ? RasterPath::Fragment : RasterPath::Compute);
        (void)draw_batch(few, begin); // a driver may compile when it first draws
        const auto start = Clock::now();
        drawn[i] = draw_batch(few, begin);
        time[i] = Clock::now() - start;
    }
    // a driver that rounds differently in them: a choice by the clock would show in the voxels
    const bool same = drawn[0].materials == drawn[1].materials;
    return same && time[1] < time[0] ? RasterPath::Compute : RasterPath::Fragment;
}

RasterBatch BrickRasterizer::draw(std::span<const TouchedBlock> blocks, std::size_t begin) {
    if (kit_.path() == RasterPath::Auto) kit_.choose(try_paths(blocks, begin));
    use_path(kit_.path());
    return draw_batch(blocks, begin);
}

RasterBatch BrickRasterizer::draw_batch(std::span<const TouchedBlock> blocks, std::size_t begin) {
    RasterBatch batch{.begin = begin, .end = begin, .first_slot = {}, .materials = {}};
    const RasterWindow window = choose(blocks, batch);
    set_slots(blocks, batch);
    for (const std::uint32_t material : materials_) {
        pool_.clear();
        const int picks = kit_.composition() == Composition::Last ? 2 : 1;
        for (std::int32_t pick = 0; pick < picks; ++pick) {
            pass_->program().set("pick", pick);
            draw_material(material, window);
            opengl::finish_writes();
        }
        RasterMaterial drawn{.form = {.subvoxels = grid_.units.n,
                                      .composition = kit_.composition(),
                                      .weight_bits = options_.weight_bits,
                                      .material = material},
                             .words = std::vector<std::uint32_t>(batch.bricks * kBrickWords)};
        pool_.read(std::as_writable_bytes(std::span(drawn.words)));
        context_.check("draw slices");
        batch.materials.push_back(std::move(drawn));
    }
    return batch;
}

} // namespace heddle::raster
