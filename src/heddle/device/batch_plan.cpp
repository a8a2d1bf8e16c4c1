#include <heddle/device/batch_plan.h>

#include <heddle/device/gather_fibers_op.h>
#include <heddle/device/level/dense_sums.h>

#include <algorithm>

namespace heddle {
namespace {

/// Largest number of blocks of a batch, whose cells are numbered in 31 bits.
constexpr std::int64_t kMaxBlocks = (std::int64_t{1} << 31) / kVoxelsPerBlock - 1;

/// Predicted fraction of a block's voxels that are occupied; cloth has 0.1 to 0.4.
constexpr double kFill = 0.4;

/// Bytes of the scans that find voxels.
constexpr std::int64_t kBytesPerCell = (1 + 4) + (2 + 4);

/// Typical number of chords of a piece of yarn, for its frames and counts.
constexpr std::int64_t kFramesPerYarn = 20;

} // namespace

std::vector<std::uint32_t> occupied_blocks(const PairCounts& counts) {
    std::size_t blocks = 0;
    for (const auto& of : counts) blocks = std::max(blocks, of.size());
    std::vector<std::uint32_t> out;
    for (std::size_t b = 0; b < blocks; ++b) {
        bool any = false;
        for (const auto& of : counts) any = any || (!of.empty() && of[b] > 0);
        if (any) out.push_back(static_cast<std::uint32_t>(b));
    }
    return out;
}

std::int64_t predict_batch_bytes(std::int64_t blocks,
                                 const std::array<std::int64_t, kPrimitiveKinds>& pairs,
                                 const BatchNeeds& needs) {
    const std::int64_t materials = std::clamp<std::int64_t>(needs.materials, 1, 3);
    const auto voxels =
        static_cast<std::int64_t>(kFill * static_cast<double>(blocks) * kVoxelsPerBlock);
    const std::int64_t lobes =
        voxels * std::min<std::int64_t>(materials, needs.made.level0.max_lobes);
    BatchOptions level0 = needs.made;
    level0.levels = 0;
    // the sums are in memory while level 0 is written, and are freed before it is stored
    std::int64_t gather = DenseSums::byte_count(blocks, blocks * materials, level0.with_maps()) +
                          blocks * kVoxelsPerBlock * kBytesPerCell +
                          predict_level_bytes(blocks, voxels, lobes, level0);
    for (const std::int64_t n : pairs) gather += n * static_cast<std::int64_t>(sizeof(BlockPair));
    gather += pairs[number_of(PrimitiveKind::Yarn)] *
              static_cast<std::int64_t>(sizeof(YarnPair) + 36 + kFramesPerYarn * sizeof(YarnFrame));
    return std::max(gather, predict_level_bytes(blocks, voxels, lobes, needs.made));
}

std::vector<BatchRange> plan_batches(const BlockOrder& order,
                                     const PairCounts& counts,
                                     const BatchNeeds& needs,
                                     std::int64_t bytes,
                                     std::int64_t least_batches) {
    const auto total = static_cast<std::int64_t>(order.block.size());
    const std::int64_t most =
        std::clamp<std::int64_t>(least_batches > 0 ? total / least_batches : total, 1, kMaxBlocks);
    std::vector<BatchRange> out;
    std::array<std::int64_t, kPrimitiveKinds> pairs{};
    for (std::size_t i = 0; i < order.block.size(); ++i) {
        std::array<std::int64_t, kPrimitiveKinds> with = pairs;
        for (std::size_t k = 0; k < kPrimitiveKinds; ++k) {
            if (!counts[k].empty()) with[k] += counts[k][order.block[i]];
        }
        const auto blocks = static_cast<std::int64_t>(out.empty() ? 0 : i - out.back().begin);
        const bool full = blocks == most || predict_batch_bytes(blocks + 1, with, needs) > bytes;
        if (out.empty() || full) {
            out.push_back({i, i});
            for (std::size_t k = 0; k < kPrimitiveKinds; ++k) with[k] -= pairs[k];
        }
        out.back().end = i + 1;
        pairs = with;
    }
    return out;
}

} // namespace heddle
