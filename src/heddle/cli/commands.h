#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/cli/voxelize/voxelize.h>

#include <vector>

namespace heddle::cli {

[[nodiscard]] Command info_command();
[[nodiscard]] Command generate_command();
[[nodiscard]] Command slice_command();
[[nodiscard]] Command lod_command();
[[nodiscard]] Command lod_report_command();
[[nodiscard]] Command material_command();
[[nodiscard]] Command preview_command();
[[nodiscard]] Command render_command();
[[nodiscard]] Command export_command();
[[nodiscard]] Command view_command();

/// Returns all subcommands, in the order in which a new user needs them.
[[nodiscard]] inline const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        info_command(),   generate_command(),   slice_command(),    voxelize_command(),
        lod_command(),    lod_report_command(), material_command(), preview_command(),
        render_command(), view_command(),       export_command()};
    return all;
}

} // namespace heddle::cli
