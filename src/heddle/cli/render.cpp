#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/io/file/input_file.h>
#include <heddle/stage/render_job.h>
#include <heddle/stage/scene_hash.h>

#include <filesystem>
#include <limits>

namespace heddle::cli {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Scene asked_scene(const Arguments& arguments) {
    const std::string& path = arguments.text("FILE");
    Scene scene;
    if (suffix_of(path) == ".vdb") {
        SceneObject object;
        object.name = std::filesystem::path(path).stem().string();
        object.volume = path;
        object.instances.resize(1);
        scene.objects.push_back(object);
        if (arguments.given("geometry")) {
            throw UsageError(
                "--geometry cannot be used with a .vdb, which holds only voxels; name the geometry in a scene");
        }
    } else {
        scene = read_scene(path);
    }
    if (arguments.given("size")) {
        const std::vector<double> size = arguments.numbers("size", 'x');
        if (size[0] * size[1] > 0x1p28) { // as a scene's
            throw UsageError("--size: the picture has more than 2^28 pixels; make it smaller");
        }
        scene.width = static_cast<std::int32_t>(size[0]);
        scene.height = static_cast<std::int32_t>(size[1]);
    }
    if (arguments.given("samples")) scene.integrator.samples = arguments.integer("samples");
    if (arguments.given("level")) {
        scene.integrator.level = static_cast<int>(arguments.integer("level"));
    }
    if (arguments.given("seed")) {
        scene.integrator.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    }
    if (arguments.given("transport")) scene.integrator.transport = arguments.text("transport");
    return scene;
}

void run_render(const Arguments& arguments, Report& report, ProgressBar& bar) {
    Scene scene = asked_scene(arguments);
    RenderJob job;
    job.output = arguments.text("output");
    const std::string suffix = suffix_of(job.output);
    if (suffix != ".exr" && suffix != ".png") {
        throw UsageError(str("--output: '", job.output, "' must end in .exr or .png"));
    }
    check_output(job.output, suffix);
    job.samples = scene.integrator.samples;
    job.seconds = arguments.given("time") ? arguments.number("time") : 0.0;
    job.noise = arguments.given("noise") ? arguments.number("noise") : 0.0;
    if ((job.seconds > 0.0 || job.noise > 0.0) && !arguments.given("samples")) {
        job.samples = std::numeric_limits<std::int32_t>::max();
    }
    job.exposure = arguments.number("exposure");
    job.resume = arguments.given("resume");
    job.command = arguments.command_line;

    PathOptions options;
    options.max_depth = scene.integrator.max_depth;
    options.roulette_depth = scene.integrator.roulette_depth;
    options.level = scene.integrator.level;
    options.level_offset = static_cast<float>(arguments.number("level-offset"));
    options.transport = transport_from(scene.integrator.transport);

    job.scene_hash = hash_of_scene(scene, options, arguments.given("geometry"));

    bar.begin("read", "files", 1);
    const StageOptions stage_options{.geometry = arguments.given("geometry"),
                                     .level_offset = options.level_offset,
                                     .flakes = options.transport == Transport::Flakes};
    Stage stage(scene, stage_options, bar);
    const RenderOutcome outcome =
        render_to_file(stage, options, scene.integrator.seed, scene.width, scene.height, job, bar);
    bar.finish();
    report.text("output", job.output);
    report.add("size", "size", {scene.width, scene.height},
               str(scene.width, " x ", scene.height, " pixels"));
    report.count("samples", outcome.samples, "per pixel");
    if (job.resume) report.count("resumed from", outcome.resumed_from, "samples per pixel");
    report.number("noise", outcome.noise, "RMS standard error of the luminance");
    const double paths =
        static_cast<double>(outcome.samples - outcome.resumed_from) * scene.width * scene.height;
    report.seconds("first picture", outcome.first_picture_seconds);
    report.add("levels_seconds", "reading levels", outcome.load_seconds,
               show_seconds(outcome.load_seconds));
    report.seconds("render", outcome.render_seconds);
    if (outcome.render_seconds > 0.0) {
        report.number("rate", paths / outcome.render_seconds, "paths/s");
    }
    report.bytes("scene memory", stage.byte_count());
    report.bytes("peak memory", peak_resident_bytes());
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
                     "How the opacities of voxels along a ray combine; auto: footprint for fibers whose volume stores footprints, else product."},
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
