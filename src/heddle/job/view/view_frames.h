#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/stage_clock.h>
#include <heddle/job/view/view_options.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// What a view or a window shows, loaded.
struct LoadedView {
    viewer::ViewedObject subject{};
    std::string volume{}; ///< path of the .vdb that is shown; empty: none
    std::vector<std::string> notes{};
    StageTimes stages{};
};

/// Pictures without a window: once around the object.
struct FramesOptions {
    std::int64_t frames = 1;
    /// path of the .vdb that a scene file beside the pictures shows as the first one does; none:
    /// no such file
    std::optional<std::string> scene{};
};

struct FramesReport {
    std::string driver{};
    std::int64_t slices = 0;
    std::string blend{};          ///< how slices were put over each other, in words
    viewer::SliceTimes a_frame{}; ///< means, seconds
    StageTimes stages{};
};

/// Reads what is looked at. Yarns are made slices.
/// @throws OptionError  as check_view; options that the curves have no use for
/// @throws Error        as load_geometry and read_levels; Cancelled
[[nodiscard]] LoadedView
load_view(const ViewInput& input, const ViewOptions& options, Progress& progress);

/// Draws by OpenGL, in a context of its own.
/// @throws Error  Device; as viewer::Session; Cancelled
[[nodiscard]] std::vector<viewer::RgbImage> draw_frames(const viewer::ViewedObject& subject,
                                                        const ViewOptions& options,
                                                        std::int64_t frames,
                                                        Progress& progress);

/// The same into the subject's folder, which is made: frame_0000.png on, and NAME_view.toml.
/// @throws Error  also CannotWrite
FramesReport draw_frames_to_files(const viewer::ViewedObject& subject,
                                  const ViewOptions& options,
                                  const FramesOptions& frames,
                                  Progress& progress);

/// Makes a folder, and those that it lies in.
/// @throws Error  CannotWrite
void make_folder(const std::string& folder);

} // namespace heddle::job
