#pragma once

#include <string>
#include <vector>

namespace heddle::cli {

/// Returns a text of a library in the words of the command line: `voxel_size` in backquotes becomes
/// --voxel-size if `keys` has "voxel-size". Everything else stays as it is.
[[nodiscard]] std::string in_option_words(const std::string& text,
                                          const std::vector<std::string>& keys);

} // namespace heddle::cli
