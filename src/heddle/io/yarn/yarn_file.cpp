#include <heddle/io/yarn/yarn_file.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/yarn/presets.h>
#include <heddle/io/yarn/yarn_file_form.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace heddle {
namespace {

namespace fs = std::filesystem;

/// A yarn file has about 30 lines: a larger file is of another kind.
constexpr std::uint64_t kMaxBytes = 1 << 20;

const YarnPreset* find_preset(const std::string& name) {
    for (const YarnPreset& preset : yarn_presets()) {
        if (preset.name == name) return &preset;
    }
    return nullptr;
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
    return read_whole_file(path, kMaxBytes);
}

} // namespace

std::vector<std::string> list_presets() {
    std::vector<std::string> names;
    for (const YarnPreset& preset : yarn_presets()) names.emplace_back(preset.name);
    return names;
}

YarnFile read_yarn(const std::string& preset_or_path, const LoadTexture& load_texture) {
    if (const YarnPreset* preset = find_preset(preset_or_path)) {
        return parse_yarn_toml(std::string(preset->toml), preset_or_path);
    }
    const std::string text = read_text(preset_or_path);
    const std::string suffix = suffix_of(preset_or_path);
    if (suffix == ".toml") return parse_yarn_toml(text, preset_or_path, load_texture);
    if (suffix == ".txt") return parse_yarn_fit(text, preset_or_path);
    throw Error(ErrorCode::Unsupported, str("the suffix '", suffix, "' is not that of a yarn file"),
                "give a fit as .txt or a yarn as .toml", {.path = preset_or_path});
}

std::string set_fiber_count(YarnType& yarn, std::int64_t total) {
    const std::int64_t most = yarn.model == YarnModel::Solid ? 1 : yarn_form::kMaxFibers;
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
