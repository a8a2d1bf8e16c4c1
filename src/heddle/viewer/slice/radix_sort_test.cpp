#include <heddle/viewer/slice/radix_sort.h>

#include <heddle/base/random.h>
#include <heddle/opengl/context.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace heddle::viewer {
namespace {

TEST(RadixSort, IsTheStableSortOfTheCpuForAnyCount) {
    const opengl::Context context;
    for (const std::uint32_t count : {1u, 2u, 63u, 1024u, 1025u, 10'000u, 300'000u}) {
        std::vector<std::uint32_t> keys(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto h = static_cast<std::uint32_t>(hash64(7, i));
            keys[i] = i % 3 == 0 ? h & 0xffu : h; // with many equal ones
        }
        std::vector<std::uint32_t> numbers(count);
        std::iota(numbers.begin(), numbers.end(), 0u);
        const RadixSort sort(count);
        sort.keys().write(std::as_bytes(std::span(keys)));
        sort.values().write(std::as_bytes(std::span(numbers)));
        sort.sort();
        std::vector<std::uint32_t> sorted(count);
        sort.values().read(std::as_writable_bytes(std::span(sorted)));
        context.check("sort");
        std::stable_sort(numbers.begin(), numbers.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
        EXPECT_EQ(sorted, numbers) << count;
    }
}

} // namespace
} // namespace heddle::viewer
