#pragma once

#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/voxel_level.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

// Voxels for tests and benchmarks that are made without the voxelizer.

namespace heddle::testing {

/// Returns the packed SGGX of a needle along the unit vector `d`: eigenvalues 0.9 x (1, w^2, w^2).
inline PackedSggx needle(Vec3f d, float w = 0.15f) {
    const float k = 0.9f, e = w * w * k;
    const auto entry = [&](int a, int b) { return (k - e) * d[a] * d[b] + (a == b ? e : 0.0f); };
    return pack({entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)});
}

struct TestVoxel {
    Coverage coverage;
    std::vector<Lobe> lobes;
};
using VoxelMap = std::map<std::tuple<int, int, int>, TestVoxel>;

/// Appends one voxel to a block's arrays.
inline void push_voxel(VoxelBlock& block, Coverage coverage, const std::vector<Lobe>& lobes) {
    block.coverage.push_back(coverage);
    block.lobe_count.push_back(static_cast<std::uint8_t>(lobes.size()));
    block.lobes.insert(block.lobes.end(), lobes.begin(), lobes.end());
}

/// Returns the blocks, of `block_voxels` voxels per axis, that hold the given voxels.
inline std::vector<VoxelBlock> make_blocks(const VoxelMap& voxels, int block_voxels = 32) {
    const auto floor_to = [](int i, int n) { return (i >= 0 ? i / n : -((n - 1 - i) / n)) * n; };
    using Key = std::tuple<int, int, int>;
    std::map<Key, std::map<Key, std::map<Key, const TestVoxel*>>> sorted;
    for (const auto& [at, voxel] : voxels) {
        const auto [x, y, z] = at;
        const Key block{floor_to(x, block_voxels), floor_to(y, block_voxels),
                        floor_to(z, block_voxels)};
        sorted[block][{floor_to(x, 8), floor_to(y, 8), floor_to(z, 8)}][at] = &voxel;
    }
    std::vector<VoxelBlock> blocks;
    for (const auto& [key, leaves] : sorted) {
        VoxelBlock& block = blocks.emplace_back();
        for (const auto& [origin, list] : leaves) {
            VoxelLeaf leaf;
            leaf.origin = {std::get<0>(origin), std::get<1>(origin), std::get<2>(origin)};
            leaf.first_voxel = static_cast<std::uint32_t>(block.coverage.size());
            leaf.first_lobe = static_cast<std::uint32_t>(block.lobes.size());
            for (const auto& [at, voxel] : list) {
                const auto [x, y, z] = at;
                leaf.active[static_cast<std::size_t>(x - leaf.origin.x)] |=
                    std::uint64_t{1} << ((y - leaf.origin.y) * 8 + (z - leaf.origin.z));
                push_voxel(block, voxel->coverage, voxel->lobes);
            }
            block.leaves.push_back(leaf);
        }
    }
    return blocks;
}

/// Fills the maps and tangents that the fields ask for with bytes that depend on the lobe.
inline void add_fields(MemoryLevel& grid) {
    for (VoxelBlock& block : grid.blocks) {
        for (std::size_t l = 0; l < block.lobes.size(); ++l) {
            const auto byte = [&](std::uint64_t k) {
                return static_cast<std::uint8_t>(hash64(7, l, k));
            };
            const VoxelFields& has = grid.info().fields;
            LobeMaps maps;
            if (has.albedo) maps.albedo = {byte(0), byte(1), byte(2)};
            if (has.surface) {
                maps.roughness = byte(3);
                maps.metalness = byte(4);
                maps.anisotropy = byte(5);
            }
            if (has.albedo || has.surface) block.maps.push_back(maps);
            if (has.tangents) {
                block.tangents.push_back(l % 3 == 0 ? PackedSggx{} : needle({1.0f, 0.0f, 0.0f}));
            }
        }
    }
}

inline void count_voxels(MemoryLevel& grid) {
    grid.info().voxel_count = grid.info().lobe_count = 0;
    for (const VoxelBlock& block : grid.blocks) {
        grid.info().voxel_count += static_cast<std::int64_t>(block.coverage.size());
        grid.info().lobe_count += static_cast<std::int64_t>(block.lobes.size());
    }
}

