#include <heddle/device/level/build_batch.h>

#include <heddle/executor/host_executor.h>

namespace heddle {

template void build_batch_levels(
    executor::HostExecutor&, LevelArrays, std::size_t, const BatchOptions&, BatchLevels&);

} // namespace heddle
