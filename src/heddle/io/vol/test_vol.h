#pragma once

// Volumes made of bytes, for the tests of this room.

#include <heddle/io/file/test_files.h>
#include <heddle/io/vol/read_vol.h>
#include <heddle/voxel/voxel_level.h>

#include <map>
#include <string>
#include <tuple>

namespace heddle::testing {

inline std::string vol_header(int encoding, Vec3i n, int channels, Vec3f lo, Vec3f hi) {
    return std::string("VOL\3") + bytes(encoding, n.x, n.y, n.z, channels) +
           bytes(lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
}

inline std::size_t sample_count(Vec3i n) {
    return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
           static_cast<std::size_t>(n.z);
}

/// The bytes of `n` samples; `value(x, y, z)` returns those of a sample.
template <typename F>
std::string vol_samples(Vec3i n, const F& value) {
    std::string out;
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) out += value(x, y, z);
        }
    }
    return out;
}

/// A u8 density of one value, with samples one unit apart from `lo` on.
inline std::string dense_vol(Vec3i n, Vec3f lo, int value = 255) {
    const Vec3f hi{lo.x + static_cast<float>(n.x - 1), lo.y + static_cast<float>(n.y - 1),
                   lo.z + static_cast<float>(n.z - 1)};
    return vol_header(3, n, 1, lo, hi) + std::string(sample_count(n), static_cast<char>(value));
}

/// Quantized directions that are all the same.
inline std::string direction_vol(Vec3i n, Vec3f lo, int theta, int phi) {
    const Vec3f hi{lo.x + static_cast<float>(n.x - 1), lo.y + static_cast<float>(n.y - 1),
                   lo.z + static_cast<float>(n.z - 1)};
    const std::string one{static_cast<char>(theta), static_cast<char>(phi)};
    return vol_header(4, n, 3, lo, hi) + vol_samples(n, [&](int, int, int) { return one; });
}

/// A dictionary of blocks of `n` samples each, one unit apart.
inline std::string dictionary(Vec3f lo, Vec3i cells, Vec3i n, const std::vector<Vec3i>& blocks) {
    std::string out =
        bytes(lo.x, lo.y, lo.z, lo.x + static_cast<float>(cells.x * (n.x - 1)),
              lo.y + static_cast<float>(cells.y * (n.y - 1)),
              lo.z + static_cast<float>(cells.z * (n.z - 1)), cells.x, cells.y, cells.z);
    for (const Vec3i b : blocks) out += bytes(b.x, b.y, b.z);
    return out;
}

/// Writes a file whose path is not needed.
inline void put(const TempFolder& folder, const std::string& name, const std::string& content) {
    static_cast<void>(folder.write(name, content));
}

struct TestVoxel {
    Coverage coverage;
    Lobe lobe;
    friend bool operator==(const TestVoxel&, const TestVoxel&) = default;
};
using TestVoxels = std::map<std::tuple<int, int, int>, TestVoxel>;

/// All voxels of a source with one lobe per voxel; also checks the guarantees of VoxelBlock.
inline TestVoxels voxels_of(const VoxelLevel& source) {
    TestVoxels out;
    VoxelBlock scratch;
    for (std::size_t i = 0; i < source.block_count(); ++i) {
        const VoxelBlock& block = source.block(i, scratch);
        EXPECT_FALSE(block.leaves.empty());
        std::size_t v = 0;
        const VoxelLeaf* last = nullptr;
        for (const VoxelLeaf& leaf : block.leaves) {
            const Vec3i o = leaf.origin;
            EXPECT_TRUE(last == nullptr || std::tuple(last->origin.x, last->origin.y,
                                                      last->origin.z) < std::tuple(o.x, o.y, o.z));
            EXPECT_EQ(leaf.first_voxel, v);
            EXPECT_EQ(leaf.first_lobe, v);
            for (int bit = 0; bit < 512; ++bit) {
                if ((leaf.active[static_cast<std::size_t>(bit / 64)] >> (bit % 64) & 1u) == 0) {
                    continue;
                }
                EXPECT_EQ(block.lobe_count.at(v), 1);
                const bool is_new =
                    out.try_emplace({o.x + bit / 64, o.y + bit / 8 % 8, o.z + bit % 8},
                                    TestVoxel{block.coverage.at(v), block.lobes.at(v)})
                        .second;
                EXPECT_TRUE(is_new);
                ++v;
            }
            last = &leaf;
        }
        EXPECT_EQ(block.coverage.size(), v);
        EXPECT_EQ(block.lobes.size(), v);
        const std::size_t with_cells = source.info().fields.occupancy ? v : 0;
        EXPECT_EQ(block.occupancy, std::vector<std::uint64_t>(with_cells, ~std::uint64_t{0}));
    }
    EXPECT_EQ(source.info().voxel_count, static_cast<std::int64_t>(out.size()));
    EXPECT_EQ(source.info().lobe_count, static_cast<std::int64_t>(out.size()));
    return out;
}

inline VolVolume read_path(const std::string& path, const VolOptions& options = {}) {
    Progress progress;
    return read_vol(find_vol_layout(path), options, progress);
}

inline bool has_note(const VolVolume& volume, const std::string& text) {
    for (const std::string& note : volume.notes) {
        if (note.find(text) != std::string::npos) return true;
    }
    return false;
}

} // namespace heddle::testing
