#pragma once

#include <heddle/raster/brick_grid.h>
#include <heddle/raster/brick_words.h>
#include <heddle/raster/segment_pass.h>
#include <heddle/slice/section_textures.h>

#include <cstdint>
#include <span>
#include <vector>

namespace heddle::raster {

/// One material's sums of a batch.
struct RasterMaterial {
    WordFormat form;
    std::vector<std::uint32_t> words; ///< kBrickWords per slot
    friend bool operator==(const RasterMaterial&, const RasterMaterial&) = default;
};

/// Sums of blocks [begin, end) of a list.
struct RasterBatch {
    std::size_t begin = 0, end = 0;
    std::vector<std::size_t> first_slot; ///< first slot of each block's bricks
    std::size_t bricks = 0;
    std::vector<RasterMaterial> materials;
};

/// How bricks are drawn.
struct DrawOptions {
    int weight_bits = 0;
    std::int64_t memory_bytes = 0; ///< limit of a batch's sums; a block is always allowed
    std::int64_t bricks = 0;       ///< total number: an upper bound for a batch
};

/// Draws slices along three axes into the sums of bricks, a batch of blocks at a time. The
/// arguments of its constructor, except the options, must outlive it.
class BrickRasterizer {
public:
    /// @throws Error  OutOfMemory; Unsupported: `Last` with more than 2^23 slices
    BrickRasterizer(const opengl::Context& context,
                    SegmentResources& kit,
                    const BrickGrid& grid,
                    const slice::SectionTextures& textures,
                    std::span<const slice::SliceChunk> chunks,
                    const DrawOptions& options);

    /// Draws as many blocks from `begin` on as memory and the driver's largest viewport allow, but
    /// at least one. If no path is chosen yet, times both on a few blocks and chooses the faster.
    [[nodiscard]] RasterBatch draw(std::span<const TouchedBlock> blocks, std::size_t begin);

private:
    [[nodiscard]] RasterWindow choose(std::span<const TouchedBlock> blocks,
                                      RasterBatch& batch) const;
    void set_slots(std::span<const TouchedBlock> blocks, const RasterBatch& batch);
    void use_path(RasterPath path);
    [[nodiscard]] RasterPath try_paths(std::span<const TouchedBlock> blocks, std::size_t begin);
    [[nodiscard]] RasterBatch draw_batch(std::span<const TouchedBlock> blocks, std::size_t begin);
    void draw_material(std::uint32_t material, const RasterWindow& window);
    void draw_chunk(const slice::SliceChunk& chunk, const RasterWindow& window);
    void list_slices(const slice::SliceChunk& chunk);

    const opengl::Context& context_;
    SegmentResources& kit_;
    const BrickGrid& grid_;
    std::span<const slice::SliceChunk> chunks_;
    DrawOptions options_;
    std::size_t capacity_; ///< bricks of a batch
    std::vector<std::uint32_t> materials_;
    const slice::SectionTextures& textures_;
    const SegmentPass* pass_ = nullptr;
    std::vector<std::uint32_t> slots_; ///< by brick: slot + 1, or 0
    opengl::Buffer slot_buffer_;
    const opengl::Buffer& pool_;
    opengl::Buffer list_;
    opengl::Buffer command_;
};

} // namespace heddle::raster
