#pragma once

#include <heddle/base/progress.h>
#include <heddle/render/picture.h>
#include <heddle/stage/stage.h>

#include <cstdint>
#include <string>

namespace heddle {

/// When a picture is finished, and where it goes.
struct RenderJob {
    std::string output;           ///< .exr or .png
    std::int64_t samples = 64;    ///< per pixel: stops there
    double seconds = 0.0;         ///< 0: no limit; of the whole job, kept to half a sample
    double noise = 0.0;           ///< 0: no limit; Picture::noise
    double exposure = 0.0;        ///< stops, of a .png
    bool all_channels = true;     ///< of an .exr
    bool resume = false;          ///< go on from OUTPUT.checkpoint
    std::uint64_t scene_hash = 0; ///< a checkpoint of another one is refused
    std::string command;          ///< goes into the picture
};

/// What a job did.
struct RenderOutcome {
    std::int64_t samples = 0;      ///< per pixel
    std::int64_t resumed_from = 0; ///< samples that the checkpoint held
    double noise = 0.0;
    double first_picture_seconds = 0.0; ///< until a coarse picture stood in `output`
    double render_seconds = 0.0;        ///< in passes
    double load_seconds = 0.0;          ///< in levels read after the first picture
};

/// Renders in passes of twice as many samples each time, writes the picture now and then and a
/// checkpoint beside it, which goes when the picture is done.
///
/// A coarse picture comes first, from the levels that are there already; its samples do not count.
/// @throws Error  Cancelled: the picture so far and its checkpoint stay; NotFound: nothing to
///                resume; BadFile: a checkpoint that is damaged or of another scene; CannotWrite
RenderOutcome render_to_file(Stage& stage,
                             const PathOptions& options,
                             std::uint64_t seed,
                             std::int32_t width,
                             std::int32_t height,
                             const RenderJob& job,
                             Progress& progress);

/// The same passes without a file: no coarse picture, no checkpoint.
/// @param job      its output, exposure and resume are not looked at
/// @param picture  without a sample; holds whole passes alone where this throws
/// @throws Error   Cancelled
RenderOutcome render_in_memory(Stage& stage,
                               const PathOptions& options,
                               std::uint64_t seed,
                               const RenderJob& job,
                               Picture& picture,
                               Progress& progress);

/// Writes a picture as .exr (half floats but for depth, samples and variance) or .png.
void write_picture(const Picture& picture, const RenderJob& job);

} // namespace heddle
