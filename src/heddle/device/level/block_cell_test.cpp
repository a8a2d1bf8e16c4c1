#include <heddle/device/level/block_cell.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

TEST(BlockCell, ZOrderHasAPlaceForEveryVoxelOfABlock) {
    for (std::uint32_t i = 0; i < kVoxelsPerBlock; ++i)
        EXPECT_EQ(z_order_from_index(index_from_z_order(i)), i);
}

TEST(BlockCell, AParentsChildrenFollowEachOther) {
    const Vec3i parent{5, 11, 2};
    for (int c = 0; c < 8; ++c) {
        const Vec3i child = parent * 2 + Vec3i{c >> 2, c >> 1 & 1, c & 1};
        EXPECT_EQ(z_order_from_index(child),
                  z_order_from_index(parent) * 8 + static_cast<std::uint32_t>(c));
    }
}

} // namespace
} // namespace heddle
