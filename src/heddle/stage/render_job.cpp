#include <heddle/stage/render_job.h>

#include <heddle/base/error.h>
#include <heddle/io/exr/exr.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/image/image.h>
#include <heddle/render/render.h>
#include <heddle/stage/checkpoint.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

namespace heddle {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr double kSaveEvery = 20.0; // seconds between two writes of the unfinished picture

/// The progress of a job.
struct JobProgress {
    std::uint32_t samples = 0; ///< per pixel
    std::uint32_t resumed = 0; ///< how many of these came from a checkpoint
    double spent = 0.0;        ///< seconds, of the whole job
    double each = 0.0;         ///< seconds per sample; 0: not known yet
};

/// Returns the samples per pixel after the next pass: twice as many, but no more than fit into the
/// time until the next save or the end, or than the noise limit is expected to need.
std::uint32_t next_target(const JobProgress& at, const Picture& picture, const RenderJob& job) {
    const double samples = at.samples;
    double more = std::max(1.0, samples - at.resumed);
    double room = kSaveEvery;
    if (job.seconds > 0.0) room = std::min(room, job.seconds - at.spent);
    if (at.each > 0.0) more = std::min(more, room / at.each);
    if (job.noise > 0.0 && at.samples >= 4) {
        const double times = picture.noise() / job.noise;
        more = std::min(more, std::ceil(samples * (times * times - 1.0)));
    }
    return static_cast<std::uint32_t>(
        std::min(samples + std::max(1.0, more), static_cast<double>(job.samples)));
}

bool is_done(const JobProgress& at, const Picture& picture, const RenderJob& job) {
    if (at.samples >= job.samples) return true;
    // rounds to the nearest number of samples
    if (job.seconds > 0.0 && at.samples > 0 && at.spent + 0.5 * at.each >= job.seconds) return true;
    return job.noise > 0.0 && at.samples >= 4 && picture.noise() <= job.noise;
}

/// The arguments of all passes of a job.
struct Passes {
    Stage& stage;
    const PathOptions& options;
    std::uint64_t seed;
    Progress& progress;
};

/// Adds samples [from, until) to every pixel.
void add_pass(const Passes& with, std::uint32_t from, std::uint32_t until, Picture& into) {
    const auto pixels = static_cast<std::int64_t>(into.pixels.size());
    with.progress.begin("render", "paths", pixels * (until - from));
    render_pass(with.stage.scene(), with.stage.camera(), with.options, with.seed, until, into,
                with.progress);
}

/// Reads the missing levels, then adds passes until the job is done.
/// @param save  writes the unfinished picture; called from time to time and on cancellation
void render_passes(const Passes& with,
                   const RenderJob& job,
                   Clock::time_point start,
                   const std::function<void()>& save,
                   Picture& picture,
                   RenderOutcome& outcome) {
    with.progress.begin("read levels", "levels", 1);
    while (with.stage.load_next_level()) with.progress.check();
    outcome.load_seconds = since(start) - outcome.first_picture_seconds;
    JobProgress at;
    at.samples = at.resumed = static_cast<std::uint32_t>(outcome.resumed_from);
    Clock::time_point saved = Clock::now();
    for (at.spent = since(start); !is_done(at, picture, job); at.spent = since(start)) {
        const std::uint32_t until = next_target(at, picture, job);
        const Clock::time_point began = Clock::now();
        try {
            add_pass(with, at.samples, until, picture);
        } catch (const Error& e) {
            if (e.code() == ErrorCode::Cancelled && at.samples > 0) save();
            throw;
        }
        outcome.render_seconds += since(began);
        at.samples = until;
        at.each = outcome.render_seconds / (at.samples - at.resumed);
        if (since(saved) > kSaveEvery && at.samples < job.samples) {
            save();
            saved = Clock::now();
        }
    }
    outcome.samples = at.samples;
    outcome.noise = picture.noise();
}

bool is_half(const std::string& channel) {
    return channel != "depth" && channel != "samples" && channel != "variance" &&
           channel != "material";
}

} // namespace

void write_picture(const Picture& picture, const RenderJob& job) {
    if (suffix_of(job.output) == ".png") {
        write_png(job.output, picture.width, picture.height, 4, to_srgb8(picture, job.exposure));
        return;
    }
    const std::vector<PictureChannel> channels = channels_of(picture, job.all_channels);
    std::vector<ExrChannel> written;
    for (const PictureChannel& c : channels) written.push_back({c.name, c.values, is_half(c.name)});
    write_exr(job.output, picture.width, picture.height, written, {{"command", job.command}});
}

RenderOutcome render_to_file(Stage& stage,
                             const PathOptions& options,
                             std::uint64_t seed,
                             std::int32_t width,
                             std::int32_t height,
                             const RenderJob& job,
                             Progress& progress) {
    const Clock::time_point start = Clock::now();
    const std::string checkpoint = job.output + ".checkpoint";
    RenderOutcome outcome;
    Picture picture(width, height);
    if (job.resume) {
        picture = read_checkpoint(checkpoint, job.scene_hash, width, height);
        outcome.resumed_from = picture.pixels.empty() ? 0 : picture.pixels.front().samples;
    }
    if (outcome.resumed_from == 0) {
        Picture coarse(width, height);
        add_pass({stage, options, seed, progress}, 0, 1, coarse);
        write_picture(coarse, job);
    }
    outcome.first_picture_seconds = since(start);
    const auto save = [&] {
        write_picture(picture, job);
        write_checkpoint(checkpoint, job.scene_hash, picture);
    };
    render_passes({stage, options, seed, progress}, job, start, save, picture, outcome);
    write_picture(picture, job);
    std::error_code ignored;
    std::filesystem::remove(checkpoint, ignored);
    return outcome;
}

RenderOutcome render_in_memory(Stage& stage,
                               const PathOptions& options,
                               std::uint64_t seed,
                               const RenderJob& job,
                               Picture& picture,
                               Progress& progress) {
    RenderOutcome outcome;
    render_passes(
        {stage, options, seed, progress}, job, Clock::now(), [] {}, picture, outcome);
    return outcome;
}

} // namespace heddle
