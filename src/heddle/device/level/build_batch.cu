#include <heddle/device/level/build_batch.h>

#include <heddle/executor/cuda_executor.cuh>

namespace heddle {

template void build_batch_levels(
    executor::CudaExecutor&, LevelArrays, std::size_t, const BatchOptions&, BatchLevels&);

} // namespace heddle
