#pragma once

#include <heddle/cli/terminal/option.h>

namespace heddle::cli {

[[nodiscard]] Command voxelize_command();

} // namespace heddle::cli
