#pragma once

#include <span>
#include <string_view>

namespace heddle {

/// A built-in yarn: one of the files in presets/, which the build embeds in the library.
struct YarnPreset {
    std::string_view name; ///< the file's stem
    std::string_view toml;
};

/// All built-in yarns, ascending by name.
[[nodiscard]] std::span<const YarnPreset> yarn_presets();

} // namespace heddle
