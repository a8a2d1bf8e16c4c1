#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/geometry.h>
#include <heddle/sggx/packed.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace heddle {

/// The lattice that all objects share: voxel (i, j, k) spans [i, i + 1) x voxel_size.x and so on.
/// The corner of voxel (0, 0, 0) is the scene's origin.
struct Lattice {
    Vec3d voxel_size{1.0, 1.0, 1.0}; ///< scene units, > 0
    std::int32_t subvoxels = 8;      ///< per voxel axis: 1, 2, 4 or 8; 2^L times that at level L
};

/// Returns the lattice of level L over `finest`: the parent of voxel i is floor(i / 2) on each
/// axis.
[[nodiscard]] inline Lattice lattice_of_level(const Lattice& finest, int level) {
    const auto factor = static_cast<double>(std::int64_t{1} << level);
    return {finest.voxel_size * factor, finest.subvoxels << level};
}

/// How much a voxel covers of its faces and of its volume. 16-bit fixed point: 65535 = 1.
struct Coverage {
    std::uint16_t x = 0; ///< covered fraction of the face seen along x
    std::uint16_t y = 0;
    std::uint16_t z = 0;
    std::uint16_t occupancy = 0; ///< hit subvoxels / subvoxels          [Fabre26, eq. 12]
    friend bool operator==(const Coverage&, const Coverage&) = default;
};
static_assert(sizeof(Coverage) == 8);

/// Returns part / whole in 16 bits, rounded. `part` can be restored exactly if whole < 65535.
[[nodiscard]] constexpr std::uint16_t fraction16(std::int64_t part, std::int64_t whole) {
    return static_cast<std::uint16_t>((part * 65535 + whole / 2) / whole);
}

/// One SGGX of a voxel with its weight and material. It describes tangents if the material is a
/// fiber's, and normals if it is a surface's.
struct Lobe {
    PackedSggx sggx;
    std::uint8_t weight = 0;   ///< share of the voxel's directed area, 255 = all; >= 1
    std::uint8_t material = 0; ///< index into VoxelLevelInfo::materials
    friend bool operator==(const Lobe&, const Lobe&) = default;
};
static_assert(sizeof(Lobe) == 8);

/// The values of a material's maps for one lobe: means over the lobe's share of the voxel, 255 = 1.
/// They multiply the material's constants.
struct LobeMaps {
    std::array<std::uint8_t, 3> albedo{255, 255, 255}; ///< linear
    std::uint8_t roughness = 255;
    std::uint8_t metalness = 255;
    std::uint8_t anisotropy = 255;
    friend bool operator==(const LobeMaps&, const LobeMaps&) = default;
};

/// The sums that a lobe was fitted to, unquantized. Coarser levels are rebuilt from them bit for
/// bit.
struct LobeMoment {
    std::array<std::int64_t, 6> moment{}; ///< sum of weight x d d^T: xx yy zz xy xz yz
    std::int64_t weight = 0;              ///< directed area, kWeightScale = 1 unit^2
    friend bool operator==(const LobeMoment&, const LobeMoment&) = default;
};

/// The sums of a lobe's map values and of an anisotropic surface's tangents, which complete its
/// LobeMoment. The summands are 8-bit map values times weight.
struct MapSums {
    std::array<std::int64_t, 6> tangent{}; ///< second moment of tangents
    std::array<std::int64_t, 3> albedo{};
    std::int64_t roughness = 0;
    std::int64_t metalness = 0;
    std::int64_t anisotropy = 0;
    friend bool operator==(const MapSums&, const MapSums&) = default;
};
static_assert(sizeof(LobeMoment) == 56 && sizeof(MapSums) == 96, "files have this layout");

/// The optional fields that a level holds. The first three are absent if no material has maps that
/// vary them. The others are present only on request.
struct VoxelFields {
    bool albedo = false;   ///< LobeMaps::albedo
    bool surface = false;  ///< LobeMaps::roughness, metalness, anisotropy
    bool tangents = false; ///< a second SGGX per lobe: tangents of anisotropic surfaces
    bool masks = false;    ///< columns and sums of level 0, from which levels are rebuilt exactly
    bool correlation = false;    ///< correlation of the coverage of neighbouring voxels
    std::int32_t footprints = 0; ///< cells per axis of a voxel's face: 4 or 8; 0: none

