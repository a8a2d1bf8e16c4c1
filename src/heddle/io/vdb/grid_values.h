#pragma once

#include <heddle/sggx/eigen.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/leaf_voxels.h>
#include <heddle/voxel/voxel_level.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

// The values that each grid of the file stores for a voxel, one struct per kind. `has`: whether
// voxel v of the block, whose first lobe is l, is active in the grid; `value`: the value that is
// written; `put` stores it in the block's arrays, already resized. Derived grids have no `put`.

namespace heddle {

static_assert(std::endian::native == std::endian::little, "values are written unchanged");

/// The little-endian integer with the bytes of `a`, followed by zeros.
template <typename Integer, typename T>
[[nodiscard]] Integer bytes_as(const T& a) {
    static_assert(sizeof(T) <= sizeof(Integer));
    Integer out = 0;
    std::memcpy(&out, &a, sizeof(T));
    return out;
}

/// The reverse: a T of the lowest bytes of `value`.
template <typename T, typename Integer>
[[nodiscard]] T from_bytes(Integer value) {
    static_assert(sizeof(T) <= sizeof(Integer));
    static_assert(std::is_trivially_copyable_v<T>);
    T out{};
    std::memcpy(static_cast<void*>(&out), &value, sizeof(T));
    return out;
}

/// Extinction per scene unit: the mean over the axes of -ln(1 - c_a) / h_a, where c_a is at most 1
/// - 1 / (2 columns).
struct DensityValues {
    using Value = float;
    std::vector<double> depth; ///< -ln(1 - c), by coverage
    Vec3d scale;               ///< 1 / (3 h)

    explicit DensityValues(const Lattice& lattice) : depth(65536) {
        const double columns = static_cast<double>(lattice.subvoxels) * lattice.subvoxels;
        const double cap = 1.0 - 0.5 / columns;
        for (std::size_t i = 0; i < depth.size(); ++i) {
            depth[i] = -std::log1p(-std::min(static_cast<double>(i) / 65535.0, cap));
        }
        for (int a = 0; a < 3; ++a) scale[a] = 1.0 / (3.0 * lattice.voxel_size[a]);
    }
    [[nodiscard]] bool has(const VoxelBlock&, std::size_t, std::size_t) const { return true; }
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        const Coverage& c = b.coverage[v];
        return static_cast<float>(depth[c.x] * scale.x + depth[c.y] * scale.y +
                                  depth[c.z] * scale.z);
    }
};

/// Principal direction of the heaviest lobe, if its material is of one kind.
struct DirectionValues {
    using Value = Vec3f;
    std::array<bool, 256> wanted{}; ///< by material id

    DirectionValues(const std::vector<Material>& materials, MaterialKind kind) {
        const std::size_t n = std::min<std::size_t>(materials.size(), 256);
        for (std::size_t m = 0; m < n; ++m) wanted[m] = materials[m].kind == kind;
    }
    [[nodiscard]] bool has(const VoxelBlock& b, std::size_t, std::size_t l) const {
        return wanted[b.lobes[l].material];
    }
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        return principal_direction(unpack(b.lobes[l].sggx));
    }
};

/// Shared by the grids that are active in every voxel.
struct OfVoxel {
    [[nodiscard]] bool has(const VoxelBlock&, std::size_t, std::size_t) const { return true; }
    [[nodiscard]] bool every_voxel() const { return true; }
};

struct CoverageValues : OfVoxel {
    using Value = std::int64_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return bytes_as<Value>(b.coverage[v]);
    }
    void put(VoxelBlock& b, std::size_t v, std::size_t, Value from) const {
        b.coverage[v] = from_bytes<Coverage>(from);
    }
};

/// The columns along one axis.
struct ColumnValues : OfVoxel {
    using Value = std::int64_t;
    std::size_t axis = 0;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return std::bit_cast<Value>(b.columns[v][axis]);
    }
    void put(VoxelBlock& b, std::size_t v, std::size_t, Value from) const {
        b.columns[v][axis] = std::bit_cast<std::uint64_t>(from);
    }
};

/// The footprint of 8 x 8 cells along one axis.
struct FootprintAxisValues : OfVoxel {
    using Value = std::int64_t;
    std::size_t axis = 0;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return std::bit_cast<Value>(b.footprints[v][axis]);
    }
    void put(VoxelBlock& b, std::size_t v, std::size_t, Value from) const {
        b.footprints[v][axis] = std::bit_cast<std::uint64_t>(from);
    }
};

/// The footprints of 4 x 4 cells: 16 bits per axis.
struct FootprintValues : OfVoxel {
    using Value = std::int64_t;
    using Words = std::array<std::uint16_t, 3>;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        Words words{};
        for (std::size_t a = 0; a < 3; ++a) {
            words[a] = static_cast<std::uint16_t>(b.footprints[v][a]);
        }
        return bytes_as<Value>(words);
    }
    void put(VoxelBlock& b, std::size_t v, std::size_t, Value from) const {
        const auto words = from_bytes<Words>(from);
        for (std::size_t a = 0; a < 3; ++a) b.footprints[v][a] = words[a];
    }
};

