#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

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
        const int cells = 8 >> level_; // per axis of the word
        const int spread = spread_of();
        for (int bit = 0; bit < n_ * n_; ++bit) {
            if ((word >> bit & 1) == 0) continue;
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
        struct Cell {
            std::int64_t count;
            int bit;
        };
        std::array<Cell, 64> cells;
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
            cells[static_cast<std::size_t>(z)] = {count, q * n + p};
            total += count;
        }
        const auto end = cells.begin() + n * n;
        std::sort(cells.begin(), end, [](const Cell& a, const Cell& b) {
            return a.count != b.count ? a.count > b.count : a.bit < b.bit;
        });
        const std::int64_t across = (std::int64_t{n_} << level_) * spread_of();
        const std::int64_t columns = across * across;
        const std::int64_t set = (2 * total * n * n + columns) / (2 * columns);
        std::uint64_t out = 0;
        for (auto c = cells.begin(); c != end && c - cells.begin() < set; ++c) {
            out |= std::uint64_t{1} << c->bit;
        }
        return out;
    }

private:
    /// Cells per axis that one column covers, where there are fewer columns than cells.
    [[nodiscard]] int spread_of() const {
        const int columns = n_ << std::min(level_, 3);
        return columns < 8 ? 8 / columns : 1;
    }
    [[nodiscard]] static std::uint64_t interleave(int q, int p) {
        std::uint64_t z = 0;
        for (int b = 0; b < 3; ++b) {
            z |= static_cast<std::uint64_t>(p >> b & 1) << (2 * b);
            z |= static_cast<std::uint64_t>(q >> b & 1) << (2 * b + 1);
        }
        return z;
    }
    int level_;
    int n_;
    std::array<std::int64_t, 64> count_{};
};

} // namespace heddle
