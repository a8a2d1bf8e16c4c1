#pragma once

#include <heddle/base/error.h>
#include <heddle/leaf_table/index_table.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// A table of leaves of 8^3 voxels: a hash table of the tiles that contain leaves, each with the
/// numbers of its leaves. A lookup tells whether a whole tile or a leaf is empty.
///
/// The caller keeps the contents of leaves in arrays by leaf number. Memory: 4 << (3 kTileBits)
/// bytes per tile and that of the IndexTable. Reading is thread-safe.
/// @tparam kTileBits  log2 of the leaves along a tile's edge: 3 where rays step over a tile of 64
///                    voxels, 4 where they step over one of 128
template <int kTileBits>
class LeafTable {
public:
    static constexpr std::uint32_t kNone = IndexTable::kNone;
    static constexpr int kTileShift = 3 + kTileBits; ///< log2 of the voxels along a tile's edge
    static constexpr std::int32_t kTileVoxels = 1 << kTileShift;
    static constexpr std::size_t kTileLeaves = std::size_t{1} << (3 * kTileBits);

    /// Adds a leaf and returns its number: 0, 1, 2 and so on.
    /// @param origin  voxel index of the leaf's corner; the leaf must not be in the table yet
    /// @throws Error  InvalidArgument: the table already has 2^32 - 1 leaves
    std::uint32_t add(Vec3i origin) {
        if (size_ == kNone) {
            throw Error(ErrorCode::InvalidArgument, "voxels: 2^32 leaves (limit 2^32 - 1)",
                        "use a larger voxel size");
        }
        const Vec3i tile = tile_of(origin);
        const std::uint32_t number = index_.add(tile);
        if (number == tiles_.size()) {
            tiles_.push_back(tile);
            leaves_.resize(leaves_.size() + kTileLeaves, kNone);
        }
        leaves_[number * kTileLeaves + number_in_tile(origin)] = size_;
        return size_++;
    }

    /// The result of find(): a leaf, or the size of the empty cube around a voxel.
    struct LeafLookup {
        std::uint32_t leaf = kNone;      ///< its number; kNone: the cube is empty
        std::int32_t size = kTileVoxels; ///< edge of the aligned cube, the leaf or an empty one, in
                                         ///< voxels
    };
    [[nodiscard]] LeafLookup find(Vec3i at) const {
        const std::uint32_t tile = find_tile(tile_of(at));
        if (tile == kNone) return {};
        return {find_in_tile(tile, at), 8};
    }
    /// find() in two steps, for a traversal that stays in a tile: the first returns the tile's
    /// number, kNone if it is empty, the second the number of the leaf at a voxel index inside the
    /// tile.
    /// @param tile  voxel index >> kTileShift
    [[nodiscard]] std::uint32_t find_tile(Vec3i tile) const { return index_.find(tile); }
    [[nodiscard]] std::uint32_t find_in_tile(std::uint32_t tile, Vec3i at) const {
        return leaves_[tile * kTileLeaves + number_in_tile(at)];
    }

    /// Returns the number of leaves.
    [[nodiscard]] std::uint32_t size() const { return size_; }
    /// Returns the index of each tile, voxel index >> kTileShift, in the order of tile numbers.
    [[nodiscard]] std::span<const Vec3i> tiles() const { return tiles_; }
    /// Returns kTileLeaves leaf numbers per tile, x slowest; kNone: no leaf.
    [[nodiscard]] std::span<const std::uint32_t> leaves_by_tile() const { return leaves_; }
    [[nodiscard]] std::int64_t byte_count() const {
        return index_.byte_count() +
               static_cast<std::int64_t>(tiles_.capacity() * sizeof(Vec3i) +
                                         leaves_.capacity() * sizeof(std::uint32_t));
    }

private:
    [[nodiscard]] static Vec3i tile_of(Vec3i at) {
        return {at.x >> kTileShift, at.y >> kTileShift, at.z >> kTileShift};
    }
    [[nodiscard]] static std::size_t number_in_tile(Vec3i at) {
        constexpr std::int32_t kMask = (1 << kTileBits) - 1;
        return static_cast<std::size_t>((at.x >> 3 & kMask) << (2 * kTileBits) |
                                        (at.y >> 3 & kMask) << kTileBits | (at.z >> 3 & kMask));
    }

    IndexTable index_; ///< of tiles
    std::vector<Vec3i> tiles_;
    std::vector<std::uint32_t> leaves_;
    std::uint32_t size_ = 0;
};

} // namespace heddle
