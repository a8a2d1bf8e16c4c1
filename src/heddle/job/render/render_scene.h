#pragma once

#include <heddle/base/progress.h>
#include <heddle/render/picture.h>
#include <heddle/scene/scene.h>

#include <cstdint>
#include <optional>
#include <string>

namespace heddle::job {

/// The size of a picture.
struct PictureSize {
    std::int32_t width = 512; ///< px
    std::int32_t height = 512;
};

/// How a picture is rendered. Nothing is required; the scene gives what is missing.
struct RenderOptions {
    bool geometry = false;      ///< traces the geometry of objects that have it, not their volumes
    std::optional<int> level{}; ///< of detail for all rays; none: by the footprint of each ray
    double level_offset = 0.0;  ///< added to the level that the footprint gives
    std::optional<std::string> transport{}; ///< one of transport_names()
    std::optional<std::int64_t> samples{};  ///< per pixel
    std::optional<double> time{};           ///< seconds after which no further pass starts
    std::optional<double> noise{}; ///< rendering stops below this error of the mean luminance
    std::optional<PictureSize> size{};
    std::optional<std::uint64_t> seed{};
    double exposure = 0.0; ///< of a .png, in stops (factors of two)
    bool resume = false;   ///< continues from OUTPUT.checkpoint
    std::string command{}; ///< is stored in an .exr
};

/// What was rendered.
struct RenderReport {
    PictureSize size{};
    std::int64_t samples = 0;                 ///< per pixel
    std::int64_t resumed_from = 0;            ///< how many of these came from a checkpoint
    double noise = 0.0;                       ///< Picture::noise
    double first_picture_seconds = 0.0;       ///< until a coarse picture was in the file
    double load_seconds = 0.0;                ///< spent on levels that were read after it
    double render_seconds = 0.0;              ///< spent in passes
    std::optional<double> paths_per_second{}; ///< none: no pass was rendered
    std::int64_t scene_bytes = 0;             ///< levels and geometry in memory
    std::int64_t peak_bytes = 0;              ///< resident, of the process so far
};

/// A picture in memory.
struct RenderResult {
    Picture picture{};
    RenderReport report{};
};

/// Loads a scene file, or makes a scene of a .vdb with a default camera and lights.
/// @throws OptionError  `geometry` is set for a .vdb
/// @throws Error        as read_scene
[[nodiscard]] Scene load_scene(const std::string& path, const RenderOptions& options);

/// Renders a scene in memory.
/// @throws OptionError  a number is out of range; `resume` is set
/// @throws Error        as Stage; Cancelled
[[nodiscard]] RenderResult
render_scene(const Scene& scene, const RenderOptions& options, Progress& progress);

/// Renders an .exr or .png, with a checkpoint beside it until the picture is finished. When it is
/// cancelled, the unfinished picture and its checkpoint remain.
/// @throws OptionError  also: another suffix
/// @throws Error        also as render_to_file; CannotWrite
RenderReport render_scene_to_file(const Scene& scene,
                                  const std::string& output,
                                  const RenderOptions& options,
                                  Progress& progress);

/// Calls load_scene(), then render_scene_to_file().
RenderReport render_scene_to_file(const std::string& path,
                                  const std::string& output,
                                  const RenderOptions& options,
                                  Progress& progress);

} // namespace heddle::job
