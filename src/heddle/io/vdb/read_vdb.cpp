#include <heddle/io/vdb/read_vdb.h>

#include <heddle/base/error.h>
#include <heddle/io/vdb/grid_name.h>
#include <heddle/io/vdb/info_json.h>
#include <heddle/io/vdb/level_reader.h>
#include <heddle/io/vdb/vdb_format.h>

#include <algorithm>
#include <set>

namespace heddle {
namespace {

/// An opened file whose voxels are not read yet.
struct OpenFile {
    VdbContents contents;
    std::vector<VoxelLevelInfo> levels; ///< finest first, with their fields
};

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw Error(ErrorCode::BadFile, what, "write it again with heddle", {.path = path});
}

void check_format(const std::string& path, const VdbContents& file) {
    const auto& meta = file.metadata;
    if (!meta.contains(kFormatKey)) {
        std::string list;
        for (const GridEntry& e : file.grids) {
            list += str(list.empty() ? "" : ", ", "'", e.name, "' (", e.type, ")");
        }
        throw Error(
            ErrorCode::BadFile,
            str("a VDB that heddle did not write: it holds ", list.empty() ? "no grids" : list),
            "give a file made by 'heddle voxelize'", {.path = path});
    }
    const std::string& format = meta.at(kFormatKey);
    if (format != std::to_string(kPlainFormat) && format != std::to_string(kPlacedFormat)) {
        throw Error(ErrorCode::Unsupported,
                    str("format version ", format, " (allowed: ", kPlainFormat, " and ",
                        kPlacedFormat, ")"),
                    "use the heddle that wrote it", {.path = path});
    }
    for (const char* name : {kLevelsKey, kInfoKey, kMaterialsKey, kYarnsKey}) {
        if (!meta.contains(name)) fail(path, str("metadata '", name, "' is missing"));
    }
}

/// Checks that every level has its coverage, and that no grid is duplicate or of an unknown level.
void check_levels(const std::string& path, const VdbContents& file, std::size_t levels) {
    const std::string& count = file.metadata.at(kLevelsKey);
    if (count != std::to_string(levels)) {
        fail(path, str(kLevelsKey, " says ", count, ", ", kInfoKey, " lists ", levels));
    }
    std::set<std::string> names;
    for (const GridEntry& e : file.grids) {
        if (!names.insert(e.name).second) fail(path, str("grid '", e.name, "' is there twice"));
        const int level = split_grid_name(e.name).level;
        if (level < 0 || static_cast<std::size_t>(level) >= levels) {
            fail(path, str("grid '", e.name, "' is of no level (there are ", levels,
                           ", and level 0 has no suffix)"));
        }
    }
    for (std::size_t l = 0; l < levels; ++l) {
        const std::string name = grid_name(GridKind::Coverage, 0, static_cast<int>(l));
        if (names.contains(name)) continue;
        fail(path, str("level ", l, " is missing: ", kLevelsKey, " says ", levels,
                       " and there is no grid '", name, "'"));
    }
}

/// The fields that exist as a grid at any level: the reader then reports those missing in others.
VoxelFields find_fields(const std::string& path, const VdbContents& file) {
    std::set<std::string> stems;
    for (const GridEntry& e : file.grids) stems.insert(split_grid_name(e.name).stem);
    const auto has = [&](GridKind kind) { return stems.contains(grid_name(kind)); };
    const auto any = [&](const char* start) {
        const auto at = stems.lower_bound(start);
        return at != stems.end() && at->starts_with(start);
    };
    VoxelFields fields;
    fields.albedo = has(GridKind::Albedo);
    fields.surface = has(GridKind::Surface);
    fields.tangents = has(GridKind::Aniso);
    fields.occupancy = has(GridKind::Occupancy);
    fields.correlation = has(GridKind::Correlation);
    fields.slabs = has(GridKind::Slab);
    fields.masks = any("columns_") || any("sums_");
    const bool four = has(GridKind::Footprint), eight = any("footprint_");
    if (four && eight) fail(path, "footprints of 4 and of 8 cells (allowed: one kind)");
    fields.footprints = four ? 4 : eight ? 8 : 0;
    return fields;
}

OpenFile open(const std::string& path) {
    OpenFile file{read_contents(path), {}};
    check_format(path, file.contents);
    const auto text = [&](const char* name) { return file.contents.metadata.at(name); };
    file.levels = infos_from_json({text(kInfoKey), text(kMaterialsKey), text(kYarnsKey)}, path);
    check_levels(path, file.contents, file.levels.size());
    const VoxelFields fields = find_fields(path, file.contents);
    for (VoxelLevelInfo& info : file.levels) info.fields = fields;
    return file;
}

} // namespace

std::vector<VoxelLevelInfo> read_infos(const std::string& path) {
    return open(path).levels;
}

std::unique_ptr<MemoryLevel> read_vdb(const std::string& path, int level) {
    const OpenFile file = open(path);
    const int n = static_cast<int>(file.levels.size());
    if (level < 0 || level >= n) {
        throw Error(ErrorCode::NotFound, str("has no level ", level),
                    n == 1 ? "its only level is 0" : str("its levels are 0 to ", n - 1),
                    {.path = path});
    }
    return read_level(path, file.contents, file.levels[static_cast<std::size_t>(level)]);
}

VoxelLevels read_levels(const std::string& path) {
    const OpenFile file = open(path);
    VoxelLevels levels;
    for (const VoxelLevelInfo& info : file.levels) {
        levels.push_back(read_level(path, file.contents, info));
    }
    return levels;
}

} // namespace heddle
