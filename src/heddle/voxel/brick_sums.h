#pragma once

#include <heddle/base/vec.h>
#include <heddle/gpu/atomic.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// Voxels along a brick's edge: a brick is a stored leaf.
constexpr int kBrickVoxels = 8;

/// The sums of one brick's voxels, of one material at a time: what a group of device threads gathers
/// into, as BlockSums is for one thread of the CPU. Arrays by field, then by voxel (x 8 + y) 8 + z.
struct BrickSums {
    static constexpr int kVoxels = kBrickVoxels * kBrickVoxels * kBrickVoxels;
    static constexpr int kMaskWords = 3 + 8; ///< columns along x, y, z; subvoxels: as VoxelSums
    static constexpr int kLobeWords = 6 + 1; ///< moment, weight: as LobeSums
    static constexpr int kMapWords = 12;     ///< as MapSums lies

    std::uint64_t* masks = nullptr; ///< kMaskWords x kVoxels
    std::uint64_t* lobe = nullptr;  ///< kLobeWords x kVoxels, two's complement
    std::uint64_t* maps = nullptr;  ///< kMapWords x kVoxels; null without maps
    Vec3i lo, size;                 ///< first voxel of the lattice; voxels per axis, at most 8

    [[nodiscard]] static constexpr std::size_t byte_count(bool with_maps) {
        return sizeof(std::uint64_t) * kVoxels *
               (kMaskWords + kLobeWords + (with_maps ? kMapWords : 0));
    }
    /// The arrays at `scratch`, byte_count() of it.
    [[nodiscard]] HEDDLE_HD static BrickSums
    at(std::byte* scratch, bool with_maps, Vec3i lo, Vec3i size) {
        auto* words = reinterpret_cast<std::uint64_t*>(scratch);
        BrickSums out;
        out.masks = words;
        out.lobe = words + kMaskWords * kVoxels;
        if (with_maps) out.maps = words + (kMaskWords + kLobeWords) * kVoxels;
        out.lo = lo;
        out.size = size;
        return out;
    }

    [[nodiscard]] HEDDLE_HD static int cell(int x, int y, int z) {
        return (x * kBrickVoxels + y) * kBrickVoxels + z;
    }
    HEDDLE_HD void or_column(int cell, int axis, std::uint64_t bits) const {
        gpu::group_or(masks + axis * kVoxels + cell, bits);
    }
    /// @param word  of the voxel's subvoxels: bit (x n + y) n + z over all words
    HEDDLE_HD void or_subvoxels(int cell, int word, std::uint64_t bits) const {
        gpu::group_or(masks + (3 + word) * kVoxels + cell, bits);
    }
    /// @param field  xx yy zz xy xz yz, weight
    HEDDLE_HD void add_lobe(int cell, int field, std::int64_t x) const {
        gpu::group_add(lobe + field * kVoxels + cell, static_cast<std::uint64_t>(x));
    }
    /// @param field  as MapSums lies: tangent xx .. yz, albedo r g b, roughness, metalness, anisotropy
    HEDDLE_HD void add_map(int cell, int field, std::int64_t x) const {
        gpu::group_add(maps + field * kVoxels + cell, static_cast<std::uint64_t>(x));
    }
};

} // namespace heddle
