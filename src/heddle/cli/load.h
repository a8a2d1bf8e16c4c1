#pragma once

#include <heddle/cli/terminal/option.h>
#include <heddle/geom/geometry.h>

#include <functional>
#include <string>
#include <vector>

namespace heddle::cli {

/// The rows that say how a file is read: --yarn-radius, --repeat.
[[nodiscard]] std::vector<Option> load_options();

/// The rows that say what becomes of what was read: --yarn, --fibers, --fiber-radius, --height-map...
[[nodiscard]] std::vector<Option> model_options();

/// Reads curves or meshes: the reader is chosen by the suffix. Notes are in the result.
/// @param arguments  with the rows of load_options()
/// @throws Error  as the readers; Unsupported: no reader for the suffix
[[nodiscard]] Geometry load_geometry(const std::string& path, const Arguments& arguments);

/// Gives the geometry the yarn, fiber radius and height map that were asked for.
/// @param arguments  with the rows of load_options() and model_options()
/// @throws Error       as read_yarn and read_image
/// @throws UsageError  an option that this geometry, or the model, has no use for
void apply_model(Geometry& geometry, const Arguments& arguments);

/// Throws unless a file can be put at `path`: asked before long work, not after it.
/// @param suffix  that the path must end in
/// @param option  that gave the path
/// @throws UsageError  another suffix
/// @throws Error       CannotWrite: a folder, a device, a place without permission
void check_output(const std::string& path,
                  const std::string& suffix,
                  const std::string& option = "--output");

/// Runs `write`, and makes of what it throws for a bad place or a full disk an Error{CannotWrite}.
void write_output(const std::function<void()>& write);

} // namespace heddle::cli
