#include <heddle/cli/voxelize_frames.h>

#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/cli/frames.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/cli/voxelize_file.h>
#include <heddle/cli/voxelize_raster.h>
#include <heddle/cli/voxelize_vol.h>

#include <algorithm>
#include <vector>

namespace heddle::cli {
namespace {

/// The Error of a frame, its file first.
[[noreturn]] void fail_in(const Frame& frame, const Error& error) {
    std::string text = error.what();
    if (text.rfind(frame.input + ": ", 0) == 0) text.erase(0, frame.input.size() + 2);
    throw Error(error.code(), str("frame ", frame.number, ": ", text), {}, {.path = frame.input});
}

/// Sums over frames, and a row for each.
struct FrameTable {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    std::vector<std::vector<std::string>> rows;
    VoxelizedFile sum; ///< of peaks: the largest

    void add(const Frame& frame, const VoxelizedFile& file, const Report& part) {
        nlohmann::ordered_json value{{"frame", frame.number}, {"file", frame.input}};
        value.update(part.values());
        values.push_back(std::move(value));
        rows.push_back({std::to_string(frame.number), frame.output,
                        show_count(static_cast<double>(file.voxels)),
                        show_bytes(static_cast<double>(file.bytes)), show_seconds(file.seconds)});
        sum.voxels += file.voxels;
        sum.bytes += file.bytes;
        sum.seconds += file.seconds;
        sum.peak_bytes = std::max(sum.peak_bytes, file.peak_bytes);
    }

    void print(Report& report, bool predicted) const {
        report.table("frames", values, {"frame", "output", "voxels", "file size", "time"}, rows);
        const std::string before = predicted ? "predicted " : "";
        report.count(before + "voxels", sum.voxels);
        report.bytes(before + "file size", sum.bytes);
        report.seconds(predicted ? "predicted time" : "total", sum.seconds);
        report.bytes(before + "peak memory", predicted ? sum.peak_bytes : peak_resident_bytes());
    }
};

} // namespace

void voxelize_frames(const Arguments& arguments, Report& report, ProgressBar& bar) {
    if (is_volume(arguments)) {
        throw UsageError("--frames cannot be used with a .vol; it needs curves or meshes");
    }
    refuse_volume_options(arguments);
    const std::vector<Frame> frames = frames_from(arguments);
    const bool dry_run = arguments.given("dry-run");
    if (!dry_run) {
        for (const Frame& frame : frames) check_output(frame.output, ".vdb");
    }
    raster::SliceVoxelizer drawer(raster_options_from(arguments));
    FrameTable table;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const Frame& frame = frames[k];
        bar.begin_part(str("frame ", k + 1, " of ", frames.size()));
        Report part = report.part();
        try {
            const VoxelizedFile file =
                voxelize_file(arguments, frame.input, frame.output, drawer, part, bar);
            table.add(frame, file, part);
        } catch (const Error& e) {
            fail_in(frame, e);
        }
    }
    table.print(report, dry_run);
}

} // namespace heddle::cli
