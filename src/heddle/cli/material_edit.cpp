#include <heddle/cli/material_edit.h>

#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/cli/terminal/option.h>
#include <heddle/cli/terminal/text.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace heddle::cli {
namespace {

/// Returns the values that a key allows.
/// @throws UsageError  there is no such key
ValueRule values_of(const std::string& key) {
    constexpr double kMost = std::numeric_limits<float>::max();
    const std::vector<std::string>& keys = job::material_keys();
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        const std::string_view near = nearest_name(key, keys);
        throw UsageError(str("--set: no key '", key, "'",
                             near.empty() ? str("; the keys are: ", listed_material_keys())
                                          : str("; did you mean '", near, "'?")));
    }
    if (key == "name") return any_text();
    if (key == "albedo") return numbers(3, 3, 0.0, 1.0);
    return key == "anisotropy_rotation" ? number(-kMost, kMost) : number(0.0, 1.0);
}

} // namespace

std::string listed_material_keys() {
    std::string text;
    for (const std::string& key : job::material_keys()) text += str(text.empty() ? "" : ", ", key);
    return text;
}

job::MaterialEdit material_edit_from(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::size_t dot = text.substr(0, equals).rfind('.');
    if (equals == std::string::npos || dot == std::string::npos) {
        throw UsageError(str("--set: '", text, "' is not NAME.KEY=VALUE"));
    }
    job::MaterialEdit edit{.material = text.substr(0, dot)};
    const std::string key = text.substr(dot + 1, equals - dot - 1);
    const std::string value = text.substr(equals + 1);
    const std::string problem = values_of(key).problem(value);
    if (!problem.empty()) throw UsageError(str("--set ", text.substr(0, equals), ": ", problem));
    if (key == "name") {
        edit.name = value;
        return edit;
    }
    std::vector<float> v;
    for (const std::string& piece : split(value, ',')) {
        v.push_back(static_cast<float>(parse_number(piece).value()));
    }
    if (key == "albedo") edit.albedo = Vec3f{v[0], v[1], v[2]};
    for (const auto& [name, field] :
         {std::pair{"roughness", &edit.roughness}, std::pair{"metalness", &edit.metalness},
          std::pair{"anisotropy", &edit.anisotropy},
          std::pair{"anisotropy_rotation", &edit.anisotropy_rotation},
          std::pair{"alpha", &edit.alpha}}) {
        if (key == name) *field = v[0];
    }
    return edit;
}

} // namespace heddle::cli
