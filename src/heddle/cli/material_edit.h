#pragma once

#include <heddle/job/edit_materials.h>

#include <string>

namespace heddle::cli {

/// Returns the keys that an edit of a material can change, such as "name, albedo, ...".
[[nodiscard]] std::string listed_material_keys();

/// Converts NAME.KEY=VALUE to an edit of the material NAME.
/// @throws UsageError  the text has another form, or the key or its value is not allowed
[[nodiscard]] job::MaterialEdit material_edit_from(const std::string& text);

} // namespace heddle::cli
