#include <heddle/render/volume/cell_extinction.h>

#include <algorithm>

namespace heddle {
namespace {

constexpr float kLeastLog = -10.0f; ///< log2 of the extinction of code 1
constexpr float kMostLog = 6.0f;    ///< of code 1023
constexpr float kStepsPerLog = 1022.0f / (kMostLog - kLeastLog);

std::array<float, kCells + 1> count_columns(const CellColumns& columns) {
    std::array<float, kCells + 1> count{};
    for (std::size_t n = 0; n < count.size(); ++n) {
        count[n] = static_cast<float>(std::popcount(columns[n]));
    }
    return count;
}

/// The columns of a pair of voxels with the same optical depth.
struct PairColumns {
    float count;
    float depth;
};

/// @return  the number of entries of `out` that are used
std::size_t
list_pair_columns(const RowVoxel& first, const RowVoxel& second, std::array<PairColumns, 25>& out) {
    std::size_t used = 0;
    for (std::size_t i = 0; i <= kCells; ++i) {
        for (std::size_t k = 0; k <= kCells; ++k) {
            const int count = std::popcount(first.columns[i] & second.columns[k]);
            if (count == 0) continue;
            out[used++] = {static_cast<float>(count), (static_cast<float>(i) * first.extinction +
                                                       static_cast<float>(k) * second.extinction) /
                                                          kCells};
        }
    }
    return used;
}

} // namespace

namespace detail {

const std::array<float, 1024>& extinction_table() {
    static const std::array<float, 1024> table = [] {
        std::array<float, 1024> out{};
        for (std::size_t i = 1; i < out.size(); ++i) {
            out[i] = std::exp2(kLeastLog + static_cast<float>(i - 1) / kStepsPerLog);
        }
        return out;
    }();
    return table;
}

} // namespace detail

CellExtinction pack_extinction(float extinction, float in_row) {
    if (!(extinction > 0.0f)) return {};
    const float step = std::round((std::log2(extinction) - kLeastLog) * kStepsPerLog);
    const auto code = static_cast<std::uint32_t>(std::clamp(step, 0.0f, 1022.0f)) + 1;
    const auto part =
        static_cast<std::uint32_t>(std::clamp(std::round(in_row * 63.0f), 1.0f, 63.0f));
    return {static_cast<std::uint16_t>(code << 6 | part)};
}

float fit_extinction(const CellColumns& columns, float coverage) {
    if (!(coverage > 0.0f)) return 0.0f;
    const std::array<float, kCells + 1> count = count_columns(columns);
    const float open = 16.0f * (1.0f - coverage); // columns that are passed
    if (open <= count[0]) return kMostCellExtinction;
    // Newton's method in the transmittance x of one cell, where the sum of count[n] x^n is `open`:
    // convex, so that it falls to the root from x = 1.
    float x = 1.0f;
    for (int i = 0; i < 40; ++i) {
        const float sum =
            (((count[4] * x + count[3]) * x + count[2]) * x + count[1]) * x + count[0];
        const float slope =
            ((4.0f * count[4] * x + 3.0f * count[3]) * x + 2.0f * count[2]) * x + count[1];
        if (!(slope > 0.0f)) break;
        const float next = std::max(x - (sum - open) / slope, 0.0f);
        const bool done = x - next <= 1e-5f * x;
        x = next;
        if (done) break;
    }
    return x > 0.0f ? std::min(-kCells * std::log(x), kMostCellExtinction) : kMostCellExtinction;
}

float coverage_of_cells(const CellColumns& columns, float extinction) {
    const std::array<float, kCells + 1> count = count_columns(columns);
    const float x = std::exp(-extinction / kCells);
    const float sum = (((count[4] * x + count[3]) * x + count[2]) * x + count[1]) * x + count[0];
    return 1.0f - sum * (1.0f / 16.0f);
}

float fit_pair(const RowVoxel& first, const RowVoxel& second, float correlation) {
    const float c1 = first.coverage, c2 = second.coverage;
    const float independent = c1 + c2 - c1 * c2;
    const float both = independent - correlation * (independent - std::max(c1, c2));
    std::array<PairColumns, 25> columns;
    const std::size_t used = list_pair_columns(first, second, columns);
    const float open = 16.0f * (1.0f - both);
    float factor = 1.0f;
    for (int i = 0; i < 20; ++i) { // Newton's method, convex: rises to the root after a first step
        float sum = 0.0f, slope = 0.0f;
        for (std::size_t k = 0; k < used; ++k) {
            const float passed = columns[k].count * std::exp(-factor * columns[k].depth);
            sum += passed;
            slope += columns[k].depth * passed;
        }
        if (i == 0 && sum >= open) return 1.0f;
        if (!(slope > 0.0f)) return 1.0f;
        const float next = std::clamp(factor + (sum - open) / slope, 0.0f, 1.0f);
        const bool done = std::fabs(next - factor) < 1e-3f;
        factor = next;
        if (done) break;
    }
    return factor;
}

} // namespace heddle
