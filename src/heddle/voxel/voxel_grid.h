#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/geometry.h>
#include <heddle/sggx/packed.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// One lattice for all objects: voxel (i, j, k) spans [i, i + 1) x voxel_size.x and so on; the corner
/// of index (0, 0, 0) is the scene's origin.
struct Lattice {
    Vec3d voxel_size{1.0, 1.0, 1.0}; ///< scene units, > 0
    std::int32_t subvoxels = 8;      ///< per voxel axis: 1, 2, 4 or 8
};

/// What a voxel hides: 16-bit fixed point, 65535 = 1.
struct Coverage {
    std::uint16_t x = 0; ///< covered fraction of the face seen along x
    std::uint16_t y = 0;
    std::uint16_t z = 0;
    std::uint16_t occupancy = 0; ///< hit subvoxels / subvoxels          [Fabre26, eq. 12]
    friend bool operator==(const Coverage&, const Coverage&) = default;
};
static_assert(sizeof(Coverage) == 8);

/// One SGGX of a voxel with its share and material: of tangents for a fiber material, of normals for
/// a surface.
struct Lobe {
    PackedSggx sggx;
    std::uint8_t weight = 0;   ///< share of the voxel's directed area, 255 = all; >= 1
    std::uint8_t material = 0; ///< index into VoxelGridInfo::materials
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

/// Which of the optional data a grid holds: absent when no material's maps vary them.
struct VoxelGridFields {
    bool albedo = false;   ///< LobeMaps::albedo
    bool surface = false;  ///< LobeMaps::roughness, metalness, anisotropy
    bool tangents = false; ///< a second SGGX per lobe: tangents of anisotropic surfaces
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

/// The occupied voxels of one block. Voxels of a leaf follow each other in ascending (x, y, z), the
/// lobes of a voxel by falling weight.
struct VoxelBlock {
    std::vector<VoxelLeaf> leaves;        ///< ascending origin (x, then y, then z)
    std::vector<Coverage> coverage;       ///< per voxel
    std::vector<std::uint8_t> lobe_count; ///< per voxel, 1 to K
    std::vector<Lobe> lobes;              ///< per lobe
    std::vector<LobeMaps> maps;           ///< per lobe; empty unless fields.albedo or .surface
    std::vector<PackedSggx> tangents;     ///< per lobe, all zero where the material is isotropic;
                                          ///< empty unless fields.tangents
    [[nodiscard]] std::int64_t byte_count() const {
        return static_cast<std::int64_t>(
            leaves.capacity() * sizeof(VoxelLeaf) + coverage.capacity() * sizeof(Coverage) +
            lobe_count.capacity() + lobes.capacity() * sizeof(Lobe) +
            maps.capacity() * sizeof(LobeMaps) + tangents.capacity() * sizeof(PackedSggx));
    }
};

/// All that is known of a voxelized object beside its voxels.
struct VoxelGridInfo {
    std::string name; ///< the object's
    Lattice lattice;
    std::int32_t max_lobes = 3; ///< K
    VoxelGridFields fields;
    std::vector<Material> materials; ///< by lobe's material id; maps are not kept
    std::vector<YarnType> yarns;     ///< yarn types that went in, slice texels not kept
    std::string command;             ///< the command line that made it
    std::int64_t voxel_count = 0;
    std::int64_t lobe_count = 0;
};

/// Blocks of voxels that can be walked any number of times, in a fixed order: held in memory, in a
/// spool file, or read from a .vdb.
class VoxelSource {
public:
    virtual ~VoxelSource() = default;
    [[nodiscard]] virtual const VoxelGridInfo& info() const = 0;
    [[nodiscard]] virtual std::size_t block_count() const = 0;
    /// Block i, i < block_count(). The reference holds until the next call on the same `scratch`.
    /// Safe from several threads, each with a scratch of its own.
    [[nodiscard]] virtual const VoxelBlock& block(std::size_t i, VoxelBlock& scratch) const = 0;
};

/// A VoxelSource in memory.
struct VoxelGrid final : VoxelSource {
    VoxelGridInfo about;
    std::vector<VoxelBlock> blocks;

    [[nodiscard]] const VoxelGridInfo& info() const override { return about; }
    [[nodiscard]] std::size_t block_count() const override { return blocks.size(); }
    [[nodiscard]] const VoxelBlock& block(std::size_t i, VoxelBlock&) const override {
        return blocks[i];
    }
};

} // namespace heddle
