#pragma once

#include <heddle/voxel/z_order.h>
#include <heddle/voxelize/bin.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace heddle {

/// The occupied blocks in Z-order, so that neighbouring blocks are processed soon after each other.
struct BlockOrder {
    std::vector<std::uint32_t> block; ///< numbers of the blocks
    std::vector<Vec3i> index;

    BlockOrder(const BlockRange& range, std::vector<std::uint32_t> occupied)
        : block(std::move(occupied)) {
        std::sort(block.begin(), block.end(), [&](std::uint32_t a, std::uint32_t b) {
            return z_order_less(range.index(a), range.index(b));
        });
        for (const std::uint32_t b : block) index.push_back(range.index(b));
    }
};

} // namespace heddle
