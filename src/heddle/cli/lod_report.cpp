#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/base/nearest_name.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/lod_table.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/io/image/image.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/lod/build_levels.h>
#include <heddle/lod/rebuild_levels.h>
#include <heddle/lod/source_part.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>

namespace heddle::cli {
namespace {

/// Voxels of the part that `wasserstein` is measured on unless another is asked for.
constexpr std::int64_t kSlowPart = 50000;
/// What `wasserstein` takes for a finest voxel on two cores, all levels: 5 ms a parent, measured on
/// 7,646 voxels of a cable knit.
constexpr double kSlowSeconds = 1.3e-3;

std::vector<LodMethod> methods_from(const Arguments& arguments) {
    std::vector<LodMethod> out;
    for (const std::string& name : split(arguments.text("methods"), ',')) {
        const std::optional<LodMethod> method = lod_method_of(name);
        if (!method) {
            const std::string_view near = nearest_name(name, kLodMethodNames);
            std::string all;
            for (const char* known : kLodMethodNames) all += str(all.empty() ? "" : ", ", known);
            throw UsageError(str("--methods: '", name, "' is not one of ", all,
                                 near.empty() ? "" : str("; did you mean '", near, "'?")));
        }
        if (std::find(out.begin(), out.end(), *method) == out.end()) out.push_back(*method);
    }
    return out;
}

bool is_slow(const std::vector<LodMethod>& methods) {
    return std::find(methods.begin(), methods.end(), LodMethod::Wasserstein) != methods.end();
}

/// A folder for what is written to be weighed; gone with this.
class ScratchFolder {
public:
    ScratchFolder() {
        std::error_code none;
        std::string name = (std::filesystem::temp_directory_path(none) / "heddle-XXXXXX").string();
        if (none || ::mkdtemp(name.data()) == nullptr) {
            throw Error(ErrorCode::CannotWrite,
                        "lod-report: cannot create a folder for temporary files",
                        "set TMPDIR to a writable folder");
        }
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] std::string file() const { return (path_ / "levels.vdb").string(); }

private:
    std::filesystem::path path_;
};

/// Bytes by level from 0.
std::vector<std::int64_t> bytes_of(const std::vector<GridSummary>& grids) {
    std::vector<std::int64_t> out;
    for (const GridSummary& grid : grids) {
        const auto level = static_cast<std::size_t>(grid.level);
        out.resize(std::max(out.size(), level + 1));
        out[level] += grid.bytes;
    }
    return out;
}

/// Bytes in a file of the levels above 0, which are written for it under an empty level 0.
std::vector<std::int64_t> weigh(VoxelLevels levels, Progress& progress) {
    auto finest = std::make_unique<VoxelGrid>();
    finest->info() = levels[0]->info();
    finest->info().fields.masks = false;
    finest->info().voxel_count = finest->info().lobe_count = 0;
    levels[0] = std::move(finest);
    const ScratchFolder folder;
    write_output([&] { write_vdb(levels, folder.file(), progress); });
    return bytes_of(summarize_vdb(folder.file()));
}

/// Reads a file that has levels above 0.
VoxelLevels read_pyramid(const std::string& path, ProgressBar& bar) {
    if (read_infos(path).size() < 2) {
        throw Error(ErrorCode::BadFile,
                    "has only the finest level, so there are no levels to measure",
                    "build levels with 'heddle lod'", {.path = path});
    }
    bar.begin("read", "files", 1);
    VoxelLevels levels = read_levels(path);
    bar.check();
    return levels;
}

/// The finest level and what lies above it in the file: all, or a part without levels.
struct Scope {
    VoxelLevels file;
    std::unique_ptr<SourcePart> part;

