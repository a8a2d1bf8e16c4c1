#include <heddle/base/error.h>
#include <heddle/opengl/buffer.h>
#include <heddle/opengl/context.h>
#include <heddle/opengl/shader.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

namespace heddle::opengl {
namespace {

ErrorCode code_of(const auto& call) {
    try {
        call();
    } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        EXPECT_EQ(std::string(e.what()).rfind("opengl: ", 0), 0u) << e.what();
        return e.code();
    }
    return ErrorCode::Cancelled;
}

TEST(Context, GivesTheVersionAskedForAndItsLimits) {
    const Context context;
    EXPECT_FALSE(context.driver().empty());
    EXPECT_GE(context.limits().storage_bytes, 1 << 27);
    EXPECT_GE(context.limits().viewport, 16384);
    EXPECT_NO_THROW(context.check("nothing"));
}

TEST(Context, AVersionThatNoDriverHasIsOneLine) {
    EXPECT_EQ(code_of([] { const Context context({.major = 9, .minor = 9}); }), ErrorCode::Device);
    EXPECT_NO_THROW(const Context again);
}

TEST(Context, LostOutOfMemoryAndFailedCallsAreOneLineEach) {
    constexpr std::uint32_t kGuiltyReset = 0x8253;
    constexpr std::uint32_t kOutOfMemory = 0x0505;
    constexpr std::uint32_t kInvalidValue = 0x0501;
    EXPECT_EQ(code_of([] { check_status(kGuiltyReset, 0, "s"); }), ErrorCode::Device);
    EXPECT_EQ(code_of([] { check_status(0, kOutOfMemory, "s"); }), ErrorCode::OutOfMemory);
    EXPECT_EQ(code_of([] { check_status(0, kInvalidValue, "s"); }), ErrorCode::Device);
    EXPECT_NO_THROW(check_status(0, 0, "s"));
}

TEST(Program, WhatTheDriverRefusesIsOneLineWithTheShadersName) {
    const Context context;
    try {
        (void)Program::compute("squares", "", "void main() { x; }");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::Internal);
        EXPECT_NE(std::string(e.what()).find("'squares'"), std::string::npos);
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
}

TEST(Program, DispatchReachesEveryItemOnceAlsoInManyRows) {
    const Context context;
    const std::size_t items = 5'000'001; // more groups of 64 than one row has
    const Buffer out("counts", items * sizeof(std::uint32_t));
    out.clear();
    out.bind_storage(0);
    const Program program = Program::compute("count", "", R"(
layout(std430, binding = 0) buffer Counts { uint count[]; };
void main() {
    if (item() >= uint(count.length())) return;
    atomicAdd(count[item()], item() % 7u + 1u);
}
)");
    program.dispatch(items);
    std::vector<std::uint32_t> counts(items);
    out.read(std::as_writable_bytes(std::span(counts)));
    context.check("count");
    for (std::size_t i = 0; i < items; ++i) ASSERT_EQ(counts[i], i % 7 + 1) << i;
}

TEST(Buffer, GivesBackWhatWasWrittenAndClears) {
    const Context context;
    std::vector<std::uint32_t> values(1000);
    std::iota(values.begin(), values.end(), 0u);
    const Buffer buffer("values", std::span<const std::uint32_t>(values));
    std::vector<std::uint32_t> back(10);
    buffer.read(std::as_writable_bytes(std::span(back)), 40);
    EXPECT_EQ(back[0], 10u);
    EXPECT_EQ(back[9], 19u);
    buffer.clear();
    buffer.read(std::as_writable_bytes(std::span(back)), 0);
    EXPECT_EQ(back, std::vector<std::uint32_t>(10, 0u));
}

TEST(Buffer, MoreThanTheDriverHasIsOutOfMemory) {
    const Context context;
    EXPECT_EQ(code_of([] { const Buffer buffer("too much", std::size_t{1} << 46); }),
              ErrorCode::OutOfMemory);
}

} // namespace
} // namespace heddle::opengl
