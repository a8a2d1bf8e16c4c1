#pragma once

#include <heddle/base/progress.h>
#include <heddle/render/picture.h>
#include <heddle/stage/stage.h>

#include <cstdint>
#include <string>

namespace heddle {

/// When a picture is finished, and where it is written.
struct RenderJob {
    std::string output;           ///< .exr or .png
    std::int64_t samples = 64;    ///< per pixel
    double seconds = 0.0;         ///< limit for the whole job, within half a sample; 0: none
    double noise = 0.0;           ///< stops below this Picture::noise; 0: no limit
    double exposure = 0.0;        ///< of a .png, in stops (factors of two)
    bool all_channels = true;     ///< of an .exr
    bool resume = false;          ///< continues from OUTPUT.checkpoint
    std::uint64_t scene_hash = 0; ///< a checkpoint with another hash is refused
    std::string command;          ///< is stored in the picture
};

/// What a job did.
struct RenderOutcome {
    std::int64_t samples = 0;      ///< per pixel
    std::int64_t resumed_from = 0; ///< samples that the checkpoint held
    double noise = 0.0;
    double first_picture_seconds = 0.0; ///< until a coarse picture was in `output`
    double render_seconds = 0.0;        ///< spent in passes
    double load_seconds = 0.0;          ///< spent on levels that were read after the first picture
};

/// Renders in passes, each of which doubles the samples. From time to time writes the picture and a
/// checkpoint, which is removed when the picture is finished.
///
/// First writes a coarse picture of the levels that are already loaded; its samples are discarded.
/// @throws Error  Cancelled: the unfinished picture and its checkpoint remain; NotFound: there is
///                no checkpoint; BadFile: it is damaged or of another scene; CannotWrite
RenderOutcome render_to_file(Stage& stage,
                             const PathOptions& options,
                             std::uint64_t seed,
                             std::int32_t width,
                             std::int32_t height,
                             const RenderJob& job,
                             Progress& progress);

/// Renders the same passes without a file, a coarse picture or a checkpoint.
/// @param job      its output, exposure and resume are ignored
/// @param picture  without samples; after an exception, holds only complete passes
/// @throws Error   Cancelled
RenderOutcome render_in_memory(Stage& stage,
                               const PathOptions& options,
                               std::uint64_t seed,
                               const RenderJob& job,
                               Picture& picture,
                               Progress& progress);

/// Writes a picture as .exr (half floats; depth, samples and variance as floats) or .png.
void write_picture(const Picture& picture, const RenderJob& job);

} // namespace heddle
