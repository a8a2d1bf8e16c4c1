#pragma once

#include <heddle/base/vec.h>
#include <heddle/cli/terminal/option.h>

#include <optional>
#include <vector>

namespace heddle::cli {

/// Returns the rows that choose the lattice: --voxel-size, --voxels.
[[nodiscard]] std::vector<Option> resolution_rows();

/// Returns the value of --voxel-size; none: it is not given.
[[nodiscard]] std::optional<Vec3d> voxel_size_from(const Arguments& arguments);

} // namespace heddle::cli
