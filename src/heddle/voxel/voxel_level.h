#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/geometry.h>
#include <heddle/sggx/packed.h>
#include <heddle/voxel/plane_slab.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace heddle {

/// One lattice for all objects: voxel (i, j, k) spans [i, i + 1) x voxel_size.x and so on; the
/// corner of index (0, 0, 0) is the scene's origin.
struct Lattice {
    Vec3d voxel_size{1.0, 1.0, 1.0}; ///< scene units, > 0
    std::int32_t subvoxels = 8;      ///< per voxel axis: 1, 2, 4 or 8; 2^L times that at level L
};

/// The lattice of level L over `finest`: a parent is floor(i / 2) per axis.
[[nodiscard]] inline Lattice lattice_of_level(const Lattice& finest, int level) {
    const auto factor = static_cast<double>(std::int64_t{1} << level);
    return {finest.voxel_size * factor, finest.subvoxels << level};
}

/// What a voxel hides: 16-bit fixed point, 65535 = 1.
struct Coverage {
    std::uint16_t x = 0; ///< covered fraction of the face seen along x
    std::uint16_t y = 0;
    std::uint16_t z = 0;
    std::uint16_t occupancy = 0; ///< hit subvoxels / subvoxels          [Fabre26, eq. 12]
    friend bool operator==(const Coverage&, const Coverage&) = default;
};
static_assert(sizeof(Coverage) == 8);

/// part / whole, rounded to 16 bits: exact to take back while `whole` is below 65535.
[[nodiscard]] constexpr std::uint16_t fraction16(std::int64_t part, std::int64_t whole) {
    return static_cast<std::uint16_t>((part * 65535 + whole / 2) / whole);
}

/// One SGGX of a voxel with its share and material: of tangents for a fiber material, of normals
/// for a surface.
struct Lobe {
    PackedSggx sggx;
    std::uint8_t weight = 0;   ///< share of the voxel's directed area, 255 = all; >= 1
    std::uint8_t material = 0; ///< index into VoxelLevelInfo::materials
    friend bool operator==(const Lobe&, const Lobe&) = default;
};
static_assert(sizeof(Lobe) == 8);

/// What a material's maps add to a lobe: means over the lobe's share of the voxel, 255 = 1. They
/// multiply the material's constants.
struct LobeMaps {
    std::array<std::uint8_t, 3> albedo{255, 255, 255}; ///< linear
    std::uint8_t roughness = 255;
    std::uint8_t metalness = 255;
    std::uint8_t anisotropy = 255;
    friend bool operator==(const LobeMaps&, const LobeMaps&) = default;
};

/// What was pooled into a lobe, unquantized: coarser levels are built from it again bit for bit.
struct LobeMoment {
    std::array<std::int64_t, 6> moment{}; ///< sum of weight x d d^T: xx yy zz xy xz yz
    std::int64_t weight = 0;              ///< directed area, kWeightScale = 1 unit^2
    friend bool operator==(const LobeMoment&, const LobeMoment&) = default;
};

/// What a material's maps and an anisotropic surface's tangents sum to, beside a LobeMoment. 8-bit
/// map values times weight.
struct MapSums {
    std::array<std::int64_t, 6> tangent{}; ///< second moment of tangents
    std::array<std::int64_t, 3> albedo{};
    std::int64_t roughness = 0;
    std::int64_t metalness = 0;
    std::int64_t anisotropy = 0;
    friend bool operator==(const MapSums&, const MapSums&) = default;
};
static_assert(sizeof(LobeMoment) == 56 && sizeof(MapSums) == 96, "written as they lie");

/// Which of the optional data a grid holds. The first three are absent when no material's maps vary
/// them, slabs where no material is a surface, the others unless they were asked for.
struct VoxelFields {
    bool albedo = false;   ///< LobeMaps::albedo
    bool surface = false;  ///< LobeMaps::roughness, metalness, anisotropy
    bool tangents = false; ///< a second SGGX per lobe: tangents of anisotropic surfaces
    bool masks = false; ///< of level 0: columns and sums, so that levels can be built again exactly
    bool correlation = false;    ///< what neighbouring voxels share
    bool slabs = false;          ///< PlaneSlab of the first lobe
    std::int32_t footprints = 0; ///< cells per axis of a voxel's face: 4 or 8; 0: none
    bool occupancy = false;      ///< which of a voxel's 4 x 4 x 4 cells contain geometry

    [[nodiscard]] bool maps() const { return albedo || surface; }      ///< has LobeMaps
    [[nodiscard]] bool map_sums() const { return maps() || tangents; } ///< has MapSums with masks
};

/// The occupied voxels of one 8 x 8 x 8 cell: laid out as a VDB leaf.
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

/// In which order a voxel's lobes merge when fewer are wanted: with n lobes left, lobe n - 1 joins
/// lobe `merge_target(order, n - 1)`. Lobe 1 joins lobe 0.
[[nodiscard]] constexpr int merge_target(std::uint32_t order, int lobe) {
    return lobe < 2 ? 0 : static_cast<int>(order >> (4 * (lobe - 2)) & 15u);
}

/// The occupied voxels of one block. Voxels of a leaf follow each other in ascending (x, y, z). The
/// first lobe of a voxel is its heaviest, the others follow in the order that `merge_order` needs.
struct VoxelBlock {
    std::vector<VoxelLeaf> leaves;          ///< ascending origin (x, then y, then z)
    std::vector<Coverage> coverage;         ///< per voxel
    std::vector<std::uint8_t> lobe_count;   ///< per voxel, 1 to K
    std::vector<Lobe> lobes;                ///< per lobe
    std::vector<LobeMaps> maps;             ///< per lobe; empty unless fields.albedo or .surface
    std::vector<PackedSggx> tangents;       ///< per lobe, all zero where the material is isotropic;
                                            ///< empty unless fields.tangents
    std::vector<std::uint32_t> merge_order; ///< per voxel; empty where none has over two lobes

