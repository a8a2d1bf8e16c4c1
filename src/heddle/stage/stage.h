#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/bounds.h>
#include <heddle/render/camera.h>
#include <heddle/render/path.h>
#include <heddle/scene/scene.h>

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace heddle {

struct StageOptions {
    bool geometry = false; ///< objects that have explicit geometry are traced, not their volumes
    float level_offset = 0.0f; ///< PathOptions::level_offset: below 0, finer levels are needed
    /// Levels of up to so many voxels are read at once: before a picture could be missed.
    std::int64_t coarse_voxels = 400'000;
    bool flakes = false; ///< volumes are FlakeMedia of the forced level, or of the finest
};

/// A scene made ready: geometry loaded, lights and camera placed, volumes open with their coarse
/// levels read. Finer levels come one at a time, and only those that the camera can ask for.
class Stage {
public:
    /// @throws Error  as the readers; BadFile: a level that does not exist, a volume without voxels
    Stage(const Scene& scene, const StageOptions& options, Progress& progress);

    /// Reads the next finer level of a volume, coarsest first. @return false: all that is needed is
    /// there
    bool load_next_level() { return read_next(std::numeric_limits<std::int64_t>::max()); }

    [[nodiscard]] const PathScene& scene() const { return scene_; }
    [[nodiscard]] const Camera& camera() const { return *camera_; }
    [[nodiscard]] const CameraParameters& view() const { return view_; }
    [[nodiscard]] Bounds bounds() const;
    [[nodiscard]] std::int64_t byte_count() const; ///< of levels and geometry

private:
    /// A .vdb and where it stands.
    struct OpenVolume {
        std::string path;
        TraversalLevels pyramid;
        std::vector<std::int64_t> voxels; ///< per level
        double voxel_size = 0.0;          ///< longest edge of level 0, object units
        std::vector<Affine> instances;
        std::vector<std::uint32_t> materials;
        int finest_wanted = 0;
        int next = 0; ///< level to be read next
    };
    void open_volume(const SceneObject& object, const Scene& scene);
    void add_flakes(const SceneObject& object, const Scene& scene);
    void trace_geometry(const Scene& scene, const StageOptions& options, Progress& progress);
    void place_camera(const Scene& scene);
    void choose_levels();
    void read_level(OpenVolume& volume);
    /// Reads the coarsest level that is wanted, not there, and of at most so many voxels.
    bool read_next(std::int64_t most_voxels);
    void rebuild_volumes();
    [[nodiscard]] std::uint32_t
    material_of(const Scene& scene, const SceneObject& object, const Material& material);

    PathScene scene_;
    std::vector<OpenVolume> open_;
    std::vector<std::string> names_;
    Bounds surface_bounds_;
    CameraParameters view_;
    std::unique_ptr<Camera> camera_;
    std::int64_t flake_bytes_ = 0; ///< of all grids; instances share theirs
    std::int32_t width_ = 0, height_ = 0;
    int level_ = -1; ///< forced
    float level_offset_ = 0.0f;
};

} // namespace heddle
