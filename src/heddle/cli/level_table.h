#pragma once

#include <heddle/cli/terminal/report.h>
#include <heddle/job/level/measure_levels.h>

#include <string>

namespace heddle::cli {

/// Two tables and the sentences that they need.
[[nodiscard]] std::string markdown_of(const job::LevelTable& table);

/// The same numbers under keys, in JSON alone.
void add_json(const job::LevelTable& table, Report& report);

} // namespace heddle::cli