    std::vector<std::array<std::uint64_t, 3>> columns; ///< per voxel, per axis: bit b n + a of the
                                                       ///< other two axes; with fields.masks
    std::vector<LobeMoment> moments;                   ///< per lobe; with fields.masks
    std::vector<MapSums> map_sums; ///< per lobe; with fields.masks and fields.map_sums()
    std::vector<std::array<std::uint64_t, 3>> footprints; ///< per voxel, per axis: bit b n + a of
                                                          ///< n x n cells; with fields.footprints
    std::vector<std::array<std::uint8_t, 3>> correlation; ///< per voxel, of its face towards the
                                                          ///< next voxel on each axis, 255 = 1:
                                                          ///< the same columns; with
                                                          ///< fields.correlation
    std::vector<std::uint64_t> occupancy; ///< per voxel: cells that contain geometry (occupancy.h);
                                          ///< with fields.occupancy
    std::vector<PlaneSlab> slabs;         ///< per voxel; with fields.slabs

    /// Returns references to all vectors but `leaves`.
    template <typename Self>
    static auto arrays(Self& block) {
        return std::tie(block.coverage, block.lobe_count, block.lobes, block.maps, block.tangents,
                        block.merge_order, block.columns, block.moments, block.map_sums,
                        block.footprints, block.correlation, block.occupancy, block.slabs);
    }
    /// Calls f with each of the vectors but `leaves`.
    template <typename Self, typename F>
    static void for_each_array(Self& block, const F& f) {
        std::apply([&f](auto&... array) { (f(array), ...); }, arrays(block));
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

/// What only levels are built from goes when they are.
inline void drop_sums(VoxelBlock& block) {
    block.columns = {};
    block.moments = {};
    block.map_sums = {};
}

/// How much one level holds.
struct LevelSize {
    std::int64_t leaves = 0; ///< of 8^3 voxels with at least one active
    std::int64_t voxels = 0; ///< active ones
    std::int64_t lobes = 0;  ///< of all voxels; >= voxels
};

/// What blocks with so many leaves, voxels and lobes take in memory.
[[nodiscard]] inline std::int64_t predict_block_bytes(std::int64_t leaves,
                                                      std::int64_t voxels,
                                                      std::int64_t lobes,
                                                      const VoxelFields& fields) {
    const std::size_t per_voxel = sizeof(Coverage) + 1 + (fields.masks ? 24 : 0) +
                                  (fields.footprints != 0 ? 24 : 0) + (fields.correlation ? 3 : 0) +
                                  (fields.occupancy ? sizeof(std::uint64_t) : 0) +
                                  (fields.slabs ? sizeof(PlaneSlab) : 0);
    const std::size_t sums = sizeof(LobeMoment) + (fields.map_sums() ? sizeof(MapSums) : 0);
    const std::size_t per_lobe = sizeof(Lobe) + (fields.maps() ? sizeof(LobeMaps) : 0) +
                                 (fields.tangents ? sizeof(PackedSggx) : 0) +
                                 (fields.masks ? sums : 0);
    return leaves * static_cast<std::int64_t>(sizeof(VoxelLeaf)) +
           voxels * static_cast<std::int64_t>(per_voxel) +
           lobes * static_cast<std::int64_t>(per_lobe);
}

/// All that is known of a voxelized object, or of one level of it, beside its voxels.
struct VoxelLevelInfo {
    std::string name;           ///< the object's
    Lattice lattice;            ///< this level's
    std::int32_t level = 0;     ///< 0: the finest
    std::string lod{};          ///< method by which levels above 0 were built; empty: none yet
    bool approximate = false;   ///< levels above 0 were built from stored lobes, not from sums
    std::int32_t max_lobes = 3; ///< K
    VoxelFields fields;
    std::vector<Material> materials; ///< by lobe's material id; maps are not kept
    std::vector<YarnType> yarns;     ///< yarn types that went in, slice texels not kept
    std::string command;             ///< the command line that made it
    std::int64_t voxel_count = 0;
    std::int64_t lobe_count = 0;
};

/// Blocks of voxels that can be walked any number of times, in a fixed order: held in memory, in a
/// spool file, or read from a .vdb.
class VoxelLevel {
public:
    virtual ~VoxelLevel() = default;
    [[nodiscard]] const VoxelLevelInfo& info() const { return info_; }
    void set_info(VoxelLevelInfo info) { info_ = std::move(info); }
    [[nodiscard]] virtual std::size_t block_count() const = 0;
    /// Block i, i < block_count(). The reference holds until the next call on the same `scratch`.
    /// Safe from several threads, each with a scratch of its own.
    [[nodiscard]] virtual const VoxelBlock& block(std::size_t i, VoxelBlock& scratch) const = 0;
    /// The blocks themselves where they lie in memory and may be changed there; null elsewhere.
    [[nodiscard]] virtual std::vector<VoxelBlock>* blocks_in_memory() { return nullptr; }

protected:
    VoxelLevelInfo info_;
};

/// The levels of an object, finest first. All but lattice, level and counts of their infos agree.
using VoxelLevels = std::vector<std::unique_ptr<VoxelLevel>>;

/// A VoxelLevel in memory, whose maker fills in its blocks and its info.
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
