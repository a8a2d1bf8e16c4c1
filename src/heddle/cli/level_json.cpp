#include <heddle/cli/level_table.h>

#include <array>
#include <utility>

namespace heddle::cli {
namespace {

using Json = nlohmann::ordered_json;

double ratio(std::int64_t a, std::int64_t b) {
    return b > 0 ? static_cast<double>(a) / static_cast<double>(b) : 0.0;
}

Json or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(const LevelErrors& e, std::int64_t bytes) {
    return {{"level", e.level},
            {"voxels", e.voxels},
            {"lobes", e.lobes},
            {"lobes_per_voxel", ratio(e.lobes, e.voxels)},
            {"bytes", bytes},
            {"bytes_per_voxel", ratio(bytes, e.voxels)},
            {"parents", e.parents},
            {"sigma_error", e.sigma},
            {"density_l1", e.cells},
            {"moment_median", e.moment},
            {"moment_largest", e.moment_worst},
            {"coverage_mean", or_null(e.coverage)},
            {"coverage_largest", or_null(e.coverage_worst)},
            {"kind_lost", e.lost}};
}

} // namespace

void add_json(const job::LevelTable& table, Report& report) {
    report.data("file", table.file);
    report.data("lod", table.lod);
    report.data("approximate", table.approximate);
    constexpr std::array<const char*, 3> kTruths{"union", "file", "none"};
    report.data("coverage_truth", kTruths[static_cast<std::size_t>(table.coverage)]);
    report.data("finest", {{"voxels", table.voxels},
                           {"lobes", table.lobes},
                           {"part_of_voxels", table.part_of > 0 ? table.part_of : table.voxels},
                           {"bytes", table.finest_bytes},
                           {"mask_bytes", table.mask_bytes}});
    Json methods = Json::array();
    for (const job::MethodRow& m : table.methods) {
        Json levels = Json::array();
        for (const LevelErrors& e : m.errors.levels) {
            levels.push_back(json_of(e, m.bytes_at(e.level)));
        }
        methods.push_back({{"name", m.errors.name},
                           {"build_seconds", or_null(m.build_seconds)},
                           {"bytes", m.bytes_above()},
                           {"levels", std::move(levels)}});
    }
    report.data("methods", std::move(methods));
}

} // namespace heddle::cli
