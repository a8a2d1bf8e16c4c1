#include <heddle/job/view/view_frames.h>

#include <heddle/io/file/input_file.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/image/image.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/job/option_error.h>
#include <heddle/job/write_output.h>
#include <heddle/yarn/slice_image.h>

#include <filesystem>
#include <functional>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <utility>

namespace heddle::job {
namespace {

std::string frame_path(const std::string& folder, std::int64_t frame) {
    std::ostringstream name;
    name << "frame_" << std::setw(4) << std::setfill('0') << frame << ".png";
    return (std::filesystem::path(folder) / name.str()).string();
}

/// Writes a scene file into the folder of the pictures, with a path to the volume from there.
void write_scene(const viewer::Session& session, const std::string& volume) {
    const std::filesystem::path folder(session.subject().folder);
    const std::string named = std::filesystem::proximate(volume, folder).string();
    write_text((folder / (session.subject().name + "_view.toml")).string(), session.scene(named));
}

/// Receives a picture and the session that drew it.
using TakeFrame = std::function<void(
    std::int64_t frame, const viewer::RgbImage& image, const viewer::Session& session)>;

FramesReport draw(const viewer::ViewedObject& subject,
                  const ViewOptions& options,
                  std::int64_t frames,
                  const TakeFrame& take,
                  PhaseClock& clock) {
    if (frames < 1) throw OptionError(str("`frames` is ", frames, "; it must be 1 or more"));
    const viewer::Settings settings = view_settings(options, subject);
    clock.check();
    clock.begin("place slices", "files", 1);
    const opengl::Context context;
    viewer::Session session(context, subject, settings, options.width, options.height);
    viewer::Settings now = session.settings();
    FramesReport report;
    clock.begin("draw", "frames", frames);
    const auto each = 1.0 / static_cast<double>(frames);
    for (std::int64_t f = 0; f < frames; ++f) {
        clock.check();
        viewer::SliceTimes times;
        const viewer::RgbImage image = session.draw_now(&times);
        take(f, image, session);
        now.orbit.turn(-2.0 * std::numbers::pi * each, 0.0);
        session.set(now);
        report.a_frame.sort += times.sort * each;
        report.a_frame.shadow += times.shadow * each;
        report.a_frame.draw += times.draw * each;
        clock.advance(1);
    }
    clock.finish();
    report.driver = context.driver();
    report.slices = session.slice_count();
    report.blend = session.blend();
    report.phases = clock.phases();
    return report;
}

/// @return  what was assumed or left out
std::vector<std::string> load_curves(viewer::ViewedObject& subject, const ViewInput& input) {
    Geometry geometry = load_geometry({.path = input.path, .options = input.geometry});
    for (std::string& note : make_slices_of_yarns(geometry, subject.seed)) {
        geometry.notes.push_back(std::move(note));
    }
    std::vector<std::string> notes = geometry.notes;
    subject.geometry = std::move(geometry);
    return notes;
}

} // namespace

LoadedView load_view(const ViewInput& input, const ViewOptions& options, Progress& progress) {
    PhaseClock clock(progress);
    check_view(input, options, false);
    clock.begin("read", "files", 1);
    LoadedView out;
    out.subject.name = std::filesystem::path(input.path).stem().string();
    out.subject.folder = input.folder;
    out.subject.seed = input.seed;
    out.subject.memory_bytes = input.memory_bytes.value_or(0);
    std::optional<std::string> volume = input.volume;
    if (suffix_of(input.path) == ".vdb")
        volume = input.path;
    else
        take_notes(out.notes, load_curves(out.subject, input), clock);
    clock.check();
    out.volume = volume.value_or("");
    if (volume) out.subject.levels = std::make_shared<VoxelLevels>(read_levels(*volume));
    clock.check();
    clock.finish();
    out.phases = clock.phases();
    return out;
}

std::vector<viewer::RgbImage> draw_frames(const viewer::ViewedObject& subject,
                                          const ViewOptions& options,
                                          std::int64_t frames,
                                          Progress& progress) {
    PhaseClock clock(progress);
    std::vector<viewer::RgbImage> images;
    const TakeFrame take = [&](std::int64_t, const viewer::RgbImage& image, const auto&) {
        images.push_back(image);
    };
    (void)draw(subject, options, frames, take, clock);
    return images;
}

FramesReport draw_frames_to_files(const viewer::ViewedObject& subject,
                                  const ViewOptions& options,
                                  const FramesOptions& frames,
                                  Progress& progress) {
    PhaseClock clock(progress);
    make_folder(subject.folder);
    const TakeFrame take = [&](std::int64_t frame, const viewer::RgbImage& image,
                               const viewer::Session& session) {
        if (frame == 0 && frames.scene) write_scene(session, *frames.scene);
        write_output([&] {
            write_png(frame_path(subject.folder, frame), image.width, image.height, 3, image.rgb);
        });
    };
    return draw(subject, options, frames.frames, take, clock);
}

void make_folder(const std::string& folder) {
    heddle::make_folder(folder);
}

} // namespace heddle::job
