#include <heddle/device/batch_plan.h>

#include <heddle/device/dense_sums.h>
#include <heddle/device/gather_fibers_op.h>
#include <heddle/sggx/direction_sums.h>

#include <algorithm>

namespace heddle {
namespace {

/// Blocks of one batch: their cells are numbered in 31 bits.
constexpr std::int64_t kMostBlocks = (std::int64_t{1} << 31) / kBlockCells - 1;

/// Part of a block's voxels that are there: cloth has .1 to .4.
constexpr double kFill = 0.4;

/// Per voxel of level 0: what is kept of it, and the scans that find it.
constexpr std::int64_t kBytesPerVoxel = 8 + 4 + 4 + 4 + 24 + sizeof(DirectionSums);
constexpr std::int64_t kBytesPerCell = 2 * (1 + 4);

/// Chords of a piece of yarn, about: its frames and counts.
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
    const std::int64_t planes = blocks * std::clamp<std::int64_t>(needs.materials, 1, 3);
    const double voxels = kFill * static_cast<double>(blocks) * kBlockCells;
    const double per_voxel = static_cast<double>(kBytesPerVoxel) +
                             (needs.with_maps ? static_cast<double>(sizeof(MapSums)) : 0.0);
    std::int64_t sum =
        DenseSums::byte_count(blocks, planes, needs.with_maps) +
        blocks * kBlockCells * kBytesPerCell +
        static_cast<std::int64_t>(voxels * per_voxel * (needs.with_levels ? 2.0 : 1.5));
    for (const std::int64_t n : pairs) sum += n * static_cast<std::int64_t>(sizeof(BlockPair));
    const std::int64_t yarns = pairs[static_cast<std::size_t>(PrimitiveKind::Yarn)];
    return sum + yarns * static_cast<std::int64_t>(sizeof(YarnPair) + 36 +
                                                   kFramesPerYarn * sizeof(YarnFrame));
}

std::vector<BatchRange> plan_batches(const BlockOrder& order,
                                     const PairCounts& counts,
                                     const BatchNeeds& needs,
                                     std::int64_t bytes,
                                     std::int64_t least_batches) {
    const auto total = static_cast<std::int64_t>(order.block.size());
    const std::int64_t most =
        std::clamp<std::int64_t>(least_batches > 0 ? total / least_batches : total, 1, kMostBlocks);
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
