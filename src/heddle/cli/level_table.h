#pragma once

#include <heddle/cli/terminal/report.h>
#include <heddle/job/level/measure_levels.h>

#include <string>

namespace heddle::cli {

/// Returns two tables in Markdown with the sentences that explain them.
[[nodiscard]] std::string markdown_of(const job::LevelTable& table);

/// Adds the same numbers to the JSON of a report.
void add_json(const job::LevelTable& table, Report& report);

} // namespace heddle::cli
