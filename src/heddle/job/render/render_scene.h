#pragma once

#include <heddle/base/progress.h>
#include <heddle/render/picture.h>
#include <heddle/scene/scene.h>

#include <cstdint>
#include <optional>
#include <string>

namespace heddle::job {

struct PictureSize {
    std::int32_t width = 512; ///< px
    std::int32_t height = 512;
};

/// What is asked of a picture. Nothing is required; what is not given is the scene's.
struct RenderOptions {
    bool geometry = false;      ///< objects that have geometry are traced, not their volumes
    std::optional<int> level{}; ///< of detail everywhere; none: by the footprint of each ray
    double level_offset = 0.0;  ///< added to what the footprint asks for
    std::optional<std::string> transport{}; ///< one of transport_names()
    std::optional<std::int64_t> samples{};  ///< per pixel: stops there
    std::optional<double> time{};           ///< seconds: stops after the pass that ends then
    std::optional<double> noise{};          ///< stops below this error of the mean luminance
    std::optional<PictureSize> size{};
    std::optional<std::uint64_t> seed{};
    double exposure = 0.0; ///< stops, of a .png
    bool resume = false;   ///< goes on from OUTPUT.checkpoint
    std::string command{}; ///< goes into an .exr
};

struct RenderReport {
    PictureSize size{};
    std::int64_t samples = 0;                 ///< per pixel
    std::int64_t resumed_from = 0;            ///< of these, from a checkpoint
    double noise = 0.0;                       ///< Picture::noise
    double first_picture_seconds = 0.0;       ///< until a coarse picture stood in the file
    double load_seconds = 0.0;                ///< in levels read after it
    double render_seconds = 0.0;              ///< in passes
    std::optional<double> paths_per_second{}; ///< none: no time was spent
    std::int64_t scene_bytes = 0;             ///< levels and geometry in memory
    std::int64_t peak_bytes = 0;              ///< resident, of the process so far
};

struct RenderResult {
    Picture picture{};
    RenderReport report{};
};

/// The scene of a file: a scene file, or a .vdb that is framed and lit.
/// @throws OptionError  `geometry` of a .vdb
/// @throws Error        as read_scene
[[nodiscard]] Scene load_scene(const std::string& path, const RenderOptions& options);

/// Renders a scene, in memory.
/// @throws OptionError  a number out of range, `resume`
/// @throws Error        as Stage; Cancelled
[[nodiscard]] RenderResult
render_scene(const Scene& scene, const RenderOptions& options, Progress& progress);

/// Renders into an .exr or .png, with a checkpoint beside it while it is not done. Cancelled, the
/// picture so far and its checkpoint stay.
/// @throws OptionError  also another suffix
/// @throws Error        also as render_to_file; CannotWrite
RenderReport render_scene_to_file(const Scene& scene,
                                  const std::string& output,
                                  const RenderOptions& options,
                                  Progress& progress);

/// load_scene(), then render_scene_to_file().
RenderReport render_scene_to_file(const std::string& path,
                                  const std::string& output,
                                  const RenderOptions& options,
                                  Progress& progress);

} // namespace heddle::job
