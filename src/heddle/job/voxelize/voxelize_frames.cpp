#include <heddle/job/voxelize/voxelize_frames.h>

#include <heddle/job/option_error.h>
#include <heddle/job/write_output.h>

#include <functional>
#include <utility>

namespace heddle::job {
namespace {

/// Throws the Error of a frame again, with the frame's number and file in front.
[[noreturn]] void fail_in(const AnimationFrame& frame, const Error& error) {
    std::string text = error.what();
    if (text.rfind(frame.input + ": ", 0) == 0) text.erase(0, frame.input.size() + 2);
    throw Error(error.code(), str("frame ", frame.number, ": ", text), {}, {.path = frame.input});
}

using RunFrame = std::function<VoxelizeReport(const AnimationFrame& frame, GeometryInput input)>;

std::vector<VoxelizeReport> run_frames(const std::vector<AnimationFrame>& frames,
                                       const GeometryOptions& geometry,
                                       Progress& progress,
                                       const RunFrame& run) {
    std::vector<VoxelizeReport> reports;
    for (const AnimationFrame& frame : frames) {
        progress.begin_part(str("frame ", reports.size() + 1, " of ", frames.size()));
        try {
            reports.push_back(run(frame, {.path = frame.input, .options = geometry}));
        } catch (const OptionError&) {
            throw; // does not depend on the frame
        } catch (const Error& e) {
            fail_in(frame, e);
        }
    }
    return reports;
}

} // namespace

std::vector<VoxelizeReport> voxelize_frames(const std::vector<AnimationFrame>& frames,
                                            const GeometryOptions& geometry,
                                            const VoxelizeJobOptions& options,
                                            Progress& progress) {
    for (const AnimationFrame& frame : frames) check_output(frame.output, ".vdb");
    Voxelizer voxelizer(options);
    return run_frames(
        frames, geometry, progress, [&](const AnimationFrame& frame, GeometryInput input) {
            return voxelizer.voxelize_to_file(std::move(input), frame.output, progress);
        });
}

std::vector<VoxelizeReport> plan_frames(const std::vector<AnimationFrame>& frames,
                                        const GeometryOptions& geometry,
                                        const VoxelizeJobOptions& options,
                                        Progress& progress) {
    Voxelizer voxelizer(options);
    return run_frames(frames, geometry, progress, [&](const AnimationFrame&, GeometryInput input) {
        return voxelizer.plan(std::move(input), progress);
    });
}

} // namespace heddle::job
