#include <heddle/cli/voxelize/report_voxelize.h>

#include <heddle/base/error.h>
#include <heddle/base/format_number.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/voxelize/voxelize_options.h>

#include <algorithm>

namespace heddle::cli {
namespace {

void report_counts(Report& report, const raster::RasterCounts& counts) {
    report.text("driver", counts.driver);
    report.text("raster path", path_names()[static_cast<std::size_t>(counts.path)]);
    report.count("slices", counts.slices);
    report.count("bricks", counts.bricks, "of 8^3 voxels, touched by slices");
    report.count("draw batches", counts.batches);
    const auto seconds = [&report](const char* key, const char* label, double value) {
        report.add(key, label, value, format_seconds(value));
    };
    seconds("slices_placed_seconds", "placing slices", counts.setup_seconds);
    seconds("three_passes_seconds", "drawing", counts.draw_seconds);
    seconds("sums_to_voxels_seconds", "fitting voxels", counts.fit_seconds);
}

void report_device(Report& report, const job::DeviceUse& device) {
    report.bytes("peak device memory", device.peak_bytes);
    report.count("device batches", device.batches);
    report.seconds("upload", device.upload_seconds);
}

void report_plan(Report& report, const job::VoxelizeReport& done) {
    const VoxelizePlan& plan = done.plan;
    const Vec3d size = plan.lattice.voxel_size;
    report.add("voxel_size", "voxel size", {size.x, size.y, size.z},
               str(size.x, " x ", size.y, " x ", size.z, " scene units"));
    const Vec3i n = plan.voxel_hi - plan.voxel_lo;
    report.add("resolution", "resolution", {n.x, n.y, n.z},
               str(n.x, " x ", n.y, " x ", n.z, " voxels, ", plan.lattice.subvoxels,
                   " subvoxels per voxel axis"));
    report_work(report, plan, done.predicted_file_bytes);
    report.count("blocks", plan.blocks, str("of ", plan.block_voxels, "^3 voxels"));
    report.count("batches", plan.batches, plan.spool ? "with a temporary file" : "");
    report.number("step length", plan.step_length, "scene units");
    report.number("chord error", plan.chord_error, "subvoxels");
}

/// Returns false if there is only a plan.
bool is_written(const job::VoxelizeReport& done) {
    return done.file_bytes > 0;
}

} // namespace

void report_voxelize(Report& report, const job::VoxelizeReport& done, const std::string& output) {
    if (done.device) report.text("device", done.device->name);
    report_notes(report, done.notes);
    report_plan(report, done);
    if (!is_written(done)) return;
    if (done.raster) report_counts(report, *done.raster);
    if (done.device) report_device(report, *done.device);
    report.text("output", output);
    report_levels(report, done.counts);
    if (done.levels_thread_seconds) {
        report.add("levels_thread_seconds", "building levels", *done.levels_thread_seconds,
                   str(format_seconds(*done.levels_thread_seconds),
                       " summed over all threads, while voxelizing"));
    }
    report.bytes("file size", done.file_bytes);
    report_phases(report, done.phases);
    report_cost(report, done.seconds, done.peak_bytes);
}

void report_frames(Report& report,
                   const std::vector<job::AnimationFrame>& frames,
                   const std::vector<job::VoxelizeReport>& done) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    std::vector<std::vector<std::string>> rows;
    std::int64_t all_voxels = 0, all_bytes = 0, peak = 0;
    double all_seconds = 0.0;
    const bool written = std::any_of(done.begin(), done.end(), is_written);
    for (std::size_t k = 0; k < done.size(); ++k) {
        const job::VoxelizeReport& one = done[k];
        Report part = report.part();
        report_voxelize(part, one, frames[k].output);
        nlohmann::ordered_json value{{"frame", frames[k].number}, {"file", frames[k].input}};
        value.update(part.values());
        values.push_back(std::move(value));
        const std::int64_t voxels = written ? one.counts.voxels : one.plan.voxels;
        const std::int64_t bytes = written ? one.file_bytes : one.predicted_file_bytes;
        const double seconds = written ? one.seconds : one.plan.seconds;
        rows.push_back({std::to_string(frames[k].number), frames[k].output,
                        format_count(static_cast<double>(voxels)),
                        format_bytes(static_cast<double>(bytes)), format_seconds(seconds)});
        all_voxels += voxels;
        all_bytes += bytes;
        all_seconds += seconds;
        peak = std::max(peak, written ? one.peak_bytes : one.plan.peak_bytes);
    }
    report.table("frames", std::move(values), {"frame", "output", "voxels", "file size", "time"},
                 rows);
    const std::string before = written ? "" : "predicted ";
    report.count(before + "voxels", all_voxels);
    report.bytes(before + "file size", all_bytes);
    report.seconds(written ? "total" : "predicted time", all_seconds);
    report.bytes(before + "peak memory", peak);
}

} // namespace heddle::cli
