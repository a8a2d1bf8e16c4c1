#pragma once

#include <heddle/base/progress.h>
#include <heddle/job/phase_clock.h>
#include <heddle/job/view/view_options.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// The loaded contents of a view.
struct LoadedView {
    viewer::ViewedObject subject{};
    std::string volume{}; ///< path of the .vdb that is shown; empty: none
    std::vector<std::string> notes{};
    PhaseTimes phases{};
};

/// How pictures are drawn without a window. The camera moves once around the object.
struct FramesOptions {
    std::int64_t frames = 1;
    /// path of the .vdb for a scene file that repeats the first picture; none: no scene file is
    /// written
    std::optional<std::string> scene{};
};

/// What was drawn.
struct FramesReport {
    std::string driver{}; ///< of OpenGL
    std::int64_t slices = 0;
    std::string blend{};          ///< how slices were blended, in words
    viewer::SliceTimes a_frame{}; ///< mean seconds per frame
    PhaseTimes phases{};
};

/// Loads the input of a view. Procedural yarns are replaced by slices.
/// @throws OptionError  as check_view; an option does not apply to the curves
/// @throws Error        as load_geometry and read_levels; Cancelled
[[nodiscard]] LoadedView
load_view(const ViewInput& input, const ViewOptions& options, Progress& progress);

/// Draws pictures in an OpenGL context of its own.
/// @throws Error  Device: there is no OpenGL; as viewer::Session; Cancelled
[[nodiscard]] std::vector<viewer::RgbImage> draw_frames(const viewer::ViewedObject& subject,
                                                        const ViewOptions& options,
                                                        std::int64_t frames,
                                                        Progress& progress);

/// Draws frame_0000.png and so on, and NAME_view.toml, in the subject's folder, which is created.
/// @throws Error  also CannotWrite
FramesReport draw_frames_to_files(const viewer::ViewedObject& subject,
                                  const ViewOptions& options,
                                  const FramesOptions& frames,
                                  Progress& progress);

/// Creates a folder and its parents.
/// @throws Error  CannotWrite
void make_folder(const std::string& folder);

} // namespace heddle::job
