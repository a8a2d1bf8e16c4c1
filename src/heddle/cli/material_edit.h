#pragma once

#include <heddle/job/edit_materials.h>

#include <string>

namespace heddle::cli {

/// "name, albedo, ...": what a material's edit can change.
[[nodiscard]] std::string listed_material_keys();

/// NAME.KEY=VALUE as an edit of the material NAME.
/// @throws UsageError  it is none; no such key; a value that the key does not allow
[[nodiscard]] job::MaterialEdit material_edit_from(const std::string& text);

} // namespace heddle::cli
