#pragma once

#include <heddle/scene/problems.h>

#include <string>
#include <string_view>

namespace heddle::scene_form {

/// Looks over a scene file before toml++ 3.3 reads it. That takes three things for granted without
/// checking them (its assertions end the program, or tell an optimizer what is not so): a name after
/// a header's bracket, no '}' in an array, no exotic blanks. It also cannot say where a table that
/// is given twice was first. All four are problems here.
/// @return  false where there is a problem: toml++ must not, or will not, read the text
[[nodiscard]] bool
check_toml_text(std::string_view text, const std::string& path, Problems& problems);

} // namespace heddle::scene_form