    [[nodiscard]] const VoxelSource& finest() const { return part ? *part : *file[0]; }
    [[nodiscard]] VoxelLevels share() const {
        if (!part) return share_levels(file);
        VoxelLevels one;
        one.push_back(std::make_unique<SourcePart>(*part));
        return one;
    }
};

Scope scope_of(const std::string& path,
               const Arguments& arguments,
               const std::vector<LodMethod>& methods,
               ProgressBar& bar) {
    Scope scope{read_pyramid(path, bar), nullptr};
    const VoxelSource& finest = *scope.file[0];
    std::int64_t wanted = is_slow(methods) ? kSlowPart : finest.info().voxel_count;
    if (arguments.given("part")) wanted = arguments.integer("part");
    if (wanted < finest.info().voxel_count) {
        const auto seed = static_cast<std::uint64_t>(arguments.integer("seed"));
        scope.part = std::make_unique<SourcePart>(finest, choose_blocks(finest, wanted, seed));
    }
    return scope;
}

MethodRow build(const Scope& scope,
                LodMethod method,
                const Arguments& arguments,
                LevelReporter& reporter,
                ProgressBar& bar) {
    LodOptions options;
    options.method = method;
    options.max_levels = static_cast<int>(scope.file.size()) - 1;
    options.max_lobes = scope.file[1]->info().max_lobes;
    if (arguments.given("lobes")) options.max_lobes = static_cast<int>(arguments.integer("lobes"));
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    const auto start = std::chrono::steady_clock::now();
    VoxelLevels levels = rebuild_levels(scope.share(), options, false, bar);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (levels.size() < 2) {
        throw UsageError(
            "--part: the part is at most two voxels wide on every axis and has no levels; give a larger number");
    }
    reporter.take(name_of(method), levels);
    return {seconds.count(), weigh(std::move(levels), bar), {}};
}

/// Says what the numbers stand for, so that a table can be read alone.
LodTable table_of(const std::string& path, const Scope& scope, const LevelReporter& reporter) {
    const VoxelGridInfo& whole = scope.file[0]->info();
    LodTable table;
    table.file = path;
    table.lod = whole.lod;
    table.approximate = !whole.fields.masks;
    table.coverage = reporter.coverage_truth();
    table.voxels = scope.finest().info().voxel_count;
    table.lobes = scope.finest().info().lobe_count;
    table.part_of = scope.part ? whole.voxel_count : 0;
    const std::vector<GridSummary> grids = summarize_vdb(path);
    for (const GridSummary& g : grids) {
        const bool sums = g.name.starts_with("columns_") || g.name.starts_with("sums_");
        if (g.level == 0) (sums ? table.mask_bytes : table.finest_bytes) += g.bytes;
    }
    table.file_bytes = bytes_of(grids);
    return table;
}

void run_lod_report(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::vector<LodMethod> methods = methods_from(arguments);
    const bool plot = arguments.given("plot");
    if (plot) check_output(arguments.text("plot"), ".png", "--plot");
    const std::string& path = arguments.text("FILE");
    const Scope scope = scope_of(path, arguments, methods, bar);
    if (scope.part) {
        report.note(str("measured on a part: ", scope.part->info().voxel_count, " of ",
                        scope.file[0]->info().voxel_count, " voxels, in whole blocks (--part)"));
    }
    if (is_slow(methods)) {
        const double seconds =
            kSlowSeconds * static_cast<double>(scope.finest().info().voxel_count);
        report.note(str("wasserstein will take about ", show_seconds(seconds), " on two cores"));
    }
    LevelReporter reporter(scope.finest(), scope.part ? nullptr : &scope.file,
                           {.parents = static_cast<int>(arguments.integer("parents")),
                            .seed = static_cast<std::uint64_t>(arguments.integer("seed"))});
    LodTable table = table_of(path, scope, reporter);
    if (!scope.part) {
        reporter.take("file", scope.file);
        table.methods.push_back({std::nullopt, table.file_bytes, {}});
    }
    for (const LodMethod method : methods) {
        table.methods.push_back(build(scope, method, arguments, reporter, bar));
    }
    std::vector<MethodErrors> errors = reporter.measure(bar);
    for (std::size_t m = 0; m < errors.size(); ++m) table.methods[m].errors = std::move(errors[m]);
    if (plot) {
        const PlotImage image = draw_plot(panels_of(table));
        write_output(
            [&] { write_png(arguments.text("plot"), image.width, image.height, 3, image.rgb); });
    }
    bar.finish();
    add_json(table, report);
    report.page(markdown_of(table));
    for (const auto& [stage, seconds] : bar.stages()) report.data(stage + "_seconds", seconds);
    report.data("peak_memory_bytes", peak_resident_bytes());
}

} // namespace

Command lod_report_command() {
    return {
        "lod-report", "Measures the errors of the levels of detail of a .vdb, for several methods.",
        joined({
            grouped("Input and output",
                    {
                        {"FILE", "", "", any_text(), "", "A .vdb with levels of detail.", true},
                        {"--plot", "OUT.png", "", any_text(), "",
                         "Writes a plot of the errors by level, with one line per method."},
                    }),
            grouped(
                "Methods",
                {
                    {"--methods", "A,B,...", "moments,single,naive,random,interpolate", any_text(),
                     "",
                     "Methods to build and measure levels with; wasserstein is available too, but slow."},
                    {"--lobes", "K", "(as in the file)", integer(1, 8), "",
                     "Maximum number of orientation lobes per voxel of the built levels."},
                }),
            grouped(
                "Effort",
                {
                    {"--parents", "N", "2000", integer(1, 1000000), "voxels per level",
                     "Maximum number of voxels that are compared with all finest voxels below them."},
                    {"--part", "N", "(all; 50000 with wasserstein)",
                     integer(1, std::int64_t{1} << 40), "voxels of the finest level",
                     "Builds and measures only some blocks, chosen by --seed, with about this many voxels."},
                }),
        }),
        run_lod_report};
}

} // namespace heddle::cli
