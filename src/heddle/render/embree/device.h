#pragma once

#include <heddle/base/progress.h>

#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>
#include <string>

namespace heddle {

/// An Embree device that counts its memory and keeps to a limit.
class EmbreeDevice {
public:
    /// @param memory_bytes  more than this, own() included, is an error
    /// @throws Error  Device: Embree does not start on this machine
    explicit EmbreeDevice(std::int64_t memory_bytes);
    ~EmbreeDevice() { rtcReleaseDevice(device_); }
    EmbreeDevice(const EmbreeDevice&) = delete;
    EmbreeDevice& operator=(const EmbreeDevice&) = delete;

    [[nodiscard]] RTCDevice get() const { return device_; }
    /// Bytes held now: Embree's, and what was owned.
    [[nodiscard]] std::int64_t byte_count() const { return bytes_; }
    [[nodiscard]] std::int64_t peak_bytes() const { return peak_; }

    /// Counts buffers of ours that Embree reads.
    /// @throws Error  OutOfMemory: more than the limit
    void own(std::int64_t bytes);
    /// Throws what went wrong since the last call.
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
    std::string message_; ///< of the last error; Embree calls back from the thread that failed
};

/// A scene that is released with its owner.
class EmbreeScene {
public:
    explicit EmbreeScene(const EmbreeDevice& device) : scene_(rtcNewScene(device.get())) {}
    ~EmbreeScene() { rtcReleaseScene(scene_); }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    [[nodiscard]] RTCScene get() const { return scene_; }
    /// Builds the tree over all that was attached.
    /// @throws Error  as EmbreeDevice::check
    void commit(const EmbreeDevice& device, Progress& progress);

private:
    RTCScene scene_;
};

} // namespace heddle
