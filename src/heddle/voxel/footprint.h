#pragma once

#include <heddle/base/bits.h>

#include <cstdint>

namespace heddle {

namespace detail {

/// Returns the number in Z-order of cell (q, p) of 8 x 8, bits of q first.
[[nodiscard]] HEDDLE_HD constexpr int interleave(int q, int p) {
    int z = 0;
    for (int b = 0; b < 3; ++b) z |= (p >> b & 1) << (2 * b) | (q >> b & 1) << (2 * b + 1);
    return z;
}

struct FootprintTables {
    std::uint8_t cell[3][64]{}; ///< [level below 3][bit of a word of 8 x 8 columns]
    std::uint8_t straight[64]{};
};
[[nodiscard]] constexpr FootprintTables make_footprint_tables() {
    FootprintTables out;
    for (int i = 0; i < 64; ++i) {
        out.straight[interleave(i / 8, i % 8)] = static_cast<std::uint8_t>(i);
        for (int level = 0; level < 3; ++level) {
            const int z = interleave(i / 8 >> level, i % 8 >> level);
            out.cell[level][i] = static_cast<std::uint8_t>(z);
        }
    }
    return out;
}
/// Returns the cell, in Z-order, of a bit of a word of 8 x 8 columns, at a level below 3.
[[nodiscard]] HEDDLE_INLINE int cell_of_column(int level, int bit) {
    static constexpr FootprintTables kTables = make_footprint_tables();
    return kTables.cell[level][bit];
}
/// Returns 8 q + p for a cell's number in Z-order.
[[nodiscard]] HEDDLE_INLINE int straight(int z) {
    static constexpr FootprintTables kTables = make_footprint_tables();
    return kTables.straight[z];
}

} // namespace detail

/// Counts the covered columns of a voxel's face in 8 x 8 cells, from which 4 x 4 are summed.
///
/// The counters of cells (q, p) are in Z-order, and so are the words of 8 x 8 columns or fewer.
class Footprint {
public:
    /// @param level      level of the voxel
    /// @param subvoxels  subvoxels of level 0 per voxel axis
    HEDDLE_HD Footprint(int level, int subvoxels) : level_(level), n_(subvoxels) {}

    /// Counts the bits of word `at` of the voxel's columns along one axis.
    HEDDLE_INLINE void add(std::uint64_t at, std::uint64_t word) {
        if (word == 0) return;
        if (level_ >= 3) {
            count_[at >> (2 * (level_ - 3))] += count_bits(word);
            return;
        }
        if (n_ == 8) { // 1, 4 or 16 columns per cell
            const std::uint64_t first = at << (2 * (3 - level_));
            for (; word != 0; word &= word - 1) {
                const int cell = detail::cell_of_column(level_, lowest_bit(word));
                ++count_[first + static_cast<std::uint64_t>(cell)];
            }
            return;
        }
        const int cells = 8 >> level_; // per axis of the word
        const int spread = spread_of();
        for (; word != 0; word &= word - 1) {
            const int bit = lowest_bit(word);
            const int p = bit % n_ * cells / n_;
            const int q = bit / n_ * cells / n_;
            for (int k = 0; k < spread * spread; ++k) {
                count_[(at << (2 * (3 - level_))) +
                       detail::interleave(q + k / spread, p + k % spread)] += 1;
            }
        }
    }

    /// Returns n x n bits; bit q n + p is cell (q, p). The fullest cells are set, of equally full
    /// ones the lower, so that the share of set bits is the coverage within 1 / (2 n n).
    /// @param n  8 or 4
    [[nodiscard]] HEDDLE_INLINE std::uint64_t bits(int n) const {
        constexpr int kNarrow = 11; // 4 cells of 4^11 columns and 6 more bits fit in 31 bits
        if (level_ > kNarrow) {
            return n == 8 ? bits_of<8, std::int64_t>() : bits_of<4, std::int64_t>();
        }
        return n == 8 ? bits_of<8, std::int32_t>() : bits_of<4, std::int32_t>();
    }

private:
    template <int N, typename Key>
    [[nodiscard]] HEDDLE_INLINE std::uint64_t bits_of() const {
        Key keys[N * N]; // larger for fuller cells; of equally full ones, for the lower
        constexpr int kMerged = N == 8 ? 1 : 4;
        std::int64_t total = 0;
        Key any = 0;
        for (int z = 0; z < N * N; ++z) {
            std::int64_t count = 0;
            for (int k = 0; k < kMerged; ++k) count += count_[z * kMerged + k];
            const int at = detail::straight(z) / 8 * N + detail::straight(z) % 8;
            keys[at] = static_cast<Key>(count << 6 | (63 - at));
            any |= keys[at];
            total += count;
        }
        const std::int64_t across = (std::int64_t{n_} << level_) * spread_of();
        const std::int64_t columns = across * across;
        const std::int64_t set = (2 * total * N * N + columns) / (2 * columns);
        if (set == 0) return 0;
        const Key least = least_of(keys, any, static_cast<Key>(set));
        std::uint64_t out = 0;
        for (int i = 0; i < N * N; ++i) {
            out |= static_cast<std::uint64_t>(keys[i] >= least ? 1 : 0) << i;
        }
        return out;
    }
    /// Returns the smallest of the `set` largest keys, bit by bit, without sorting. All keys
    /// differ.
    /// @param any  OR of all keys
    template <int kCount, typename Key>
    [[nodiscard]] HEDDLE_INLINE static Key least_of(const Key (&keys)[kCount], Key any, Key set) {
        Key least = 0;
        for (Key step = highest_bit(any); step > 0; step >>= 1) {
            const Key higher = least | step;
            Key lanes[8]{};
            for (int i = 0; i < kCount; i += 8) {
                for (int k = 0; k < 8; ++k) lanes[k] -= keys[i + k] >= higher ? -1 : 0;
            }
            Key above = 0;
            for (const Key n : lanes) above += n;
            if (above >= set) least = higher;
        }
        return least;
    }
    template <typename Key>
    [[nodiscard]] HEDDLE_INLINE static Key highest_bit(Key bits) {
        Key out = 32; // keys have 6 bits or more
        while (bits >= 2 * out) out *= 2;
        return out;
    }
    /// Returns the cells per axis that one column covers; 1 unless there are fewer columns than
    /// cells.
    [[nodiscard]] HEDDLE_INLINE int spread_of() const {
        const int columns = n_ << (level_ < 3 ? level_ : 3);
        return columns < 8 ? 8 / columns : 1;
    }

    int level_;
    int n_;
    std::int64_t count_[64]{};
};

} // namespace heddle
