#include <heddle/cli/rows/report_parts.h>

#include <heddle/base/error.h>
#include <heddle/base/format_number.h>

#include <filesystem>

namespace heddle::cli {

std::string show(Vec3d v) {
    return str(v.x, ", ", v.y, ", ", v.z);
}

void report_levels(Report& report, const job::LevelCounts& counts) {
    report.count("voxels", counts.voxels);
    report.count("lobes", counts.lobes);
    report.count("levels", counts.levels,
                 str("(", format_count(static_cast<double>(counts.all_voxels)), " voxels and ",
                     format_count(static_cast<double>(counts.all_lobes)), " lobes in total)"));
}

void report_work(Report& report, const VoxelizePlan& plan, std::int64_t predicted_file_bytes) {
    report.count("primitives", plan.primitives, "spans and triangles");
    report.add("steps", "steps", plan.steps,
               str(format_count(plan.steps), " (fiber length in subvoxel edges)"));
    report.count("predicted voxels", plan.voxels);
    report.count("predicted touched subvoxels", plan.touched_subvoxels);
    report.bytes("predicted file size", predicted_file_bytes);
    report.bytes("predicted peak memory", plan.peak_bytes);
    if (plan.seconds > 0.0) report.seconds("predicted time", plan.seconds);
}

void report_vol(Report& report, const VolLayout& layout) {
    using Json = nlohmann::ordered_json;
    report.text("kind", layout.hierarchical ? "hierarchical grid volume" : "grid volume");
    const Bounds& b = layout.bounds;
    report.add("bounds", "bounds", {Json{b.lo.x, b.lo.y, b.lo.z}, Json{b.hi.x, b.hi.y, b.hi.z}},
               str(show(b.lo), "  to  ", show(b.hi)));
    const Vec3d h = layout.pitch;
    report.add("voxel_size", "voxel size", {h.x, h.y, h.z}, show(h) + " scene units");
    const Vec3i n = layout.samples();
    report.add("resolution", "resolution", {n.x, n.y, n.z},
               str(n.x, " x ", n.y, " x ", n.z, " samples"));
    if (layout.hierarchical) {
        const Vec3i c = layout.cells;
        const Vec3i s = layout.block_samples;
        report.count("blocks", static_cast<std::int64_t>(layout.blocks.size()),
                     str("of ", c.x, " x ", c.y, " x ", c.z, ", each of ", s.x, " x ", s.y, " x ",
                         s.z, " samples"));
    }
    const VolBlock& first = layout.blocks.front();
    const auto file = [](const std::string& path, const char* encoding) {
        return str(encoding, ", ", std::filesystem::path(path).filename().string());
    };
    report.text("density", file(first.density, to_string(layout.density_encoding)));
    report.text("orientation",
                layout.orientation_encoding
                    ? file(first.orientation, to_string(*layout.orientation_encoding))
                    : "none");
}

void report_notes(Report& report, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) report.note(note);
}

void report_phases(Report& report, const job::PhaseTimes& phases) {
    for (const auto& [phase, seconds] : phases) report.seconds(phase, seconds);
}

void report_cost(Report& report, double seconds, std::int64_t peak_bytes) {
    report.seconds("total", seconds);
    report.bytes("peak memory", peak_bytes);
}

} // namespace heddle::cli
