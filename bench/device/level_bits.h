#pragma once

#include <heddle/lod/build_levels.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace heddle::check {

/// A hash of everything that the levels store.
[[nodiscard]] inline std::uint64_t bits_of(const VoxelLevels& levels) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](const auto& values) {
        hash = (hash ^ values.size()) * 0x100000001b3u;
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        for (std::size_t i = 0; i < values.size() * sizeof(values[0]); ++i) {
            hash = (hash ^ bytes[i]) * 0x100000001b3u;
        }
    };
    for (const auto& level : levels) {
        VoxelBlock scratch;
        for (std::size_t b = 0; b < level->block_count(); ++b) {
            const VoxelBlock& block = level->block(b, scratch);
            for (const VoxelLeaf& leaf : block.leaves) { // field by field: the struct has padding
                add(leaf.active);
                add(std::array{leaf.origin.x, leaf.origin.y, leaf.origin.z});
                add(std::array{leaf.first_voxel, leaf.first_lobe});
            }
            VoxelBlock::for_each_array(block, add);
        }
    }
    return hash;
}

} // namespace heddle::check
