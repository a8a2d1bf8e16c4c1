#include <heddle/base/error.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/job/render/export_volume.h>

namespace heddle::cli {
namespace {

job::ExportOptions export_options_from(const Arguments& arguments) {
    job::ExportOptions options;
    if (arguments.text("to") == "mitsuba06") options.to = job::ExportFormat::Mitsuba06;
    options.level = static_cast<int>(arguments.integer("level"));
    options.pad = arguments.find_number("pad");
    options.stddev = arguments.find_number("stddev");
    if (arguments.given("block-samples")) {
        options.block_samples = static_cast<std::int32_t>(arguments.integer("block-samples"));
    }
    return options;
}

void report_blocks(Report& report, const Mitsuba06Files& files) {
    report.add("resolution", "resolution", {files.samples.x, files.samples.y, files.samples.z},
               str(files.samples.x, " x ", files.samples.y, " x ", files.samples.z, " samples"));
    const Vec3i n = files.block_samples;
    report.count("blocks", files.blocks,
                 str("of ", n.x, " x ", n.y, " x ", n.z, " samples, in a grid of ", files.cells.x,
                     " x ", files.cells.y, " x ", files.cells.z, " blocks"));
    report.data("cells", {files.cells.x, files.cells.y, files.cells.z});
    report.number("scale", files.scale, "extinction per scene unit at density 1");
    report.bytes("files", files.bytes);
}

void run_export(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string& folder = arguments.text("output");
    const job::ExportReport done =
        job::export_volume(arguments.text("FILE"), folder, export_options_from(arguments), bar);
    report_notes(report, done.notes);
    report.text("output", folder);
    if (done.files) return report_blocks(report, *done.files);
    const MitsubaBox& box = done.box.value();
    report.add("resolution", "resolution", {box.size.x, box.size.y, box.size.z},
               str(box.size.x, " x ", box.size.y, " x ", box.size.z, " voxels in a dense grid"));
    report.bytes("files", box.bytes);
    report_cost(report, done.seconds, done.peak_bytes);
}

} // namespace

Command export_command() {
    return {
        "export", "Writes a volume for another renderer: grids and a scene that loads them.",
        joined({
            grouped(
                "Input and output",
                {
                    {"FILE", "", "", any_text(), "", "A .vdb written by heddle.", true},
                    {"-o, --output", "DIR", "", any_text(), "", "Folder for the files.", true},
                    {"--to", "FORMAT", "mitsuba3", one_of({"mitsuba3", "mitsuba06"}), "",
                     "mitsuba3: a dense grid of extinction, one SGGX of normals per voxel and albedo; mitsuba06: sparse hgridvolume blocks of density and direction. Both come with scene.xml."},
                    {"--level", "N", "0", integer(0, 1000), "", "Level of detail; 0 = the finest."},
                }),
            grouped(
                "Mitsuba 3",
                {
                    {"--pad", "F", "1", number(1, 1000), "",
                     "Enlarges the exported box by this factor along each axis with empty voxels."},
                }),
            grouped(
                "Mitsuba 0.6",
                {
                    {"--stddev", "S", "0.3", number(0.01, 10), "",
                     "Standard deviation of the flakes around the fiber direction ('stddev' in scene.xml)."},
                    {"--block-samples", "N", "64", integer(0, 512), "samples",
                     "Samples along the edge of a block; 0 = a single block for everything."},
                }),
        }),
        run_export};
}

} // namespace heddle::cli
