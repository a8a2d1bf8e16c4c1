#include <heddle/base/error.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/cli/view_options.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/image/image.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/opengl/context.h>
#include <heddle/viewer/orbit.h>
#include <heddle/viewer/slice/slice_view.h>
#include <heddle/window/window.h>
#include <heddle/yarn/slice_image.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>
#include <utility>

namespace heddle::cli {
namespace {

std::string frame_path(const std::string& folder, std::int64_t frame) {
    std::ostringstream name;
    name << "frame_" << std::setw(4) << std::setfill('0') << frame << ".png";
    return (std::filesystem::path(folder) / name.str()).string();
}

void make_folder(const std::string& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (!std::filesystem::is_directory(folder, failed)) {
        throw Error(ErrorCode::CannotWrite, "cannot create this folder", "write to another place",
                    {.path = folder});
    }
}

/// The scene stands in the pictures' folder, and names the volume from there.
void write_scene(const viewer::Session& session, const Arguments& arguments) {
    const std::string volume =
        arguments.given("volume") ? arguments.text("volume") : arguments.text("FILE");
    const std::filesystem::path folder(session.subject().folder);
    const std::string named = std::filesystem::proximate(volume, folder).string();
    write_output([&] {
        OutputFile file((folder / (session.subject().name + "_view.toml")).string());
        const std::string text = session.scene(named);
        file.write(text.data(), text.size());
        file.commit();
    });
}

void draw_frames(const viewer::Subject& subject,
                 const viewer::Settings& settings,
                 const Arguments& arguments,
                 Report& report,
                 ProgressBar& bar) {
    const std::vector<double> size = arguments.numbers("size", 'x');
    bar.begin("place slices", "files", 1);
    const opengl::Context context;
    viewer::Session session(context, subject, settings, static_cast<std::int32_t>(size[0]),
                            static_cast<std::int32_t>(size[1]));
    const std::int64_t frames = arguments.integer("frames");
    viewer::Settings now = session.settings();
    viewer::SliceTimes sum;
    bar.begin("draw", "frames", frames);
    for (std::int64_t f = 0; f < frames; ++f) {
        bar.check();
        viewer::SliceTimes times;
        const viewer::ViewImage image = session.draw_now(&times);
        if (f == 0 && arguments.given("scene")) write_scene(session, arguments);
        write_output([&] {
            write_png(frame_path(subject.folder, f), image.width, image.height, 3, image.rgb);
        });
        now.orbit.turn(-2.0 * std::numbers::pi / static_cast<double>(frames), 0.0);
        session.set(now);
        sum.sort += times.sort;
        sum.shadow += times.shadow;
        sum.draw += times.draw;
        bar.advance(1);
    }
    const auto each = 1.0 / static_cast<double>(frames);
    report.text("output", subject.folder);
    report.text("driver", context.driver());
    report.count("slices", session.slice_count());
    report.text("blend", session.blend());
    for (const auto& [stage, seconds] :
         {std::pair{"sort", sum.sort}, std::pair{"shadow", sum.shadow},
          std::pair{"draw", sum.draw}}) {
        report.add(str(stage, "_a_frame_seconds"), str(stage, " per frame"), seconds * each,
                   show_seconds(seconds * each));
    }
}

void open_window(const viewer::Subject& subject,
                 const viewer::Settings& settings,
                 const Arguments& arguments,
                 Report& report,
                 ProgressBar& bar) {
    const std::vector<double> size = arguments.numbers("size", 'x');
    bar.finish(); // its line would stay over the window's life
    const window::WindowCounts counts = window::run_window(
        subject, settings,
        {.width = static_cast<std::int32_t>(size[0]), .height = static_cast<std::int32_t>(size[1])},
        bar);
    bar.check();
    report.text("driver", counts.driver);
    report.count("inputs shown", counts.inputs);
    report.add("median_answer", "median response", counts.median_ms, str(counts.median_ms, " ms"));
    report.add("slowest_answer", "slowest response", counts.worst_ms, str(counts.worst_ms, " ms"));
}

void load_curves(viewer::Subject& subject, const Arguments& arguments, Report& report) {
    Geometry geometry = load_geometry(arguments.text("FILE"), arguments);
    apply_model(geometry, arguments);
    for (std::string& note : make_slices_of_yarns(geometry, subject.seed)) {
        geometry.notes.push_back(std::move(note));
    }
    for (const std::string& note : geometry.notes) report.note(note);
    subject.geometry = std::move(geometry);
}

viewer::Subject subject_of(const Arguments& arguments, Report& report) {
    const std::filesystem::path file(arguments.text("FILE"));
    viewer::Subject out;
    out.name = file.stem().string();
    out.folder = arguments.given("output") ? arguments.text("output") : ".";
    out.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    if (arguments.given("memory")) out.memory_bytes = arguments.bytes("memory");
    std::string volume = arguments.given("volume") ? arguments.text("volume") : "";
    if (is_volume_file(arguments)) {
        volume = file.string();
    } else {
        load_curves(out, arguments, report);
    }
    if (!volume.empty()) out.levels = std::make_shared<VoxelLevels>(read_levels(volume));
    return out;
}

void run_view(const Arguments& arguments, Report& report, ProgressBar& bar) {
    check_view(arguments);
    bar.begin("read", "files", 1);
    const viewer::Subject subject = subject_of(arguments, report);
    make_folder(subject.folder);
    const viewer::Settings settings = view_settings(arguments, subject);
    if (arguments.given("headless"))
        draw_frames(subject, settings, arguments, report, bar);
    else
        open_window(subject, settings, arguments, report, bar);
    bar.finish();
    for (const auto& [stage, seconds] : bar.stages()) report.seconds(stage, seconds);
}

} // namespace

Command view_command() {
    return {"view",
            "Shows yarns as shaded slices, and volumes, in an OpenGL window or as pictures.",
            view_options(), run_view};
}

} // namespace heddle::cli
