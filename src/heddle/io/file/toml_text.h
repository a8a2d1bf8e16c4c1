#pragma once

#include <heddle/io/file/problems.h>

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

namespace heddle {

/// Parses TOML; what is wrong with it is added to `problems`. The text is looked over before toml++
/// 3.3 reads it. That takes three things for granted without checking them (its assertions end the
/// program, or tell an optimizer what is not so): a name after a header's bracket, no '}' in an
/// array, no exotic blanks. It also cannot say where a table that is given twice was first. All four
/// are problems here.
/// @return  nothing where there is a problem
[[nodiscard]] std::optional<toml::table>
parse_toml(std::string_view text, const std::string& path, Problems& problems);

} // namespace heddle
