#include <heddle/device/build_batch.h>

#include <heddle/gpu/cuda_executor.cuh>

namespace heddle {

template void build_batch_levels(
    gpu::CudaExecutor&, LevelArrays, std::size_t, const BatchSettings&, BatchLevels&);

} // namespace heddle
