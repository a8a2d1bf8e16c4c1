#pragma once

#include <heddle/base/parallel.h>

#include <cuda_runtime.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace heddle::executor {

/// Two pinned buffers for large copies between the host and the device: a copy from or into
/// ordinary memory runs at a fraction of the bus's speed and blocks the calling thread.
class Staging {
public:
    static constexpr std::size_t kBytes = std::size_t{16} << 20; ///< per buffer
    static constexpr std::size_t kMin = std::size_t{1} << 20;    ///< smaller copies go directly

    Staging() = default;
    ~Staging() {
        for (Slot& slot : slots_) {
            if (slot.event != nullptr) cudaEventDestroy(slot.event);
            if (slot.data != nullptr) cudaFreeHost(slot.data);
        }
    }
    Staging(const Staging&) = delete;
    Staging& operator=(const Staging&) = delete;

    /// Copies and waits. @return  the first failure
    cudaError_t
    download(std::byte* to, const std::byte* from, std::size_t bytes, cudaStream_t stream) {
        if (const cudaError_t made = make(); made != cudaSuccess) return made;
        const std::size_t count = (bytes + kBytes - 1) / kBytes;
        for (std::size_t k = 0; k <= count; ++k) {
            if (k < count) {
                Slot& slot = slots_[k % 2];
                const cudaError_t status = cudaMemcpyAsync(
                    slot.data, from + k * kBytes, part(bytes, k), cudaMemcpyDeviceToHost, stream);
                if (status != cudaSuccess) return status;
                cudaEventRecord(slot.event, stream);
            }
            if (k == 0) continue;
            Slot& ready = slots_[(k - 1) % 2];
            const cudaError_t status = cudaEventSynchronize(ready.event);
            if (status != cudaSuccess) return status;
            copy(to + (k - 1) * kBytes, ready.data, part(bytes, k - 1));
        }
        return cudaSuccess;
    }
    /// Copies; `from` may be changed as soon as it returns. @return  the first failure
    cudaError_t
    upload(std::byte* to, const std::byte* from, std::size_t bytes, cudaStream_t stream) {
        if (const cudaError_t made = make(); made != cudaSuccess) return made;
        for (std::size_t k = 0; k * kBytes < bytes; ++k) {
            Slot& slot = slots_[k % 2];
            cudaError_t status = cudaEventSynchronize(slot.event);
            if (status != cudaSuccess) return status;
            copy(slot.data, from + k * kBytes, part(bytes, k));
            status = cudaMemcpyAsync(to + k * kBytes, slot.data, part(bytes, k),
                                     cudaMemcpyHostToDevice, stream);
            if (status != cudaSuccess) return status;
            cudaEventRecord(slot.event, stream);
        }
        return cudaSuccess;
    }

private:
    struct Slot {
        std::byte* data = nullptr;
        cudaEvent_t event = nullptr; ///< the last copy of this buffer is done
    };
    static std::size_t part(std::size_t bytes, std::size_t k) {
        return std::min(kBytes, bytes - k * kBytes);
    }
    static void copy(std::byte* to, const std::byte* from, std::size_t bytes) {
        parallel_chunks(bytes, std::size_t{1} << 20, [&](std::size_t begin, std::size_t end) {
            std::memcpy(to + begin, from + begin, end - begin);
        });
    }
    cudaError_t make() {
        for (Slot& slot : slots_) {
            if (slot.data != nullptr) continue;
            void* data = nullptr;
            cudaError_t status = cudaHostAlloc(&data, kBytes, cudaHostAllocDefault);
            if (status != cudaSuccess) return status;
            slot.data = static_cast<std::byte*>(data);
            status = cudaEventCreateWithFlags(&slot.event, cudaEventDisableTiming);
            if (status != cudaSuccess) return status;
        }
        return cudaSuccess;
    }

    Slot slots_[2];
};

} // namespace heddle::executor
