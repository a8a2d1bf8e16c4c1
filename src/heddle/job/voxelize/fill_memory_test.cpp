#include <heddle/job/voxelize/fill_memory.h>

#include <heddle/base/error.h>

#include <gtest/gtest.h>

namespace heddle::job {
namespace {

/// A cloth: 40 bytes for each voxel of its face, and a temporary file above 3000 voxels along.
VoxelizePlan plan_cloth(const VoxelizeOptions& options) {
    if (options.voxels > 5000) throw Error(ErrorCode::InvalidArgument, "too many");
    VoxelizePlan plan;
    plan.peak_bytes = 1000 + 40 * options.voxels * options.voxels;
    plan.spool = options.voxels > 3000;
    return plan;
}

std::int64_t with_memory(std::int64_t bytes) {
    VoxelizeOptions options;
    options.memory_bytes = bytes;
    return resolution_for_memory(options, plan_cloth);
}

TEST(FillMemory, TakesAsManyVoxelsAsFitToTwoPercent) {
    for (const std::int64_t voxels : {16, 17, 100, 777, 2048, 2999}) {
        const std::int64_t found = with_memory(1000 + 40 * voxels * voxels);
        EXPECT_LE(found, voxels);
        EXPECT_GE(found, voxels - voxels / 50 - 1) << voxels;
    }
}

TEST(FillMemory, StopsWhereATemporaryFileOrAnErrorBegins) {
    const std::int64_t found = with_memory(std::int64_t{1} << 50);
    EXPECT_LE(found, 3000);
    EXPECT_GE(found, 2900);
}

TEST(FillMemory, SaysWhenNothingFitsAndPassesOtherErrorsOn) {
    EXPECT_THROW((void)with_memory(1), Error);
    const auto cancelled = [](const VoxelizeOptions&) -> VoxelizePlan {
        throw Error(ErrorCode::Cancelled, "stopped");
    };
    try {
        (void)resolution_for_memory({}, cancelled);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::Cancelled);
    }
}

} // namespace
} // namespace heddle::job
