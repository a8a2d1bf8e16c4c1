#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>

namespace heddle {

/// Columns of a voxel's face counted in n x n cells; n = 8, and 4 of it.
///
/// Cell (q, p) is counter number Z-order (q, p), as the words are: word of 8 x 8 columns (or fewer) by word.
class Footprint {
public:
    /// @param level      of the voxel
    /// @param subvoxels  of level 0, per voxel axis
    Footprint(int level, int subvoxels) : level_(level), n_(subvoxels) {}

    /// Counts the bits of word `at` of the voxel's columns along one axis.
    void add(std::uint64_t at, std::uint64_t word) {
        if (word == 0) return;
        if (level_ >= 3) {
            count_[at >> (2 * (level_ - 3))] += std::popcount(word);
            return;
        }
        if (n_ == 8) { // one cell a column, or four or sixteen columns a cell
            const std::uint64_t first = at << (2 * (3 - level_));
            const auto& cell = kCellOfColumn[static_cast<std::size_t>(level_)];
            for (; word != 0; word &= word - 1) {
                ++count_[first + cell[static_cast<std::size_t>(std::countr_zero(word))]];
            }
            return;
        }
        const int cells = 8 >> level_; // per axis of the word
        const int spread = spread_of();
        for (; word != 0; word &= word - 1) {
            const int bit = std::countr_zero(word);
            const int p = bit % n_ * cells / n_;
            const int q = bit / n_ * cells / n_;
            for (int k = 0; k < spread * spread; ++k) {
                count_[(at << (2 * (3 - level_))) + interleave(q + k / spread, p + k % spread)] +=
                    1;
            }
        }
    }

    /// n x n bits, bit q n + p: as many as the covered share of the face rounds to, the fullest cells
    /// first, of equally full ones the lower: so the bits' own share is the coverage to 1 / (2 n n).
    [[nodiscard]] std::uint64_t bits(int n) const {
        std::array<std::int64_t, 64> keys; // fuller cells first, of equally full ones the lower
        const int merged = n == 8 ? 1 : 4;
        std::int64_t total = 0;
        for (int z = 0; z < n * n; ++z) {
            std::int64_t count = 0;
            for (int k = 0; k < merged; ++k)
                count += count_[static_cast<std::size_t>(z * merged + k)];
            int p = 0, q = 0;
            for (int b = 0; b < 3; ++b) {
                p |= (z >> (2 * b) & 1) << b;
                q |= (z >> (2 * b + 1) & 1) << b;
            }
            keys[static_cast<std::size_t>(z)] = count << 6 | (63 - (q * n + p));
            total += count;
        }
        const std::int64_t across = (std::int64_t{n_} << level_) * spread_of();
        const std::int64_t columns = across * across;
        const std::int64_t set = (2 * total * n * n + columns) / (2 * columns);
        const auto end = keys.begin() + std::min<std::int64_t>(set, n * n);
        if (end != keys.begin() + n * n) {
            std::nth_element(keys.begin(), end, keys.begin() + n * n, std::greater<>{});
        }
        std::uint64_t out = 0;
        for (auto key = keys.begin(); key != end; ++key)
            out |= std::uint64_t{1} << (63 - (*key & 63));
        return out;
    }

private:
    /// Cells per axis that one column covers, where there are fewer columns than cells.
    [[nodiscard]] int spread_of() const {
        const int columns = n_ << std::min(level_, 3);
        return columns < 8 ? 8 / columns : 1;
    }
    [[nodiscard]] static constexpr std::uint64_t interleave(int q, int p) {
        std::uint64_t z = 0;
        for (int b = 0; b < 3; ++b) {
            z |= static_cast<std::uint64_t>(p >> b & 1) << (2 * b);
            z |= static_cast<std::uint64_t>(q >> b & 1) << (2 * b + 1);
        }
        return z;
    }
    /// By level, below 3, and bit of a word of 8 x 8 columns.
    static constexpr auto make_cells() {
        std::array<std::array<std::uint8_t, 64>, 3> out{};
        for (int level = 0; level < 3; ++level) {
            for (int bit = 0; bit < 64; ++bit) {
                out[static_cast<std::size_t>(level)][static_cast<std::size_t>(bit)] =
                    static_cast<std::uint8_t>(interleave(bit / 8 >> level, bit % 8 >> level));
            }
        }
        return out;
    }
    static const std::array<std::array<std::uint8_t, 64>, 3> kCellOfColumn;

    int level_;
    int n_;
    std::array<std::int64_t, 64> count_{};
};

inline constexpr std::array<std::array<std::uint8_t, 64>, 3> Footprint::kCellOfColumn =
    Footprint::make_cells();

} // namespace heddle
