#include <heddle/cli/voxelize_raster.h>
#include <heddle/cli/voxelize_vol.h>

#include <heddle/base/memory.h>
#include <heddle/base/parallel.h>
#include <heddle/cli/level_options.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/cli/voxel_options.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/io/vol/read_vol.h>

#include <chrono>
#include <filesystem>

namespace heddle::cli {
namespace {

/// Options of `voxelize` that choose or measure voxels: a volume has them.
void refuse_other_options(const Arguments& arguments) {
    std::vector<std::string> useless{"bounds",  "subvoxels", "coverage",
                                     "samples", "fit",       "fill-memory"};
    for (const std::vector<Option>& rows :
         {resolution_options(), load_options(), model_options(), raster_options()}) {
        for (const Option& row : rows) useless.push_back(row.key());
    }
    for (const std::string& key : useless) {
        if (!arguments.given(key)) continue;
        throw UsageError(
            str("--", key, " cannot be used with a .vol, whose samples become the voxels"));
    }
}

VolOptions vol_options(const Arguments& arguments) {
    VolOptions options;
    if (arguments.given("density-scale")) {
        options.density_scale = arguments.number("density-scale");
    }
    const std::vector<double> rgb = arguments.numbers("albedo");
    const bool grey = rgb.size() == 1;
    options.albedo = to_float({rgb[0], grey ? rgb[0] : rgb[1], grey ? rgb[0] : rgb[2]});
    options.max_lobes = static_cast<std::int32_t>(arguments.integer("lobes"));
    options.command = arguments.command_line;
    return options;
}

std::string show(Vec3d v) {
    return str(v.x, ", ", v.y, ", ", v.z);
}

/// The blocks in memory where that holds them: levels and each grid of the file walk all of them, and the
/// source decodes them anew every time.
std::unique_ptr<VoxelSource>
hold(std::unique_ptr<VoxelSource> source, const Arguments& arguments, Progress& progress) {
    const VoxelGridInfo& info = source->info();
    const std::int64_t limit =
        arguments.given("memory") ? arguments.bytes("memory") : available_bytes() / 2;
    const std::int64_t leaves = info.voxel_count / 8; // at most, in what is worth holding
    if (2 * predict_block_bytes(leaves, info.voxel_count, info.lobe_count, info.fields) > limit) {
        return source;
    }
    auto grid = std::make_unique<VoxelGrid>();
    grid->set_info(info);
    grid->blocks.resize(source->block_count());
    progress.begin("decode", "blocks", static_cast<std::int64_t>(grid->blocks.size()));
    parallel_chunks(grid->blocks.size(), 1, [&](std::size_t i, std::size_t) {
        progress.check();
        VoxelBlock scratch;
        grid->blocks[i] = source->block(i, scratch);
        progress.advance(1);
    });
    return grid;
}

} // namespace

std::vector<Option> volume_options() {
    return grouped(
        "Mitsuba volumes (.vol)",
        {
            {"--orientation", "FILE", "(found by its name)", any_text(), "",
             "Orientation file of a .vol volume, or any one orientation file of a dictionary; 'none' ignores orientation."},
            {"--density-scale", "S", "(2 / voxel size: density 1 covers 86 % of a voxel's face)",
             positive(), "per scene unit",
             "Extinction at density 1, which is 'scale' in a Mitsuba scene."},
            {"--albedo", "R[,G,B]", "0.8", numbers(1, 3, 0.0, 1.0), "linear",
             "Albedo of the fibers."},
        });
}

bool is_volume(const Arguments& arguments) {
    return suffix_of(arguments.text("FILE")) == ".vol";
}

void refuse_volume_options(const Arguments& arguments) {
    for (const Option& row : volume_options()) {
        if (!arguments.given(row.key())) continue;
        throw UsageError(str("--", row.key(), " applies only to .vol files"));
    }
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

void voxelize_volume(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const auto start = std::chrono::steady_clock::now();
    refuse_other_options(arguments);
    const std::string output = arguments.text("output");
    const VolOptions options = vol_options(arguments);
    const bool dry_run = arguments.given("dry-run");
    if (!dry_run) check_output(output, ".vdb");
    bar.begin("find", "files", 1);
    const VolLayout layout = find_vol_layout(
        arguments.text("FILE"),
        arguments.given("orientation") ? arguments.text("orientation") : std::string());
    bar.finish();
    report_vol(report, layout);
    if (dry_run) return;

    VolVolume volume = read_vol(layout, options, bar);
    bar.finish();
    for (const std::string& note : volume.notes) report.note(note);
    const VoxelLevels levels =
        add_levels(hold(std::move(volume.grid), arguments, bar), arguments, bar);
    write_output([&] { write_vdb(levels, output, bar); });
    bar.finish();
    report.text("output", output);
    report_levels(report, levels);
    std::error_code ignored;
    const auto size = std::filesystem::file_size(output, ignored);
    report.bytes("file size", ignored ? 0 : static_cast<std::int64_t>(size));
    for (const auto& [stage, seconds] : bar.stages()) report.seconds(stage, seconds);
    const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
    report.seconds("total", total.count());
    report.bytes("peak memory", peak_resident_bytes());
}

} // namespace heddle::cli
