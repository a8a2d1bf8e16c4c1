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

/// How a scene is loaded.
struct StageOptions {
    bool geometry = false; ///< objects that have explicit geometry are traced, not their volumes
    float level_offset = 0.0f; ///< PathOptions::level_offset: below 0, finer levels are needed
    /// Levels of up to this many voxels are read by the constructor, which takes little time.
    std::int64_t coarse_voxels = 400'000;
    bool flakes = false; ///< makes FlakeMedia of the forced level, or of the finest
};

/// A scene that is ready to be rendered: geometry is loaded, lights and camera are placed, and the
/// coarse levels of volumes are read. Finer levels are read one at a time, as far as camera rays
/// need them.
class Stage {
public:
    /// Loads the scene, with coarse levels only.
    /// @throws Error  as the readers; BadFile: a level does not exist, or a volume has no voxels
    Stage(const Scene& scene, const StageOptions& options, Progress& progress);

    /// Reads the next finer level of a volume, coarsest first.
    /// @return  false: all levels that are needed are loaded
    bool load_next_level() { return read_next(std::numeric_limits<std::int64_t>::max()); }

    [[nodiscard]] const PathScene& scene() const { return scene_; }
    [[nodiscard]] const Camera& camera() const { return *camera_; }
    [[nodiscard]] const CameraParameters& camera_parameters() const { return parameters_; }
    [[nodiscard]] Bounds bounds() const;
    [[nodiscard]] std::int64_t byte_count() const; ///< of levels and geometry

private:
    /// A .vdb and its instances.
    struct OpenVolume {
        std::string path;
        TraversalLevels levels;
        std::vector<std::int64_t> voxels; ///< per level
        double voxel_size = 0.0;          ///< longest edge of level 0, object units
        std::vector<Affine> instances;
        std::vector<std::uint32_t> materials;
        int finest_wanted = 0;
        int next = 0;                        ///< level to be read next
        std::unique_ptr<VoxelLevel> parents; ///< the level before that, for volumes of fibers
    };
    void open_volume(const SceneObject& object, const Scene& scene, Progress& progress);
    void add_flakes(const SceneObject& object, const Scene& scene);
    void trace_geometry(const Scene& scene, const StageOptions& options, Progress& progress);
    void place_camera(const Scene& scene);
    void choose_levels();
    void read_level(OpenVolume& volume);
    /// Reads the coarsest level that is needed, not loaded, and has at most `most_voxels` voxels.
    bool read_next(std::int64_t most_voxels);
    void rebuild_volumes();
    [[nodiscard]] std::uint32_t
    material_of(const Scene& scene, const SceneObject& object, const Material& material);

    PathScene scene_;
    std::vector<OpenVolume> open_;
    std::vector<std::string> names_;
    Bounds surface_bounds_;
    CameraParameters parameters_;
    std::unique_ptr<Camera> camera_;
    std::int64_t flake_bytes_ = 0; ///< of all FlakeGrids, which instances share
    std::int32_t width_ = 0, height_ = 0;
    int level_ = -1; ///< forced
    float level_offset_ = 0.0f;
};

} // namespace heddle
