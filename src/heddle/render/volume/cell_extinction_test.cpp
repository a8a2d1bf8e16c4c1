#include <heddle/render/volume/cell_extinction.h>

#include <heddle/base/random.h>

#include <gtest/gtest.h>

#include <cmath>

namespace heddle {
namespace {

/// Returns the number of set cells in a column; u and v are the next two axes after `axis`.
int count_in_column(std::uint64_t cells, int axis, int u, int v) {
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        int at[3] = {};
        at[axis] = i;
        at[(axis + 1) % 3] = u;
        at[(axis + 2) % 3] = v;
        count += static_cast<int>(cells >> ((at[0] * 4 + at[1]) * 4 + at[2]) & 1);
    }
    return count;
}

/// Returns cells of which about half are set.
std::uint64_t random_cells(StreamRandom& random) {
    const std::uint64_t cells = random.next();
    return cells == 0 ? 1 : cells;
}

TEST(CellColumns, AreSortedByTheirSetCells) {
    StreamRandom random{4};
    for (int i = 0; i < 50; ++i) {
        const std::uint64_t cells = i == 0 ? 0 : i == 1 ? ~std::uint64_t{0} : random_cells(random);
        for (int axis = 0; axis < 3; ++axis) {
            std::array<int, 5> expected{};
            for (int c = 0; c < 16; ++c) {
                ++expected[static_cast<std::size_t>(count_in_column(cells, axis, c / 4, c % 4))];
            }
            const CellColumns columns = sort_columns(cells, axis);
            for (std::size_t n = 0; n < 5; ++n) {
                EXPECT_EQ(std::popcount(columns[n]), expected[n]) << axis << ' ' << n;
            }
        }
    }
}

TEST(CellExtinction, GivesTheCoverage) {
    StreamRandom random{5};
    for (int i = 0; i < 200; ++i) {
        const CellColumns columns = sort_columns(random_cells(random), i % 3);
        const float most = 1.0f - static_cast<float>(std::popcount(columns[0])) / 16.0f;
        const float coverage = most * (0.01f + 0.97f * random.uniform());
        const float extinction = fit_extinction(columns, coverage);
        EXPECT_NEAR(coverage_of_cells(columns, extinction), coverage, 1e-4f);
        const float stored = unpack_extinction(pack_extinction(extinction, 1.0f));
        EXPECT_NEAR(stored, extinction, 0.006f * extinction);
        EXPECT_EQ(fit_extinction(columns, most), kMostCellExtinction);
    }
    EXPECT_EQ(fit_extinction(sort_columns(1, 0), 0.0f), 0.0f);
    EXPECT_EQ(unpack_extinction(pack_extinction(0.0f, 1.0f)), 0.0f);
}

TEST(CellExtinction, OfPairsGivesTheCoverageOfBoth) {
    StreamRandom random{6};
    for (int i = 0; i < 200; ++i) {
        const std::uint64_t cells[2] = {random_cells(random), random_cells(random)};
        RowVoxel pair[2];
        for (int k = 0; k < 2; ++k) {
            pair[k].columns = sort_columns(cells[k], 2);
            pair[k].coverage = 0.7f * random.uniform();
            pair[k].extinction = fit_extinction(pair[k].columns, pair[k].coverage);
        }
        const float correlation = random.uniform();
        const float factor = fit_pair(pair[0], pair[1], correlation);
        ASSERT_GE(factor, 0.0f);
        ASSERT_LE(factor, 1.0f);
        float open = 0.0f;
        for (int c = 0; c < 16; ++c) {
            float depth = 0.0f;
            for (int k = 0; k < 2; ++k) {
                depth += pair[k].extinction / 4.0f *
                         static_cast<float>(count_in_column(cells[k], 2, c / 4, c % 4));
            }
            open += std::exp(-factor * depth) / 16.0f;
        }
        const float c1 = pair[0].coverage, c2 = pair[1].coverage;
        const float independent = c1 + c2 - c1 * c2;
        const float both = independent - correlation * (independent - std::max(c1, c2));
        EXPECT_LE(1.0f - open, both + 2e-3f);
        if (factor < 1.0f) {
            EXPECT_NEAR(1.0f - open, both, 2e-3f);
        }
    }
}

} // namespace
} // namespace heddle
