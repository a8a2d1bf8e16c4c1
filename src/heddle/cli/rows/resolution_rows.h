#pragma once

#include <heddle/base/vec.h>
#include <heddle/cli/terminal/option.h>

#include <optional>
#include <vector>

namespace heddle::cli {

/// The rows that choose the lattice: --voxel-size, --voxels.
[[nodiscard]] std::vector<Option> resolution_rows();

/// What --voxel-size says, where it is given.
[[nodiscard]] std::optional<Vec3d> voxel_size_from(const Arguments& arguments);

} // namespace heddle::cli
