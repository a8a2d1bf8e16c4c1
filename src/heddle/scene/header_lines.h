#pragma once

#include <heddle/scene/problems.h>

#include <string>
#include <string_view>

namespace heddle::scene_form {

/// Checks the lines of a scene file that begin with '[' before toml++ sees them: a table given
/// twice is a problem that says where the first was, and so is a bracket that no name follows:
/// toml++ 3.3 assumes without checking that one does, "[[[" is undefined behaviour there.
/// @return  false where there is a problem: toml++ must not, or will not, read the text
[[nodiscard]] bool
check_header_lines(std::string_view text, const std::string& path, Problems& problems);

} // namespace heddle::scene_form
