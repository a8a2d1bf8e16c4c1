#include <heddle/job/render/render_scene.h>

#include <heddle/base/memory.h>
#include <heddle/io/file/input_file.h>
#include <heddle/job/option_error.h>
#include <heddle/job/write_output.h>
#include <heddle/stage/render_job.h>
#include <heddle/stage/scene_hash.h>

#include <filesystem>
#include <limits>

namespace heddle::job {
namespace {

/// Returns the scene with its settings replaced by those that the options give.
Scene with_options(Scene scene, const RenderOptions& options) {
    if (options.size) {
        const double width = options.size->width, height = options.size->height;
        if (!(width >= 1.0 && height >= 1.0)) {
            throw OptionError(
                str("`size` is ", width, " x ", height, "; it must be 1 x 1 or more"));
        }
        if (width * height > 0x1p28) { // the limit of a scene file
            throw OptionError("`size`: the picture has more than 2^28 pixels; make it smaller");
        }
        scene.width = options.size->width;
        scene.height = options.size->height;
    }
    if (options.samples) {
        if (*options.samples < 1) throw OptionError("`samples` must be 1 or more");
        scene.integrator.samples = *options.samples;
    }
    if (options.level) scene.integrator.level = *options.level;
    if (options.seed) scene.integrator.seed = *options.seed;
    if (options.transport) scene.integrator.transport = *options.transport;
    return scene;
}

PathOptions path_options(const Scene& scene, const RenderOptions& options) {
    PathOptions out;
    out.max_depth = scene.integrator.max_depth;
    out.roulette_depth = scene.integrator.roulette_depth;
    out.level = scene.integrator.level;
    out.level_offset = static_cast<float>(options.level_offset);
    out.transport = transport_from(scene.integrator.transport);
    return out;
}

RenderJob job_of(const Scene& scene, const RenderOptions& options) {
    RenderJob job;
    job.samples = scene.integrator.samples;
    job.seconds = options.time.value_or(0.0);
    job.noise = options.noise.value_or(0.0);
    if ((job.seconds > 0.0 || job.noise > 0.0) && !options.samples) {
        job.samples = std::numeric_limits<std::int32_t>::max();
    }
    job.exposure = options.exposure;
    job.resume = options.resume;
    job.command = options.command;
    return job;
}

StageOptions stage_options(const PathOptions& paths, const RenderOptions& options) {
    return {.geometry = options.geometry,
            .level_offset = paths.level_offset,
            .flakes = paths.transport == Transport::Flakes};
}

RenderReport report_of(const RenderOutcome& outcome, const Scene& scene, const Stage& stage) {
    RenderReport report;
    report.size = {scene.width, scene.height};
    report.samples = outcome.samples;
    report.resumed_from = outcome.resumed_from;
    report.noise = outcome.noise;
    report.first_picture_seconds = outcome.first_picture_seconds;
    report.load_seconds = outcome.load_seconds;
    report.render_seconds = outcome.render_seconds;
    const double paths =
        static_cast<double>(outcome.samples - outcome.resumed_from) * scene.width * scene.height;
    if (outcome.render_seconds > 0.0) report.paths_per_second = paths / outcome.render_seconds;
    report.scene_bytes = stage.byte_count();
    report.peak_bytes = peak_resident_bytes();
    return report;
}

} // namespace

Scene load_scene(const std::string& path, const RenderOptions& options) {
    if (suffix_of(path) != ".vdb") return read_scene(path);
    if (options.geometry) {
        throw OptionError(
            "`geometry` cannot be used with a .vdb, which holds only voxels; name the geometry in a scene");
    }
    Scene scene;
    SceneObject object;
    object.name = std::filesystem::path(path).stem().string();
    object.volume = path;
    object.instances.resize(1);
    scene.objects.push_back(object);
    return scene;
}

RenderResult render_scene(const Scene& scene, const RenderOptions& options, Progress& progress) {
    if (options.resume) throw OptionError("`resume` needs an output");
    const Scene asked = with_options(scene, options);
    const PathOptions paths = path_options(asked, options);
    progress.check();
    progress.begin("read", "files", 1);
    Stage stage(asked, stage_options(paths, options), progress);
    RenderResult result{Picture(asked.width, asked.height), {}};
    const RenderOutcome outcome = render_in_memory(
        stage, paths, asked.integrator.seed, job_of(asked, options), result.picture, progress);
    result.report = report_of(outcome, asked, stage);
    return result;
}

RenderReport render_scene_to_file(const Scene& scene,
                                  const std::string& output,
                                  const RenderOptions& options,
                                  Progress& progress) {
    const Scene asked = with_options(scene, options);
    RenderJob job = job_of(asked, options);
    job.output = output;
    const std::string suffix = suffix_of(output);
    if (suffix != ".exr" && suffix != ".png") {
        throw OptionError(str("`output`: '", output, "' must end in .exr or .png"));
    }
    check_output(output, suffix);
    const PathOptions paths = path_options(asked, options);
    job.scene_hash = hash_of_scene(asked, paths, options.geometry);
    progress.check();
    progress.begin("read", "files", 1);
    Stage stage(asked, stage_options(paths, options), progress);
    const RenderOutcome outcome = render_to_file(stage, paths, asked.integrator.seed, asked.width,
                                                 asked.height, job, progress);
    return report_of(outcome, asked, stage);
}

RenderReport render_scene_to_file(const std::string& path,
                                  const std::string& output,
                                  const RenderOptions& options,
                                  Progress& progress) {
    return render_scene_to_file(load_scene(path, options), output, options, progress);
}

} // namespace heddle::job
