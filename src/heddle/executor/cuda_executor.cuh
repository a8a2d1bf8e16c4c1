#pragma once

#include <heddle/base/error.h>
#include <heddle/executor/executor.h>
#include <heddle/executor/staging.cuh>

#include <cub/device/device_scan.cuh>
#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace heddle::executor {

template <typename Op>
__global__ void for_each_kernel(const __grid_constant__ Op op, std::size_t n) {
    const std::size_t i = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
    if (i < n) op(i);
}

/// Runs on the current CUDA device, in its own stream: calls of several executors overlap. See
/// HostExecutor, which has the same calls. Memory comes from the device's pool, in stream order.
class CudaExecutor final : public Executor<CudaExecutor> {
public:
    /// @throws Error  Device: no stream can be created
    explicit CudaExecutor(Budget& budget) : Executor(budget) {
        check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "a stream");
    }
    ~CudaExecutor() override { cudaStreamDestroy(stream_); }

    template <typename T>
    [[nodiscard]] Array<T> make_zero(std::size_t n) {
        Array<T> out(*this, n);
        if (n > 0) check(cudaMemsetAsync(out.data(), 0, n * sizeof(T), stream_), "clearing");
        return out;
    }
    /// Copies; `from` may be changed as soon as it returns.
    template <typename T>
    void upload(T* to, std::span<const T> from) {
        const std::size_t bytes = from.size_bytes();
        if (bytes == 0) return;
        check(bytes < Staging::kMin
                  ? cudaMemcpyAsync(to, from.data(), bytes, cudaMemcpyHostToDevice, stream_)
                  : staging_.upload(reinterpret_cast<std::byte*>(to),
                                    reinterpret_cast<const std::byte*>(from.data()), bytes,
                                    stream_),
              "upload");
    }
    template <typename T>
    void download(std::span<T> to, const T* from) {
        const std::size_t bytes = to.size_bytes();
        if (bytes == 0) return;
        check(bytes < Staging::kMin
                  ? cudaMemcpyAsync(to.data(), from, bytes, cudaMemcpyDeviceToHost, stream_)
                  : staging_.download(reinterpret_cast<std::byte*>(to.data()),
                                      reinterpret_cast<const std::byte*>(from), bytes, stream_),
              "download");
        wait();
    }
    void wait() { check(cudaStreamSynchronize(stream_), "waiting"); }

    template <typename Op>
    void for_each(std::size_t n, const Op& op) {
        if (n == 0) return;
        constexpr std::size_t kThreads = 128;
        const std::size_t blocks = (n + kThreads - 1) / kThreads;
        if (blocks > 0x7fffffffu) {
            throw Error(ErrorCode::Device,
                        str(stage(), ": ", n, " items are too many for one launch"),
                        "lower --device-memory");
        }
        const PhaseTimer timer = begin_timing();
        for_each_kernel<<<static_cast<unsigned>(blocks), kThreads, 0, stream_>>>(op, n);
        check(cudaGetLastError(), "launch");
        if (times_ != nullptr) wait();
    }
    template <typename In, typename Out>
    void offsets(const In* count, Out* first, std::size_t n) {
        if (n > 0x7fffffffu) {
            throw Error(ErrorCode::Device,
                        str(stage(), ": ", n, " counts are too many for one scan"),
                        "lower --device-memory");
        }
        const PhaseTimer timer = begin_timing();
        check(cudaMemsetAsync(first, 0, sizeof(Out), stream_), "clearing");
        if (n == 0) return;
        std::size_t bytes = 0;
        const auto scan = [&](void* work) {
            return cub::DeviceScan::InclusiveScanInit(work, bytes, count, first + 1,
                                                      ::cuda::std::plus<Out>{}, Out{},
                                                      static_cast<int>(n), stream_);
        };
        check(scan(nullptr), "scan");
        const Array<std::byte> work = make<std::byte>(bytes);
        check(scan(work.data()), "scan");
        if (times_ != nullptr) wait();
    }

private:
    [[nodiscard]] PhaseTimer begin_timing() {
        if (times_ != nullptr) wait(); // earlier launches belong to their own phase
        return PhaseTimer(times_, stage());
    }
    void check(cudaError_t status, const char* what) const {
        if (status == cudaSuccess) return;
        cudaGetLastError(); // cleared: a batch that is retried in halves must not see it
        const bool memory = status == cudaErrorMemoryAllocation;
        throw Error(memory ? ErrorCode::OutOfMemory : ErrorCode::Device,
                    str(stage(), ": ", what, ": ", cudaGetErrorString(status), ", with ",
                        budget().used(), " bytes of device memory in use"),
                    memory ? "lower --device-memory" : "use --device cpu");
    }
    void* allocate(std::size_t bytes) override {
        void* data = nullptr;
        check(cudaMallocAsync(&data, bytes, stream_), "memory");
        return data;
    }
    // a failure here is reported by the next checked call
    void release(void* data) noexcept override { cudaFreeAsync(data, stream_); }

    cudaStream_t stream_ = nullptr;
    Staging staging_;
};

} // namespace heddle::executor
