#pragma once

#include <heddle/sggx/eigen.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/voxel_grid.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

// What each grid of the file holds of a voxel. One struct a kind: `has` says whether voxel v of the
// block, whose first lobe is l, is active in the grid; `value` is what is written.

namespace heddle {

static_assert(std::endian::native == std::endian::little, "values are written as they lie");

/// The little-endian integer that holds the bytes of `a` and then zeros.
template <typename Integer, typename T>
[[nodiscard]] Integer bytes_as(const T& a) {
    static_assert(sizeof(T) <= sizeof(Integer));
    Integer out = 0;
    std::memcpy(&out, &a, sizeof(T));
    return out;
}

/// Mean over the axes of -ln(1 - c_a) / h_a, c_a at most 1 - 1 / (2 columns): extinction per scene
/// unit.
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

/// Principal direction of the heaviest lobe, where its material is of one kind.
struct DirectionValues {
    using Value = Vec3f;
    std::array<bool, 256> wanted{}; ///< by material

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

struct CoverageValues {
    using Value = std::int64_t;
    [[nodiscard]] bool has(const VoxelBlock&, std::size_t, std::size_t) const { return true; }
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return bytes_as<Value>(b.coverage[v]);
    }
};

/// What the grids of lobe `k` share: active where a voxel has more than k lobes.
struct OfLobe {
    std::size_t k = 0;
    [[nodiscard]] bool has(const VoxelBlock& b, std::size_t v, std::size_t) const {
        return b.lobe_count[v] > k;
    }
};

struct LobeValues : OfLobe {
    using Value = std::int64_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        return bytes_as<Value>(b.lobes[l + k]);
    }
};

struct AlbedoValues : OfLobe {
    using Value = std::int32_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        return bytes_as<Value>(b.maps[l + k].albedo);
    }
};

struct SurfaceValues : OfLobe {
    using Value = std::int32_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        const LobeMaps& m = b.maps[l + k];
        return bytes_as<Value>(std::array<std::uint8_t, 3>{m.roughness, m.metalness, m.anisotropy});
    }
};

struct AnisoValues : OfLobe {
    using Value = std::int64_t;
    [[nodiscard]] Value value(const VoxelBlock& b, std::size_t, std::size_t l) const {
        return bytes_as<Value>(b.tangents[l + k]);
    }
};

/// Calls put(x, bit, v, l) for each voxel of the leaf that is active in the grid, in the leaf's
/// order.
template <typename Values, typename Put>
void for_each_active(const VoxelBlock& block,
                     const VoxelLeaf& leaf,
                     const Values& values,
                     Put put) {
    std::size_t v = leaf.first_voxel;
    std::size_t l = leaf.first_lobe;
    for (std::size_t x = 0; x < 8; ++x) {
        for (std::uint64_t w = leaf.active[x]; w != 0; w &= w - 1) {
            if (values.has(block, v, l)) put(x, std::countr_zero(w), v, l);
            l += block.lobe_count[v++];
        }
    }
}

} // namespace heddle
