#include <heddle/io/yarn/yarn_file.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/yarn/yarn_file_form.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

namespace heddle {
namespace {

namespace fs = std::filesystem;

/// A yarn file has about 30 lines: a larger file is of another kind.
constexpr std::uint64_t kMostBytes = 1 << 20;

YarnType wool() {
    YarnType y;
    y.name = "wool";
    y.model = YarnModel::Procedural;
    y.albedo = {0.72f, 0.62f, 0.48f};
    y.plies = 2;
    y.fibers_per_ply = 90;
    y.ply_clockwise = true; // S-plied from Z-spun singles, like most knitting wool
    y.ply_pitch = 9.0f;
    y.fiber_pitch = 10.0f;
    y.ply_offset = 0.48f;
    y.ellipse_long = 0.68f;
    y.ellipse_short = 0.52f;
    y.density_epsilon = 0.15f;
    y.density_beta = 0.6f;
    y.migration = true;
    y.migration_frequency = 1.9f;
    y.migration_min = 0.75f;
    y.flyaways = true;
    y.hair_density = 3.0f;
    y.hair_ze = {0.3f, 1.6f};
    y.hair_r0 = {0.65f, 0.15f};
    y.hair_re = {0.6f, 0.4f};
    y.hair_pe = {0.5f, 0.5f};
    y.loop_density = 3.0f;
    y.loop_r1 = {0.85f, 0.22f};
    y.fiber_radius = 0.04f; // 0.4 of the section
    return y;
}

YarnType cotton() {
    YarnType y;
    y.name = "cotton";
    y.model = YarnModel::Procedural;
    y.albedo = {0.85f, 0.83f, 0.78f};
    y.plies = 3;
    y.fibers_per_ply = 60;
    y.fiber_clockwise = true;
    y.ply_pitch = 11.0f;
    y.fiber_pitch = 9.0f;
    y.ply_offset = 0.52f;
    y.ellipse_long = 0.56f;
    y.ellipse_short = 0.46f;
    y.density_beta = 0.25f;
    y.migration = true;
    y.migration_min = 0.9f;
    y.flyaways = true;
    y.hair_density = 0.6f;
    y.hair_ze = {0.1f, 1.2f};
    y.hair_r0 = {0.5f, 0.1f};
    y.hair_re = {0.3f, 0.2f};
    y.hair_pe = {0.4f, 0.35f};
    y.loop_density = 0.4f;
    y.loop_r1 = {0.58f, 0.08f};
    y.fiber_radius = 0.048f; // 0.54 of the section: tightly spun
    return y;
}

YarnType silk() {
    YarnType y;
    y.name = "silk";
    y.model = YarnModel::Procedural;
    y.albedo = {0.88f, 0.82f, 0.74f};
    y.plies = 2;
    y.fibers_per_ply = 100;
    y.fiber_clockwise = true;
    y.ply_pitch = 16.0f;
    y.fiber_pitch = 24.0f; // filaments hold with little twist
    y.ply_offset = 0.5f;
    y.ellipse_long = 0.58f;
    y.ellipse_short = 0.5f;
    y.density_epsilon = 0.45f; // nearly uniform: filaments are side by side
    y.density_beta = 0.1f;
    y.fiber_radius = 0.04f; // 0.55 of the section
    return y;
}

std::optional<YarnType> preset(const std::string& name) {
    if (name == "cotton") return cotton();
    if (name == "silk") return silk();
    if (name == "wool") return wool();
    return std::nullopt;
}

/// Throws the Error for a name that does not exist, with the nearest known name.
[[noreturn]] void throw_unknown(const std::string& name) {
    const std::vector<std::string> names = list_presets();
    throw Error(ErrorCode::NotFound, str("there is no yarn preset or file '", name, "'",
                                         yarn_form::suggest(name, {names.begin(), names.end()})));
}

std::string read_text(const std::string& path) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) throw_unknown(path);
    return read_whole_file(path, kMostBytes);
}

} // namespace

std::vector<std::string> list_presets() {
    return {"cotton", "silk", "wool"};
}

YarnFile read_yarn(const std::string& preset_or_path, const LoadTexture& load_texture) {
    if (std::optional<YarnType> yarn = preset(preset_or_path)) return {std::move(*yarn), {}};
    const std::string text = read_text(preset_or_path);
    const std::string suffix = suffix_of(preset_or_path);
    if (suffix == ".toml") return parse_yarn_toml(text, preset_or_path, load_texture);
    if (suffix == ".txt") return parse_yarn_fit(text, preset_or_path);
    throw Error(ErrorCode::Unsupported, str("the suffix '", suffix, "' is not that of a yarn file"),
                "give a fit as .txt or a yarn as .toml", {.path = preset_or_path});
}

std::string set_fiber_count(YarnType& yarn, std::int64_t total) {
    const std::int64_t most = yarn.model == YarnModel::Solid ? 1 : yarn_form::kMostFibers;
    if (total < 1 || total > most) {
        throw Error(
            ErrorCode::InvalidArgument,
            str("a ", yarn_form::to_string(yarn.model), " yarn cannot have ", total, " fibers"),
            str("give a number from 1 to ", most));
    }
    const std::int64_t before = yarn.fiber_count();
    if (yarn.model == YarnModel::Slice) yarn.slice_fibers = static_cast<std::int32_t>(total);
    if (yarn.model == YarnModel::Procedural) {
        const std::int64_t per_ply = (total + yarn.plies / 2) / yarn.plies;
        yarn.fibers_per_ply = static_cast<std::int32_t>(std::max<std::int64_t>(1, per_ply));
    }
    const std::int64_t now = yarn.fiber_count();
    yarn.fiber_radius =
        static_cast<float>(static_cast<double>(yarn.fiber_radius) *
                           std::sqrt(static_cast<double>(before) / static_cast<double>(now)));
    if (now == total) return {};
    return str(total, " fibers cannot be split evenly over ", yarn.plies, " plies: ", now,
               " are used");
}

} // namespace heddle
