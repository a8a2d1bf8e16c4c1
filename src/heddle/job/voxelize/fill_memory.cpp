#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/job/voxelize/fill_memory.h>

namespace heddle::job {

std::int64_t
resolution_for_memory(const VoxelizeOptions& options,
                      const std::function<VoxelizePlan(const VoxelizeOptions&)>& plan_of) {
    constexpr std::int64_t kMin = 16;
    constexpr std::int64_t kMax = std::int64_t{1} << 20;
    const std::int64_t limit =
        options.memory_bytes > 0 ? options.memory_bytes : available_bytes() / 2;
    const auto fits = [&](std::int64_t voxels) {
        VoxelizeOptions tried = options;
        tried.voxels = voxels;
        try {
            const VoxelizePlan plan = plan_of(tried);
            return !plan.spool && plan.peak_bytes <= limit;
        } catch (const Error& e) {
            if (e.code() == ErrorCode::OutOfMemory || e.code() == ErrorCode::InvalidArgument ||
                e.code() == ErrorCode::Unsupported) {
                return false; // a limit on voxels is exceeded
            }
            throw;
        }
    };
    if (!fits(kMin)) {
        throw Error(ErrorCode::OutOfMemory,
                    str("voxelize: even ", kMin, " voxels along the longest axis do not fit into ",
                        limit >> 20, " MiB"),
                    "give a larger `memory`");
    }
    std::int64_t least = kMin; // fits
    std::int64_t most = 2 * kMin;
    while (most <= kMax && fits(most)) {
        least = most;
        most *= 2;
    }
    while (most - least > least / 50 + 1) {
        const std::int64_t middle = (least + most) / 2;
        (fits(middle) ? least : most) = middle;
    }
    return least;
}

} // namespace heddle::job
