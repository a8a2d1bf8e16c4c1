#include <heddle/stage/render_job.h>

#include <heddle/base/error.h>
#include <heddle/io/exr/exr.h>
#include <heddle/io/image/image.h>
#include <heddle/io/input_file.h>
#include <heddle/render/render.h>
#include <heddle/stage/checkpoint.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>

namespace heddle {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr double kSaveEvery = 20.0; // seconds between pictures written on the way

/// Samples per pixel that the picture should have after the next pass.
std::uint32_t
next_target(std::uint32_t done, const RenderJob& job, double spent, double in_passes) {
    std::uint64_t target = std::max<std::uint64_t>(1, std::uint64_t{2} * done);
    target = std::min(target, static_cast<std::uint64_t>(job.samples));
    if (done == 0) return static_cast<std::uint32_t>(target);
    const double each = in_passes / done;
    double room = kSaveEvery;
    if (job.seconds > 0.0) room = std::min(room, job.seconds - spent);
    const double fit = std::max(1.0, room / std::max(each, 1e-9));
    if (fit < static_cast<double>(target - done)) {
        target = done + static_cast<std::uint64_t>(fit);
    }
    return static_cast<std::uint32_t>(target);
}

bool is_done(const Picture& picture, std::uint32_t samples, const RenderJob& job, double spent) {
    if (samples >= job.samples) return true;
    if (job.seconds > 0.0 && samples > 0 && spent >= job.seconds) return true;
    return job.noise > 0.0 && samples >= 4 && picture.noise() <= job.noise;
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
    auto samples = static_cast<std::uint32_t>(outcome.resumed_from);
    const auto pass = [&](Picture& into, std::uint32_t from, std::uint32_t until) {
        const auto pixels = static_cast<std::int64_t>(into.pixels.size());
        progress.begin("render", "paths", pixels * (until - from));
        render_pass(stage.scene(), stage.camera(), options, seed, until, into, progress);
    };
    if (samples == 0) {
        Picture coarse(width, height);
        pass(coarse, 0, 1);
        write_picture(coarse, job);
    }
    outcome.first_picture_seconds = since(start);
    progress.begin("read levels", "levels", 1);
    while (stage.load_next_level()) progress.check();
    outcome.load_seconds = since(start) - outcome.first_picture_seconds;

    Clock::time_point saved = Clock::now();
    while (!is_done(picture, samples, job, since(start))) {
        const std::uint32_t target =
            next_target(samples - static_cast<std::uint32_t>(outcome.resumed_from), job,
                        since(start), outcome.render_seconds) +
            static_cast<std::uint32_t>(outcome.resumed_from);
        const std::uint32_t until = std::min(target, static_cast<std::uint32_t>(job.samples));
        const Clock::time_point began = Clock::now();
        try {
            pass(picture, samples, until);
        } catch (const Error& e) {
            if (e.code() == ErrorCode::Cancelled && samples > 0) {
                write_picture(picture, job);
                write_checkpoint(checkpoint, job.scene_hash, picture);
            }
            throw;
        }
        outcome.render_seconds += since(began);
        samples = until;
        if (since(saved) > kSaveEvery && samples < job.samples) {
            write_picture(picture, job);
            write_checkpoint(checkpoint, job.scene_hash, picture);
            saved = Clock::now();
        }
    }
    write_picture(picture, job);
    std::error_code ignored;
    std::filesystem::remove(checkpoint, ignored);
    outcome.samples = samples;
    outcome.noise = picture.noise();
    return outcome;
}

} // namespace heddle
