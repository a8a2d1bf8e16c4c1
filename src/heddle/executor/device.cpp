#include <heddle/executor/device.h>

#include <heddle/base/platform.h>

#if HEDDLE_HAS_CUDA
#include <cuda_runtime.h>
#endif

namespace heddle::executor {

#if HEDDLE_HAS_CUDA

Device find_device() {
    Device out;
    int count = 0;
    cudaError_t status = cudaGetDeviceCount(&count);
    if (status == cudaSuccess && count == 0) status = cudaErrorNoDevice;
    cudaDeviceProp properties{};
    std::size_t free_bytes = 0;
    std::size_t total_bytes = 0;
    if (status == cudaSuccess) status = cudaSetDevice(0);
    if (status == cudaSuccess) status = cudaGetDeviceProperties(&properties, 0);
    if (status == cudaSuccess) status = cudaMemGetInfo(&free_bytes, &total_bytes);
    cudaMemPool_t pool = nullptr;
    if (status == cudaSuccess) status = cudaDeviceGetDefaultMemPool(&pool, 0);
    if (status == cudaSuccess) {
        std::uint64_t keep = UINT64_MAX;
        status = cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &keep);
    }
    if (status != cudaSuccess) {
        out.why = cudaGetErrorString(status);
        return out;
    }
    out.name = properties.name;
    out.free_bytes = static_cast<std::int64_t>(free_bytes);
    return out;
}

#else

Device find_device() {
    Device out;
    out.why = "this build has no CUDA: configure with --preset cuda or -DHEDDLE_CUDA=ON";
    return out;
}

#endif

} // namespace heddle::executor
