#pragma once

#include <heddle/base/error.h>
#include <heddle/leaf_table/index_table.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace heddle {

/// Leaves of 8^3 voxels by index: a hash table of the tiles that hold any, each with the numbers of
/// its leaves. Emptiness is known a tile or a leaf at a time.
///
/// What a leaf holds is the caller's, in arrays by the leaf's number. Memory: 4 << (3 kTileBits)
/// bytes a tile and what IndexTable takes. Reading is safe from several threads.
/// @tparam kTileBits  log2 of the leaves along a tile's edge: 3 where rays step over a tile of 64
///                    voxels, 4 where they step over one of 128
template <int kTileBits>
class LeafTable {
public:
    static constexpr std::uint32_t kNone = IndexTable::kNone;
    static constexpr int kTileShift = 3 + kTileBits; ///< log2 of the voxels along a tile's edge
    static constexpr std::int32_t kTileVoxels = 1 << kTileShift;
    static constexpr std::size_t kTileLeaves = std::size_t{1} << (3 * kTileBits);

    /// Gives a leaf the next number: 0, 1, 2 and so on.
    /// @param origin  voxel index of its corner; of a leaf that is not there yet
    /// @throws Error  InvalidArgument: 2^32 - 1 leaves are there already
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
        leaves_[number * kTileLeaves + place_in_tile(origin)] = size_;
        return size_++;
    }

    /// What is at a voxel index: a leaf, or how much around it is empty.
    struct LeafLookup {
        std::uint32_t leaf = kNone;      ///< its number
        std::int32_t size = kTileVoxels; ///< edge of the aligned cube that the leaf fills, or that
                                         ///< is empty
    };
    [[nodiscard]] LeafLookup find(Vec3i at) const {
        const std::uint32_t tile = find_tile(tile_of(at));
        if (tile == kNone) return {};
        return {find_in_tile(tile, at), 8};
    }
    /// In two steps, for a walk that stays in a tile: first the tile's number, kNone where it is
    /// empty, then that of the leaf at a voxel index inside it.
    /// @param tile  voxel index >> kTileShift
    [[nodiscard]] std::uint32_t find_tile(Vec3i tile) const { return index_.find(tile); }
    [[nodiscard]] std::uint32_t find_in_tile(std::uint32_t tile, Vec3i at) const {
        return leaves_[tile * kTileLeaves + place_in_tile(at)];
    }

    /// How many leaves there are.
    [[nodiscard]] std::uint32_t size() const { return size_; }
    /// The tiles by number: voxel index >> kTileShift.
    [[nodiscard]] std::span<const Vec3i> tiles() const { return tiles_; }
    /// kTileLeaves numbers of leaves a tile, x slowest; kNone where there is none.
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
    [[nodiscard]] static std::size_t place_in_tile(Vec3i at) {
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
