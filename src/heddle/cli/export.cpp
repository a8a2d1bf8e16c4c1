#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/flake/flake_field.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vol/write_mitsuba.h>
#include <heddle/io/vol/write_mitsuba06.h>

#include <chrono>

namespace heddle::cli {
namespace {

FlakeField read_field(const std::string& path, int level) {
    const std::unique_ptr<VoxelGrid> grid = read_vdb(path, level);
    if (grid->info().voxel_count == 0) {
        throw Error(ErrorCode::BadFile, "holds no voxels", "export a volume that has voxels",
                    {.path = path});
    }
    std::vector<Vec3f> albedo;
    for (const Material& material : grid->info().materials) albedo.push_back(material.albedo);
    return {*grid, albedo};
}

void export_mitsuba06(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string& folder = arguments.text("output");
    bar.begin("read", "files", 1);
    const std::unique_ptr<VoxelGrid> grid =
        read_vdb(arguments.text("FILE"), static_cast<int>(arguments.integer("level")));
    const Mitsuba06Options options{
        .stddev = arguments.number("stddev"),
        .block_samples = static_cast<std::int32_t>(arguments.integer("block-samples"))};
    if (options.block_samples == 1) {
        throw UsageError(
            "--block-samples: neighbouring blocks share a layer of samples, so the minimum is 2; 0 = a single block");
    }
    Mitsuba06Files files;
    write_output([&] { files = write_mitsuba06(*grid, folder, options, bar); });
    bar.finish();
    if (files.no_fiber > 0) {
        report.note(
            str(files.no_fiber, " voxels hold only surfaces and are written without a direction"));
    }
    report.text("output", folder);
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
    if (arguments.text("to") == "mitsuba06") {
        if (arguments.given("pad"))
            throw UsageError("--pad cannot be used with --to mitsuba06, whose blocks are sparse");
        return export_mitsuba06(arguments, report, bar);
    }
    for (const char* option : {"stddev", "block-samples"}) {
        if (!arguments.given(option)) continue;
        throw UsageError(str("--", option, " needs --to mitsuba06"));
    }
    const auto start = std::chrono::steady_clock::now();
    const std::string& folder = arguments.text("output");
    bar.begin("read", "files", 1);
    const FlakeField field =
        read_field(arguments.text("FILE"), static_cast<int>(arguments.integer("level")));
    bar.check();
    const MitsubaBox box = plan_mitsuba(field, arguments.number("pad"));
    write_output([&] { write_mitsuba(field, box, folder, bar); });
    bar.finish();
    report.text("output", folder);
    report.add("resolution", "resolution", {box.size.x, box.size.y, box.size.z},
               str(box.size.x, " x ", box.size.y, " x ", box.size.z, " voxels in a dense grid"));
    report.bytes("files", box.bytes);
    const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
    report.seconds("total", total.count());
    report.bytes("peak memory", peak_resident_bytes());
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
