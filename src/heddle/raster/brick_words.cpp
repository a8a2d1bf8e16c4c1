#include <heddle/raster/brick_words.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace heddle::raster {
namespace {

constexpr std::size_t kSubWords = 6;     ///< first word of subvoxels
constexpr std::size_t kMomentWords = 22; ///< xx yy xy xz yz
constexpr std::size_t kWeightWord = 27;  ///< the moment's trace
constexpr std::size_t kColorWords = 28;  ///< white minus the colour

using VoxelWords = std::span<const std::uint32_t, kVoxelWords>;

std::uint64_t join(std::uint32_t low, std::uint32_t high) {
    return low | static_cast<std::uint64_t>(high) << 32;
}

/// Returns the density, 255 = 1, of a voxel's fragments; 0 if there were none.
std::uint32_t density_of(VoxelWords words, Composition composition) {
    switch (composition) {
    case Composition::Last: return words[1];
    case Composition::Max: return words[0];
    case Composition::Average: return words[1] == 0 ? 0 : (words[0] + words[1] / 2) / words[1];
    case Composition::Accumulate: break;
    }
    return 0;
}

/// Covers the fraction of each face and of the subvoxels that the density gives.
void set_density(VoxelSums& voxel, std::uint32_t density, int n) {
    const auto share = [&](int whole) {
        return std::max(1, (static_cast<int>(density) * whole + 127) / 255);
    };
    voxel.column.fill(spread_columns(share(n * n), n));
    int left = share(n * n * n);
    const std::uint64_t layer = spread_columns(n * n, n);
    for (std::size_t w = 0; w < voxel.sub.size() && left > 0; ++w) {
        if (n != 8 && w > 0) break;
        const int layers = n == 8 ? 1 : n; // layers of a word
        for (int k = 0; k < layers; ++k) {
            const int planes = n == 8 ? 8 - static_cast<int>(w) : n - k; // still to fill
            const int here = (left + planes - 1) / planes;
            const std::uint64_t bits = here >= n * n ? layer : spread_columns(here, n);
            voxel.sub[w] |= bits << (k * n * n);
            left -= here;
        }
    }
}

void add_lobe(VoxelWords words, const WordFormat& form, BlockSums& sums, VoxelSums& voxel) {
    // the same fibers were summed in three passes
    const int up = 20 - form.weight_bits;
    const auto scaled = [&](std::uint32_t word) {
        const std::int64_t x = static_cast<std::int32_t>(word);
        return (up >= 0 ? x * (std::int64_t{1} << up) : x / (std::int64_t{1} << -up)) / 3;
    };
    LobeSums& lobe = sums.lobe(voxel, form.material);
    constexpr std::array<std::size_t, 5> kStored{0, 1, 3, 4, 5}; // of xx yy zz xy xz yz
    for (std::size_t i = 0; i < kStored.size(); ++i) {
        lobe.moment[kStored[i]] += scaled(words[kMomentWords + i]);
    }
    const std::int64_t weight = std::max<std::int64_t>(1, scaled(words[kWeightWord]));
    const std::int64_t in_plane = scaled(words[kMomentWords]) + scaled(words[kMomentWords + 1]);
    lobe.moment[2] += std::max<std::int64_t>(0, weight - in_plane);
    lobe.weight += weight;
    if (!sums.has_maps()) return;
    MapSums& maps = sums.maps(voxel, lobe);
    for (std::size_t i = 0; i < 3; ++i) {
        maps.albedo[i] += 255 * (weight - scaled(words[kColorWords + i]));
    }
    // fiber materials have no such maps: the factors are 1
    maps.roughness += 255 * weight;
    maps.metalness += 255 * weight;
    maps.anisotropy += 255 * weight;
}

void add_voxel(VoxelWords words, const WordFormat& form, Vec3i at, BlockSums& sums) {
    if (words[kWeightWord] == 0) return;
    const bool columns = form.composition == Composition::Accumulate;
    const std::uint32_t density = density_of(words, form.composition);
    if (!columns && density == 0) return;
    VoxelSums& voxel = sums.voxel(at.x, at.y, at.z);
    if (columns) {
        for (std::size_t a = 0; a < 3; ++a) {
            voxel.column[a] |= join(words[2 * a], words[2 * a + 1]);
        }
        for (std::size_t i = 0; i < 8; ++i) {
            voxel.sub[i] |= join(words[kSubWords + 2 * i], words[kSubWords + 2 * i + 1]);
        }
    } else {
        set_density(voxel, density, form.subvoxels);
    }
    add_lobe(words, form, sums, voxel);
}

/// Returns the ranks of the columns of an 8 x 8 face in Bayer's order.
constexpr std::array<int, 64> make_ranks() {
    std::array<int, 64> ranks{};
    for (int i = 0; i < 64; ++i) {
        const int x = i % 8;
        const int y = i / 8;
        int rank = 0;
        for (int b = 0; b < 3; ++b) {
            const int xor_bit = (x ^ y) >> b & 1;
            rank |= (xor_bit << 1 | (y >> b & 1)) << (2 * (2 - b));
        }
        ranks[static_cast<std::size_t>(i)] = rank;
    }
    return ranks;
}

} // namespace

std::uint64_t spread_columns(int count, int columns) {
    static constexpr std::array<int, 64> kRanks = make_ranks();
    const int scale = 64 / (columns * columns); // larger Bayer patterns contain the smaller
    std::uint64_t bits = 0;
    for (int b = 0; b < columns; ++b) {
        for (int a = 0; a < columns; ++a) {
            const int rank = kRanks[static_cast<std::size_t>(b * 8 + a)] / scale;
            if (rank < count) bits |= std::uint64_t{1} << (b * columns + a);
        }
    }
    return bits;
}

void add_brick(std::span<const std::uint32_t> words,
               const WordFormat& form,
               Vec3i corner,
               BlockSums& sums) {
    for (std::size_t cell = 0; cell < 512; ++cell) {
        const Vec3i at = corner + Vec3i{static_cast<std::int32_t>(cell >> 6),
                                        static_cast<std::int32_t>(cell >> 3 & 7),
                                        static_cast<std::int32_t>(cell & 7)};
        add_voxel(words.subspan(cell * kVoxelWords).first<kVoxelWords>(), form, at, sums);
    }
}

} // namespace heddle::raster
