#pragma once

#include <heddle/base/progress.h>

#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>
#include <string>

namespace heddle {

/// An Embree device that counts its memory and enforces a limit.
class EmbreeDevice {
public:
    /// @param memory_bytes  limit of the memory, including own()
    /// @throws Error        Device: Embree does not start on this machine
    explicit EmbreeDevice(std::int64_t memory_bytes);
    ~EmbreeDevice() { rtcReleaseDevice(device_); }
    EmbreeDevice(const EmbreeDevice&) = delete;
    EmbreeDevice& operator=(const EmbreeDevice&) = delete;

    [[nodiscard]] RTCDevice get() const { return device_; }
    /// Returns the bytes in use: Embree's, and those counted by own().
    [[nodiscard]] std::int64_t byte_count() const { return bytes_; }
    [[nodiscard]] std::int64_t peak_bytes() const { return peak_; }

    /// Counts the bytes of a caller's buffers that Embree reads.
    /// @throws Error  OutOfMemory: the limit is exceeded
    void own(std::int64_t bytes);
    /// Throws the error that occurred since the last call, if any.
    /// @throws Error  OutOfMemory, Cancelled, Internal
    void check(const Progress& progress) const;

private:
    static bool count(void* device, ssize_t bytes, bool post);
    static void keep_message(void* device, RTCError code, const char* text);
    [[noreturn]] void throw_out_of_memory(std::int64_t needed) const;
    bool add(std::int64_t bytes);

    RTCDevice device_ = nullptr;
    std::int64_t limit_;
    std::atomic<std::int64_t> bytes_ = 0;
    std::atomic<std::int64_t> peak_ = 0;
    std::string message_; ///< of the last error, set by the thread that failed
};

/// An Embree scene, which the destructor releases.
class EmbreeScene {
public:
    explicit EmbreeScene(const EmbreeDevice& device) : scene_(rtcNewScene(device.get())) {}
    ~EmbreeScene() { rtcReleaseScene(scene_); }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    [[nodiscard]] RTCScene get() const { return scene_; }
    /// Builds the acceleration structure over all attached geometry.
    /// @throws Error  as EmbreeDevice::check
    void commit(const EmbreeDevice& device, Progress& progress);

private:
    RTCScene scene_;
};

} // namespace heddle
