#include <heddle/base/error.h>
#include <heddle/base/format_number.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/job/render/render_scene.h>

#include <limits>

namespace heddle::cli {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

job::RenderOptions render_options_from(const Arguments& arguments) {
    job::RenderOptions options;
    options.geometry = arguments.given("geometry");
    if (arguments.given("level")) options.level = static_cast<int>(arguments.integer("level"));
    options.level_offset = arguments.number("level-offset");
    options.transport = arguments.find_text("transport");
    options.samples = arguments.find_integer("samples");
    options.time = arguments.find_number("time");
    options.noise = arguments.find_number("noise");
    if (arguments.given("size")) {
        const std::vector<double> size = arguments.numbers("size", 'x');
        options.size = job::PictureSize{static_cast<std::int32_t>(size[0]),
                                        static_cast<std::int32_t>(size[1])};
    }
    if (arguments.given("seed")) {
        options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    }
    options.exposure = arguments.number("exposure");
    options.resume = arguments.given("resume");
    options.command = arguments.command_line;
    return options;
}

void run_render(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string& output = arguments.text("output");
    const job::RenderOptions options = render_options_from(arguments);
    const job::RenderReport done =
        job::render_scene_to_file(arguments.text("FILE"), output, options, bar);
    report.text("output", output);
    report.add("size", "size", {done.size.width, done.size.height},
               str(done.size.width, " x ", done.size.height, " pixels"));
    report.count("samples", done.samples, "per pixel");
    if (options.resume) report.count("resumed from", done.resumed_from, "samples per pixel");
    report.number("noise", done.noise, "RMS standard error of the luminance");
    report.seconds("first picture", done.first_picture_seconds);
    report.add("levels_seconds", "reading levels", done.load_seconds,
               format_seconds(done.load_seconds));
    report.seconds("render", done.render_seconds);
    if (done.paths_per_second) report.number("rate", *done.paths_per_second, "paths/s");
    report.bytes("scene memory", done.scene_bytes);
    report.bytes("peak memory", done.peak_bytes);
}

} // namespace

Command render_command() {
    return {
        "render", "Path traces a scene file or a .vdb.",
        joined({
            grouped(
                "Input and output",
                {
                    {"FILE", "", "", any_text(), "",
                     "A .toml scene, or a .vdb, for which a camera and lights are chosen.", true},
                    {"-o, --output", "OUT.exr|OUT.png", "", any_text(), "", "Output picture.",
                     true},
                    {"--resume", "", "", flag(), "",
                     "Continues from OUTPUT.checkpoint, which a stopped render leaves behind."},
                }),
            grouped("Picture",
                    {
                        {"--size", "WxH", "(from the scene, or 512x512)",
                         numbers(2, 2, 1, 65536, 'x'), "pixels", "Size of the picture."},
                        {"--exposure", "E", "0", number(-kInf, kInf), "stops",
                         "Exposure of a .png: colours are multiplied by 2^E."},
                    }),
            grouped(
                "When to stop",
                {
                    {"--samples", "N", "(from the scene, or 64; no limit with --time or --noise)",
                     integer(1, 1'000'000'000), "per pixel", "Stops after this many samples."},
                    {"--time", "T", "(no limit)", positive(), "seconds",
                     "Stops at about this time, reading the scene included; at least one sample is taken."},
                    {"--noise", "E", "(no limit)", positive(), "luminance",
                     "Stops when the root mean square over pixels of the standard error of the luminance is below E."},
                }),
            grouped(
                "Volumes",
                {
                    {"--transport", "MODEL", "(from the scene, or auto)", one_of(transport_names()),
                     "",
                     "How the opacities of voxels along a ray combine; auto: sheet for surfaces whose volume stores slabs, cells for fibers whose volume stores occupancy bits, else product."},
                    {"--level", "N", "(from the footprint of each ray)", integer(0, 1000), "",
                     "Uses one level of detail for all rays; 0 = the finest."},
                    {"--level-offset", "X", "0", number(-8, 8), "levels",
                     "Is added to the level chosen from the ray's footprint; negative values are finer."},
                    {"--geometry", "", "", flag(), "",
                     "Traces the geometry of objects that have one, instead of their volumes."},
                }),
        }),
        run_render};
}

} // namespace heddle::cli
