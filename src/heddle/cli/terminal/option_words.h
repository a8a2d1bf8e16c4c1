#pragma once

#include <string>
#include <vector>

namespace heddle::cli {

/// Text of a library as the command line says it: `voxel_size` in backquotes becomes --voxel-size
/// where `keys` has "voxel-size"; all else stays.
[[nodiscard]] std::string in_option_words(const std::string& text,
                                          const std::vector<std::string>& keys);

} // namespace heddle::cli