    [[nodiscard]] bool maps() const { return albedo || surface; }      ///< has LobeMaps
    [[nodiscard]] bool map_sums() const { return maps() || tangents; } ///< has MapSums with masks
};

/// The occupied voxels of 8 x 8 x 8, with the mask of a VDB leaf.
struct VoxelLeaf {
    Vec3i origin;                          ///< voxel index of its corner: multiples of 8
    std::array<std::uint64_t, 8> active{}; ///< bit (y * 8 + z) of word x: voxel origin + (x, y, z)
    std::uint32_t first_voxel = 0;         ///< its first voxel in the block's arrays
    std::uint32_t first_lobe = 0;          ///< its first lobe in the block's arrays

    [[nodiscard]] std::uint32_t voxel_count() const {
        std::uint32_t n = 0;
        for (std::uint64_t w : active) n += static_cast<std::uint32_t>(std::popcount(w));
        return n;
    }
};

/// Returns the lobe that `lobe` merges into when a voxel is reduced to fewer lobes: while n lobes
/// are left, lobe n - 1 merges into lobe `merge_target(order, n - 1)`. Lobe 1 merges into lobe 0.
/// @param order  the voxel's VoxelBlock::merge_order
[[nodiscard]] constexpr int merge_target(std::uint32_t order, int lobe) {
    return lobe < 2 ? 0 : static_cast<int>(order >> (4 * (lobe - 2)) & 15u);
}

/// The occupied voxels of one block. The voxels of a leaf are stored in ascending order of (x, y,
/// z). The first lobe of a voxel is its heaviest; the others are in the order that `merge_order`
/// needs.
struct VoxelBlock {
    std::vector<VoxelLeaf> leaves;          ///< ascending origin (x, then y, then z)
    std::vector<Coverage> coverage;         ///< per voxel
    std::vector<std::uint8_t> lobe_count;   ///< per voxel, 1 to K
    std::vector<Lobe> lobes;                ///< per lobe
    std::vector<LobeMaps> maps;             ///< per lobe; empty unless fields.albedo or .surface
    std::vector<PackedSggx> tangents;       ///< per lobe, all zero where the material is isotropic;
                                            ///< empty unless fields.tangents
    std::vector<std::uint32_t> merge_order; ///< per voxel; empty if no voxel has over two lobes

    std::vector<std::array<std::uint64_t, 3>> columns; ///< per voxel and axis: bit b n + a is the
                                                       ///< column at (a, b) of the other two
                                                       ///< axes; with fields.masks
    std::vector<LobeMoment> moments;                   ///< per lobe; with fields.masks
    std::vector<MapSums> map_sums; ///< per lobe; with fields.masks and fields.map_sums()
    std::vector<std::array<std::uint64_t, 3>> footprints; ///< per voxel and axis: bit b n + a of
                                                          ///< n x n cells; with fields.footprints
    std::vector<std::array<std::uint8_t, 3>> correlation; ///< per voxel and axis, with the next
                                                          ///< voxel on the axis; 255: one covers
                                                          ///< what the other covers; with
                                                          ///< fields.correlation

    /// Calls f with each of the vectors except `leaves`.
    template <typename Self, typename F>
    static void for_each_array(Self& block, const F& f) {
        f(block.coverage), f(block.lobe_count), f(block.lobes), f(block.maps), f(block.tangents);
        f(block.merge_order), f(block.columns), f(block.moments), f(block.map_sums);
        f(block.footprints), f(block.correlation);
    }
    [[nodiscard]] std::int64_t byte_count() const {
        std::size_t sum = leaves.capacity() * sizeof(VoxelLeaf);
        for_each_array(*this, [&](const auto& v) { sum += v.capacity() * sizeof(v[0]); });
        return static_cast<std::int64_t>(sum);
    }
    void shrink_to_fit() {
        leaves.shrink_to_fit();
        for_each_array(*this, [](auto& v) { v.shrink_to_fit(); });
    }
};

