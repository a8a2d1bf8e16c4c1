#include <heddle/job/level/measure_levels.h>

#include <heddle/base/format_number.h>
#include <heddle/base/memory.h>
#include <heddle/io/vdb/content_hash.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/job/level/level_plot.h>
#include <heddle/job/level/scratch_folder.h>
#include <heddle/job/option_error.h>
#include <heddle/job/write_output.h>
#include <heddle/lod/level_subset.h>
#include <heddle/lod/rebuild_levels.h>

#include <algorithm>
#include <utility>

namespace heddle::job {
namespace {

/// Default number of voxels of the part that is measured if `wasserstein` is among the methods.
constexpr std::int64_t kSlowPart = 50000;
/// Time that `wasserstein` takes on two cores for all levels, per voxel of level 0: 5 ms a parent,
/// measured on 7,646 voxels of a cable knit.
constexpr double kSlowSeconds = 1.3e-3;

void check_measure_options(const MeasureLevelsOptions& o) {
    if (o.parents < 1) throw OptionError(str("`parents` is ", o.parents, "; it must be >= 1"));
    if (o.part && *o.part < 1) throw OptionError(str("`part` is ", *o.part, "; it must be >= 1"));
    if (o.lobes && (*o.lobes < 1 || *o.lobes > 8)) {
        throw OptionError(str("`lobes` is ", *o.lobes, "; it must be 1 to 8"));
    }
    if (o.plot) check_output(*o.plot, ".svg", "plot");
}

/// Returns the methods without repetition.
std::vector<LodMethod> distinct(const std::vector<LodMethod>& methods) {
    std::vector<LodMethod> out;
    for (const LodMethod method : methods) {
        if (std::find(out.begin(), out.end(), method) == out.end()) out.push_back(method);
    }
    return out;
}

bool is_slow(const std::vector<LodMethod>& methods) {
    return std::find(methods.begin(), methods.end(), LodMethod::Wasserstein) != methods.end();
}

/// Bytes per level from 0.
std::vector<std::int64_t> bytes_of(const std::vector<GridSummary>& grids) {
    std::vector<std::int64_t> out;
    for (const GridSummary& grid : grids) {
        const auto level = static_cast<std::size_t>(grid.level);
        out.resize(std::max(out.size(), level + 1));
        out[level] += grid.bytes;
    }
    return out;
}

/// Returns the grids that a .vdb of these levels has.
std::vector<GridSummary> weigh(const VoxelLevels& levels, Progress& progress) {
    const ScratchFolder folder;
    write_output([&] { write_vdb(levels, folder.file(), progress); });
    return summarize_vdb(folder.file());
}

/// Returns the bytes that the levels above 0 have in a file: writes them with an empty level 0.
std::vector<std::int64_t> weigh_above(VoxelLevels levels, Progress& progress) {
    auto finest = std::make_unique<MemoryLevel>();
    finest->info() = levels[0]->info();
    finest->info().fields.masks = false;
    finest->info().voxel_count = finest->info().lobe_count = 0;
    levels[0] = std::move(finest);
    return bytes_of(weigh(levels, progress));
}

/// What is measured: all levels of the input, or a part of its finest level.
struct Scope {
    const VoxelLevels& whole;
    std::unique_ptr<LevelSubset> part;

