#include <heddle/base/offset_search.h>

#include <gtest/gtest.h>

#include <vector>

namespace heddle {
namespace {

TEST(OffsetSearch, EmptyRangesHoldNothing) {
    const std::vector<std::uint64_t> offsets{0, 0, 3, 3, 3, 4, 9, 9};
    const std::vector<std::uint64_t> expected{1, 1, 1, 4, 5, 5, 5, 5, 5};
    for (std::uint64_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(range_of(offsets.data(), offsets.size() - 1, i), expected[i]) << i;
    }
}

TEST(OffsetSearch, OneRangeHoldsAll) {
    const std::uint64_t offsets[] = {0, std::uint64_t{1} << 40};
    EXPECT_EQ(range_of(offsets, 1, 0), 0u);
    EXPECT_EQ(range_of(offsets, 1, offsets[1] - 1), 0u);
}

} // namespace
} // namespace heddle
