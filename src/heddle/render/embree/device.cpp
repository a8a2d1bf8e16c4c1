#include <heddle/render/embree/device.h>

#include <heddle/base/parallel.h>

namespace heddle {

EmbreeDevice::EmbreeDevice(std::int64_t memory_bytes) : limit_(memory_bytes) {
    device_ = rtcNewDevice(str("threads=", thread_count()).c_str());
    if (device_ == nullptr) {
        throw Error(
            ErrorCode::Device,
            str("Embree does not start (code ", static_cast<int>(rtcGetDeviceError(nullptr)), ")"),
            "trace on a machine with SSE2, or render volumes");
    }
    rtcSetDeviceMemoryMonitorFunction(device_, &EmbreeDevice::count, this);
    rtcSetDeviceErrorFunction(device_, &EmbreeDevice::keep_message, this);
}

bool EmbreeDevice::add(std::int64_t bytes) {
    const std::int64_t now = bytes_ += bytes;
    std::int64_t peak = peak_;
    while (now > peak && !peak_.compare_exchange_weak(peak, now)) {
    }
    return now <= limit_;
}

bool EmbreeDevice::count(void* device, ssize_t bytes, bool post) {
    auto* self = static_cast<EmbreeDevice*>(device);
    const bool fits = self->add(bytes);
    if (fits || bytes <= 0 || post) return true;
    self->add(-bytes); // Embree does not allocate what is refused
    return false;
}

void EmbreeDevice::keep_message(void* device, RTCError, const char* text) {
    static_cast<EmbreeDevice*>(device)->message_ = text == nullptr ? "" : text;
}

void EmbreeDevice::throw_out_of_memory(std::int64_t needed) const {
    throw Error(ErrorCode::OutOfMemory,
                str("traced geometry takes more than ", needed, " bytes (limit ", limit_, ")"),
                "allow more memory, use fewer fibers a yarn, or render the volume");
}

void EmbreeDevice::own(std::int64_t bytes) {
    if (!add(bytes)) throw_out_of_memory(bytes_);
}

void EmbreeDevice::check(const Progress& progress) const {
    const RTCError code = rtcGetDeviceError(device_);
    progress.check();
    if (code == RTC_ERROR_NONE) return;
    if (code == RTC_ERROR_OUT_OF_MEMORY) throw_out_of_memory(peak_);
    throw Error(ErrorCode::Internal,
                str("Embree fails with code ", static_cast<int>(code), ": ", message_),
                "report this with the scene");
}

void EmbreeScene::commit(const EmbreeDevice& device, Progress& progress) {
    const auto go_on = [](void* asked, double) {
        return !static_cast<const Progress*>(asked)->cancelled();
    };
    rtcSetSceneProgressMonitorFunction(scene_, go_on, &progress);
    rtcCommitScene(scene_);
    rtcSetSceneProgressMonitorFunction(scene_, nullptr, nullptr);
    device.check(progress);
}

} // namespace heddle