    [[nodiscard]] const VoxelLevel& finest() const { return part ? *part : *whole[0]; }
    [[nodiscard]] VoxelLevels share() const {
        if (!part) return share_levels(whole);
        VoxelLevels one;
        one.push_back(std::make_unique<LevelSubset>(*part));
        return one;
    }
};

Scope scope_of(const VoxelLevels& levels, const MeasureLevelsOptions& options) {
    Scope scope{levels, nullptr};
    const VoxelLevel& finest = *levels[0];
    const std::int64_t wanted =
        options.part.value_or(is_slow(options.methods) ? kSlowPart : finest.info().voxel_count);
    if (wanted < finest.info().voxel_count) {
        scope.part =
            std::make_unique<LevelSubset>(finest, choose_blocks(finest, wanted, options.seed));
    }
    return scope;
}

void tell_scope(const Scope& scope,
                const MeasureLevelsOptions& options,
                LevelTable& table,
                Progress& progress) {
    if (scope.part) {
        take_notes(table.notes,
                   {str("measured on a part: ", scope.part->info().voxel_count, " of ",
                        scope.whole[0]->info().voxel_count, " voxels, in whole blocks (`part`)")},
                   progress);
    }
    if (!is_slow(options.methods)) return;
    const double seconds = kSlowSeconds * static_cast<double>(scope.finest().info().voxel_count);
    take_notes(table.notes,
               {str("wasserstein will take about ", format_seconds(seconds), " on two cores")},
               progress);
}

MethodRow build(const Scope& scope,
                LodMethod method,
                const MeasureLevelsOptions& options,
                LevelReporter& reporter,
                PhaseClock& clock) {
    LodOptions lod;
    lod.method = method;
    lod.max_levels = static_cast<int>(scope.whole.size()) - 1;
    lod.max_lobes = options.lobes.value_or(scope.whole[1]->info().max_lobes);
    lod.seed = options.seed;
    const double start = clock.seconds();
    VoxelLevels levels = heddle::rebuild_levels(scope.share(), lod, false, clock);
    const double seconds = clock.seconds() - start;
    if (levels.size() < 2) {
        throw OptionError(
            "`part`: the part is at most two voxels wide on every axis and has no levels; give a larger number");
    }
    reporter.take(name_of(method), levels);
    return {seconds, weigh_above(std::move(levels), clock), {}};
}

/// Fills in what is measured, so that the table is complete without its input.
void describe(const Scope& scope, const std::vector<GridSummary>& grids, LevelTable& table) {
    const VoxelLevelInfo& whole = scope.whole[0]->info();
    table.lod = whole.lod;
    table.approximate = !whole.fields.masks;
    table.voxels = scope.finest().info().voxel_count;
    table.lobes = scope.finest().info().lobe_count;
    table.part_of = scope.part ? whole.voxel_count : 0;
    for (const GridSummary& g : grids) {
        const bool sums = g.name.starts_with("columns_") || g.name.starts_with("sums_");
        if (g.level == 0) (sums ? table.mask_bytes : table.finest_bytes) += g.bytes;
    }
    table.file_bytes = bytes_of(grids);
}

void measure_methods(const Scope& scope,
                     const MeasureLevelsOptions& options,
                     LevelTable& table,
                     PhaseClock& clock) {
    LevelReporter reporter(scope.finest(), scope.part ? nullptr : &scope.whole,
                           {.parents = options.parents, .seed = options.seed});
    table.coverage = reporter.coverage_truth();
    if (!scope.part) {
        reporter.take("file", scope.whole);
        table.methods.push_back({std::nullopt, table.file_bytes, {}});
    }
    for (const LodMethod method : distinct(options.methods)) {
        table.methods.push_back(build(scope, method, options, reporter, clock));
    }
    std::vector<MethodErrors> errors = reporter.measure(clock);
    for (std::size_t m = 0; m < errors.size(); ++m) table.methods[m].errors = std::move(errors[m]);
}

/// @param path  file of the levels; empty: they are written to find their size
LevelTable measure(const VoxelLevels& levels,
                   const std::string& path,
                   const MeasureLevelsOptions& options,
                   PhaseClock& clock) {
    LevelTable table;
    table.file = path;
    const Scope scope = scope_of(levels, options);
    tell_scope(scope, options, table, clock);
    describe(scope, path.empty() ? weigh(levels, clock) : summarize_vdb(path), table);
    measure_methods(scope, options, table, clock);
    if (options.plot) write_text(*options.plot, plot_levels(table));
    clock.finish();
    table.phases = clock.phases();
    table.peak_bytes = peak_resident_bytes();
    return table;
}

} // namespace

LevelTable
measure_levels(const VoxelLevels& levels, const MeasureLevelsOptions& options, Progress& progress) {
    PhaseClock clock(progress);
    check_measure_options(options);
    if (levels.size() < 2) {
        throw OptionError("only the finest level is there, so there are no levels to measure");
    }
    return measure(levels, {}, options, clock);
}

LevelTable
measure_levels(const std::string& path, const MeasureLevelsOptions& options, Progress& progress) {
    PhaseClock clock(progress);
    check_measure_options(options);
    if (read_infos(path).size() < 2) {
        throw Error(ErrorCode::BadFile,
                    "has only the finest level, so there are no levels to measure",
                    "build levels with 'heddle lod'", {.path = path});
    }
    clock.begin("read", "files", 1);
    const VoxelLevels levels = read_levels(path);
    clock.check();
    return measure(levels, path, options, clock);
}

} // namespace heddle::job
