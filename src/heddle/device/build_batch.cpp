#include <heddle/device/build_batch.h>

#include <heddle/gpu/host_executor.h>

namespace heddle {

template void build_batch_levels(
    gpu::HostExecutor&, LevelArrays, std::size_t, const BatchSettings&, BatchLevels&);

} // namespace heddle
