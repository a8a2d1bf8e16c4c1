#include <heddle/base/error.h>
#include <heddle/executor/atomic.h>
#include <heddle/executor/device.h>
#include <heddle/executor/host_executor.h>

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace heddle::executor {
namespace {

struct AddSquare {
    std::uint64_t* sum;
    std::uint64_t* bits;
    HEDDLE_HD void operator()(std::size_t i) const {
        atomic_add(sum, static_cast<std::uint64_t>(i * i));
        atomic_or(bits + i / 64, std::uint64_t{1} << (i % 64));
    }
};

TEST(HostExecutor, RunsEveryItemOnce) {
    Budget budget(1 << 20);
    HostExecutor exec(budget);
    const Array<std::uint64_t> sum = exec.make_zero<std::uint64_t>(1);
    const Array<std::uint64_t> bits = exec.make_zero<std::uint64_t>(100);
    exec.for_each(6400, AddSquare{sum.data(), bits.data()});
    EXPECT_EQ(exec.read(sum.data()), std::uint64_t{6399} * 6400 * 12799 / 6);
    std::vector<std::uint64_t> back(100);
    exec.download(std::span(back), bits.data());
    for (const std::uint64_t word : back) EXPECT_EQ(word, ~std::uint64_t{0});
}

TEST(HostExecutor, OffsetsAreSumsOfWhatIsBefore) {
    Budget budget(1 << 20);
    HostExecutor exec(budget);
    const std::vector<std::uint32_t> count{3, 0, 4000000000u, 1};
    const Array<std::uint32_t> in = exec.make_from(std::span(count));
    const Array<std::uint64_t> first = exec.make<std::uint64_t>(5);
    exec.offsets(in.data(), first.data(), 4);
    EXPECT_EQ(exec.read(first.data()), 0u);
    EXPECT_EQ(exec.read(first.data() + 2), 3u);
    EXPECT_EQ(exec.read(first.data() + 4), 4000000004u);
}

TEST(HostExecutor, TakesNoMoreThanTheBudgetAndGivesItBack) {
    Budget budget(1000);
    HostExecutor exec(budget);
    exec.set_phase("gather");
    {
        const Array<char> held = exec.make<char>(600);
        try {
            const Array<char> more = exec.make<char>(500);
            FAIL();
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::OutOfMemory);
            EXPECT_STREQ(
                e.what(),
                "gather: 500 bytes of device memory are needed beside 600 in use, 1000 may be used; raise --device-memory");
        }
        EXPECT_EQ(budget.used(), 600);
    }
    EXPECT_EQ(budget.used(), 0);
    EXPECT_EQ(budget.peak(), 600);
    const Array<char> all = exec.make<char>(1000);
    EXPECT_EQ(all.size(), 1000u);
}

TEST(Device, SaysWhatItIsOrWhyThereIsNone) {
    const Device device = find_device();
    EXPECT_NE(device.name.empty(), device.why.empty());
    EXPECT_EQ(device.name.empty(), device.free_bytes == 0);
}

} // namespace
} // namespace heddle::executor
