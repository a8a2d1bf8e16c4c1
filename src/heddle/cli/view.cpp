#include <heddle/base/error.h>
#include <heddle/base/format_number.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/view_rows.h>
#include <heddle/job/view/view_frames.h>
#include <heddle/window/window.h>

#include <utility>

namespace heddle::cli {
namespace {

void check_headless(const Arguments& arguments) {
    const bool headless = arguments.given("headless");
    if (headless && !arguments.given("output")) {
        throw UsageError("--headless needs a folder for the pictures; give -o DIR");
    }
    for (const char* option : {"frames", "scene"}) {
        if (headless || !arguments.given(option)) continue;
        throw UsageError(str("--", option, " needs --headless"));
    }
}

void draw_frames(const job::LoadedView& view,
                 const job::ViewOptions& options,
                 const Arguments& arguments,
                 Report& report,
                 ProgressBar& bar) {
    job::FramesOptions frames{.frames = arguments.integer("frames"), .scene = {}};
    if (arguments.given("scene")) frames.scene = view.volume;
    const job::FramesReport done = job::draw_frames_to_files(view.subject, options, frames, bar);
    report.text("output", view.subject.folder);
    report.text("driver", done.driver);
    report.count("slices", done.slices);
    report.text("blend", done.blend);
    for (const auto& [phase, seconds] :
         {std::pair{"sort", done.a_frame.sort}, std::pair{"shadow", done.a_frame.shadow},
          std::pair{"draw", done.a_frame.draw}}) {
        report.add(str(phase, "_a_frame_seconds"), str(phase, " per frame"), seconds,
                   format_seconds(seconds));
    }
    report_phases(report, view.phases);
    report_phases(report, done.phases);
}

void open_window(const job::LoadedView& view,
                 const job::ViewOptions& options,
                 Report& report,
                 ProgressBar& bar) {
    job::make_folder(view.subject.folder);
    bar.finish(); // its line would stay over the window's life
    const window::WindowCounts counts =
        window::run_window(view.subject, job::view_settings(options, view.subject),
                           {.width = options.width, .height = options.height}, bar);
    bar.check();
    report.text("driver", counts.driver);
    report.count("inputs shown", counts.inputs);
    report.add("median_answer", "median response", counts.median_ms, str(counts.median_ms, " ms"));
    report.add("slowest_answer", "slowest response", counts.worst_ms, str(counts.worst_ms, " ms"));
    report_phases(report, view.phases);
}

void run_view(const Arguments& arguments, Report& report, ProgressBar& bar) {
    check_headless(arguments);
    const job::ViewInput input = view_input_from(arguments);
    const job::ViewOptions options = view_options_from(arguments);
    job::check_view(input, options, arguments.given("scene"));
    const job::LoadedView view = job::load_view(input, options, bar);
    report_notes(report, view.notes);
    if (arguments.given("headless"))
        draw_frames(view, options, arguments, report, bar);
    else
        open_window(view, options, report, bar);
}

} // namespace

Command view_command() {
    return {"view",
            "Shows yarns as shaded slices, and volumes, in an OpenGL window or as pictures.",
            view_rows(), run_view};
}

} // namespace heddle::cli