/// Frees the columns and sums, which are needed only to build coarser levels.
inline void drop_sums(VoxelBlock& block) {
    block.columns = {};
    block.moments = {};
    block.map_sums = {};
}

/// The size of one level.
struct LevelSize {
    std::int64_t leaves = 0; ///< leaves with at least one active voxel
    std::int64_t voxels = 0; ///< active voxels
    std::int64_t lobes = 0;  ///< of all voxels; >= voxels
};

/// Returns the bytes of memory that blocks with these numbers of leaves, voxels and lobes occupy.
[[nodiscard]] inline std::int64_t predict_block_bytes(std::int64_t leaves,
                                                      std::int64_t voxels,
                                                      std::int64_t lobes,
                                                      const VoxelFields& fields) {
    const std::size_t per_voxel = sizeof(Coverage) + 1 + (fields.masks ? 24 : 0) +
                                  (fields.footprints != 0 ? 24 : 0) + (fields.correlation ? 3 : 0);
    const std::size_t sums = sizeof(LobeMoment) + (fields.map_sums() ? sizeof(MapSums) : 0);
    const std::size_t per_lobe = sizeof(Lobe) + (fields.maps() ? sizeof(LobeMaps) : 0) +
                                 (fields.tangents ? sizeof(PackedSggx) : 0) +
                                 (fields.masks ? sums : 0);
    return leaves * static_cast<std::int64_t>(sizeof(VoxelLeaf)) +
           voxels * static_cast<std::int64_t>(per_voxel) +
           lobes * static_cast<std::int64_t>(per_lobe);
}

/// The metadata of one level of a voxelized object: everything except the voxels.
struct VoxelLevelInfo {
    std::string name;           ///< the object's
    Lattice lattice;            ///< this level's
    std::int32_t level = 0;     ///< 0: the finest
    std::string lod{};          ///< method by which levels above 0 were built; empty: not built
    bool approximate = false;   ///< levels above 0 were built from stored lobes, not from sums
    std::int32_t max_lobes = 3; ///< K
    VoxelFields fields;
    std::vector<Material> materials; ///< Lobe::material is an index into it; without maps
    std::vector<YarnType> yarns;     ///< yarn types of the input, without slice texels
    std::string command;             ///< the command line that made the object
    std::int64_t voxel_count = 0;
    std::int64_t lobe_count = 0;
};

/// All blocks of one level, which can be read any number of times in a fixed order. They are held
/// in memory or in a spool file, or read from a .vdb.
class VoxelLevel {
public:
    virtual ~VoxelLevel() = default;
    [[nodiscard]] const VoxelLevelInfo& info() const { return info_; }
    void set_info(VoxelLevelInfo info) { info_ = std::move(info); }
    [[nodiscard]] virtual std::size_t block_count() const = 0;
    /// Returns block i < block_count(). The reference is valid until the next call with the same
    /// `scratch`. Thread-safe if each thread has its own scratch.
    [[nodiscard]] virtual const VoxelBlock& block(std::size_t i, VoxelBlock& scratch) const = 0;
    /// Returns the blocks if they are in memory, where they may be modified; else null.
    [[nodiscard]] virtual std::vector<VoxelBlock>* blocks_in_memory() { return nullptr; }

protected:
    VoxelLevelInfo info_;
};

/// The levels of an object, finest first. Their infos differ in lattice, level and counts only.
using VoxelLevels = std::vector<std::unique_ptr<VoxelLevel>>;

/// A VoxelLevel in memory. Whoever creates it fills in its blocks and its info.
struct MemoryLevel final : VoxelLevel {
    std::vector<VoxelBlock> blocks;

    using VoxelLevel::info;
    [[nodiscard]] VoxelLevelInfo& info() { return info_; }
    [[nodiscard]] std::size_t block_count() const override { return blocks.size(); }
    [[nodiscard]] const VoxelBlock& block(std::size_t i, VoxelBlock&) const override {
        return blocks[i];
    }
    [[nodiscard]] std::vector<VoxelBlock>* blocks_in_memory() override { return &blocks; }
};

} // namespace heddle
