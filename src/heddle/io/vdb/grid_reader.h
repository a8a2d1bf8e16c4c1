#pragma once

#include <heddle/base/vec.h>
#include <heddle/io/vdb/vdb_file.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// The active voxels of a grid, without its tree.
struct GridLeaves {
    struct Leaf {
        Vec3i origin;
        std::array<std::uint64_t, 8> active{}; ///< as VoxelLeaf::active
        std::size_t first = 0;                 ///< index of its first value
    };
    std::vector<Leaf> leaves;      ///< ascending origin (x, then y, then z); none is empty
    std::vector<std::byte> values; ///< of the active voxels, in the order of the leaves
    std::size_t value_bytes = 0;   ///< as stored: 2 to 12

    [[nodiscard]] std::size_t size() const {
        return value_bytes == 0 ? 0 : values.size() / value_bytes;
    }
};

/// Reads one grid, written as in grid_writer.h, on all threads.
///
/// OpenVDB's own reader builds trees and trusts its input (a flipped bit can make it write past a
/// buffer or loop for minutes), so it only decompresses chunks whose size was checked here.
/// @param entry   an entry of read_contents(path)
/// @throws Error  BadFile: damaged, or active tiles; Unsupported: a value type or a compression
///                that Heddle does not write
[[nodiscard]] GridLeaves read_grid(const std::string& path, const GridEntry& entry);

} // namespace heddle
