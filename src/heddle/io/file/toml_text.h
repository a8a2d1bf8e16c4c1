#pragma once

#include <heddle/io/file/problems.h>

#define TOML_HEADER_ONLY 0 // toml_text.cpp compiles the parser, once for all
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

namespace heddle {

/// Parses TOML; its errors are added to `problems`. The text is checked before toml++ 3.3 reads it,
/// which relies on three things without checking them (its assertions end the program, or mislead
/// the optimizer): a name after a header's bracket, no '}' in an array, no unusual white space. It
/// also cannot report where a table that is defined twice was first. All four are problems here.
/// @return  nothing if there is a problem
[[nodiscard]] std::optional<toml::table>
parse_toml(std::string_view text, const std::string& path, Problems& problems);

} // namespace heddle
