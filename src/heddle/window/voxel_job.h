#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/geometry.h>
#include <heddle/raster/voxelize_slices.h>
#include <heddle/voxel/voxelize.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace heddle::window {

/// What is to be voxelized, and how.
struct VoxelRequest {
    Geometry geometry;
    VoxelizeOptions options;
    bool raster = false; ///< slices drawn by OpenGL; else fibers
    raster::RasterOptions raster_options;
};

/// What came of it.
struct VoxelResult {
    std::shared_ptr<const VoxelLevels> levels; ///< null: it failed
    std::string message;                       ///< one line
};

/// Voxelizes on a thread of its own, with an OpenGL context of its own where it draws.
class VoxelJob final : public Progress {
public:
    explicit VoxelJob(VoxelRequest request);
    /// Stops it.
    ~VoxelJob() override;
    VoxelJob(const VoxelJob&) = delete;
    VoxelJob& operator=(const VoxelJob&) = delete;

    /// What it does, and how much of that is done, of 1.
    [[nodiscard]] std::string stage() const;
    [[nodiscard]] double part() const;
    /// The result, once: when it is there.
    [[nodiscard]] std::optional<VoxelResult> poll();

    void begin(std::string_view stage, std::string_view unit, std::int64_t total) override;
    void advance(std::int64_t units) override { done_ += units; }

private:
    void run(VoxelRequest request);

    mutable std::mutex naming_;
    std::string stage_{"plan"};
    std::atomic<std::int64_t> total_{0};
    std::atomic<std::int64_t> done_{0};
    VoxelResult result_;
    std::atomic<bool> finished_{false};
    std::thread thread_; ///< last: it uses the rest
};

} // namespace heddle::window