/// The cells that contain geometry.
struct OccupancyValues : OfVoxel {
    using Value = std::int64_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return std::bit_cast<Value>(b.occupancy[v]);
    }
    void put(VoxelBlock& b, std::size_t v, std::size_t, Value from) const {
        b.occupancy[v] = std::bit_cast<std::uint64_t>(from);
    }
};

struct CorrelationValues : OfVoxel {
    using Value = std::int32_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return bytes_as<Value>(b.correlation[v]);
    }
    void put(VoxelBlock& b, std::size_t v, std::size_t, Value from) const {
        b.correlation[v] = from_bytes<std::array<std::uint8_t, 3>>(from);
    }
};

/// The two planes of the first lobe.
struct SlabValues : OfVoxel {
    using Value = std::int32_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return bytes_as<Value>(b.slabs[v]);
    }
    void put(VoxelBlock& b, std::size_t v, std::size_t, Value from) const {
        b.slabs[v] = from_bytes<PlaneSlab>(from);
    }
};

/// Merge orders; two lobes have only one, so it is stored for voxels with more.
struct MergeValues {
    using Value = std::int32_t;
    [[nodiscard]] bool has(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return b.lobe_count[v] > 2 && !b.merge_order.empty();
    }
    [[nodiscard]] bool every_voxel() const { return false; }
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return std::bit_cast<Value>(b.merge_order[v]);
    }
    void put(VoxelBlock& b, std::size_t v, std::size_t, Value from) const {
        b.merge_order[v] = std::bit_cast<std::uint32_t>(from);
    }
};

/// Shared by the grids of lobe `k`: active in voxels with more than k lobes.
struct OfLobe {
    std::size_t k = 0;
    [[nodiscard]] bool has(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return b.lobe_count[v] > k;
    }
    [[nodiscard]] bool every_voxel() const { return k == 0; }
};

struct LobeValues : OfLobe {
    using Value = std::int64_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        return bytes_as<Value>(b.lobes[l + k]);
    }
    void put(VoxelBlock& b, std::size_t, std::size_t l, Value from) const {
        b.lobes[l + k] = from_bytes<Lobe>(from);
    }
};

struct AlbedoValues : OfLobe {
    using Value = std::int32_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        return bytes_as<Value>(b.maps[l + k].albedo);
    }
    void put(VoxelBlock& b, std::size_t, std::size_t l, Value from) const {
        b.maps[l + k].albedo = from_bytes<std::array<std::uint8_t, 3>>(from);
    }
};

struct SurfaceValues : OfLobe {
    using Value = std::int32_t;
    using Bytes = std::array<std::uint8_t, 3>;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        const LobeMaps& m = b.maps[l + k];
        return bytes_as<Value>(Bytes{m.roughness, m.metalness, m.anisotropy});
    }
    void put(VoxelBlock& b, std::size_t, std::size_t l, Value from) const {
        const auto bytes = from_bytes<Bytes>(from);
        LobeMaps& m = b.maps[l + k];
        m.roughness = bytes[0];
        m.metalness = bytes[1];
        m.anisotropy = bytes[2];
    }
};

struct AnisoValues : OfLobe {
    using Value = std::int64_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        return bytes_as<Value>(b.tangents[l + k]);
    }
    void put(VoxelBlock& b, std::size_t, std::size_t l, Value from) const {
        b.tangents[l + k] = from_bytes<PackedSggx>(from);
    }
};

inline constexpr std::size_t kMomentSums = sizeof(LobeMoment) / sizeof(std::int64_t);
inline constexpr std::size_t kMapSums = sizeof(MapSums) / sizeof(std::int64_t);

/// One of the sums of a lobe: first those of LobeMoment, then those of MapSums.
struct SumValues : OfLobe {
    using Value = std::int64_t;
    std::size_t part = 0;
    /// A pointer to it: the structs consist of 64-bit numbers.
    template <typename Block>
    [[nodiscard]] auto place(Block& b, std::size_t l) const {
        using Byte = std::conditional_t<std::is_const_v<Block>, const char, char>;
        Byte* const of_lobe = part < kMomentSums ? reinterpret_cast<Byte*>(&b.moments[l + k])
                                                 : reinterpret_cast<Byte*>(&b.map_sums[l + k]);
        return of_lobe + sizeof(Value) * (part < kMomentSums ? part : part - kMomentSums);
    }
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        Value out = 0;
        std::memcpy(&out, place(b, l), sizeof(out));
        return out;
    }
    void put(VoxelBlock& b, std::size_t, std::size_t l, Value from) const {
        std::memcpy(place(b, l), &from, sizeof(from));
    }
};

/// Calls put(x, bit, v, l) for each voxel of the leaf that is active in the grid, in the order of
/// the leaf.
template <typename Values, typename Put>
void for_each_in_grid(const VoxelBlock& block,
                      const VoxelLeaf& leaf,
                      const Values& values,
                      const Put& put) {
    std::size_t v = leaf.first_voxel;
    std::size_t l = leaf.first_lobe;
    for_each_active(leaf.active, [&](std::size_t x, int bit) {
        if (values.has(block, v, l)) put(x, bit, v, l);
        l += block.lobe_count[v++];
    });
}

} // namespace heddle