/// Returns a solid tube along a helix about the y axis: `turns` turns of radius `big`, tube radius
/// `thin`, in voxels. Coverage fades over the tube's last voxel; lobes are needles along the helix.
inline MemoryLevel make_helix(double big = 40.0, double thin = 6.0, int turns = 3) {
    VoxelMap voxels;
    const double pitch = 3.5 * thin;
    const int steps = static_cast<int>(turns * big * 12.0);
    for (int s = 0; s <= steps; ++s) {
        const double t = 6.283185307179586 * turns * s / steps;
        const Vec3d p{big * std::cos(t), pitch * t / 6.283185307179586, big * std::sin(t)};
        const Vec3f d = normalize(
            to_float(Vec3d{-big * std::sin(t), pitch / 6.283185307179586, big * std::cos(t)}));
        const int r = static_cast<int>(thin) + 1;
        for (int dx = -r; dx <= r; ++dx) {
            for (int dy = -r; dy <= r; ++dy) {
                for (int dz = -r; dz <= r; ++dz) {
                    const Vec3d c{std::floor(p.x) + dx, std::floor(p.y) + dy, std::floor(p.z) + dz};
                    const double far = length(c + Vec3d{0.5, 0.5, 0.5} - p);
                    const double cover = std::clamp(thin + 0.5 - far, 0.0, 1.0);
                    if (cover <= 0.0) continue;
                    TestVoxel& v = voxels[{static_cast<int>(c.x), static_cast<int>(c.y),
                                           static_cast<int>(c.z)}];
                    const auto u = static_cast<std::uint16_t>(cover * 65535.0);
                    if (v.lobes.empty() || u > v.coverage.x) v.coverage = {u, u, u, u};
                    v.lobes = {{needle(d), 255, static_cast<std::uint8_t>(s * 3 / (steps + 1))}};
                }
            }
        }
    }
    MemoryLevel grid;
    grid.info().name = "helix";
    grid.info().lattice.voxel_size = {0.1, 0.1, 0.1};
    for (const Vec3f albedo : {Vec3f{0.8f, 0.3f, 0.2f}, {0.2f, 0.6f, 0.3f}, {0.2f, 0.3f, 0.8f}}) {
        Material m;
        m.name = "yarn " + std::to_string(grid.info().materials.size());
        m.kind = MaterialKind::Fiber;
        m.albedo = albedo;
        grid.info().materials.push_back(m);
    }
    grid.blocks = make_blocks(voxels);
    count_voxels(grid);
    return grid;
}

/// Returns a block of cloth, two leaves thick and 4 x 4 leaves wide: 37 % of the voxels of each
/// leaf are active, and directions vary from leaf to leaf.
inline VoxelBlock make_cloth_block(int bx, int bz, int side, std::uint64_t seed) {
    VoxelBlock block;
    for (int x = 0; x < 4; ++x) {
        for (int y = 0; y < 2; ++y) { // two leaves thick
            for (int z = 0; z < 4; ++z) {
                VoxelLeaf leaf;
                leaf.origin = {(bx - side / 2) * 32 + x * 8, y * 8, (bz - side / 2) * 32 + z * 8};
                leaf.first_voxel = static_cast<std::uint32_t>(block.coverage.size());
                leaf.first_lobe = static_cast<std::uint32_t>(block.lobes.size());
                CounterRandom random{seed,
                                     hash64(1, static_cast<std::uint64_t>(leaf.origin.x),
                                            static_cast<std::uint64_t>(leaf.origin.z * 64 + y))};
                const float centre = 2.0f + 4.0f * random.uniform();
                const float angle = 6.28f * random.uniform();
                for (int i = 0; i < 512; ++i) {
                    const float across = static_cast<float>((i >> 3) & 7) - centre;
                    if (across * across + random.uniform() * 2.0f > 3.2f) continue;
                    leaf.active[static_cast<std::size_t>(i >> 6)] |= std::uint64_t{1} << (i & 63);
                    const float turn = angle + 0.4f * random.uniform();
                    const Vec3f d = normalize(Vec3f{std::cos(turn), 0.3f * across, std::sin(turn)});
                    const auto c = [&] {
                        return static_cast<std::uint16_t>(
                            65535 * (static_cast<int>(random.uniform() * 65.0f)) / 64);
                    };
                    push_voxel(block, {c(), c(), c(), c()}, {{needle(d), 255, 0}});
                }
                block.leaves.push_back(leaf);
            }
        }
    }
    return block;
}

/// Returns a sheet of about `voxels` voxels in blocks of 32 x 16 x 32.
inline MemoryLevel make_cloth(double voxels) {
    MemoryLevel grid;
    grid.info().name = "cloth";
    Material m;
    m.kind = MaterialKind::Fiber;
    grid.info().materials.push_back(m);
    const double per_block = static_cast<double>(make_cloth_block(0, 0, 1, 1).coverage.size());
    const int side = static_cast<int>(std::sqrt(voxels / per_block)) + 1;
    grid.blocks.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    parallel_chunks(grid.blocks.size(), 1, [&](std::size_t i, std::size_t) {
        const int n = static_cast<int>(i);
        grid.blocks[i] = make_cloth_block(n / side, n % side, side, 5);
    });
    count_voxels(grid);
    return grid;
}

} // namespace heddle::testing
