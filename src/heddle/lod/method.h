#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace heddle {

/// How the lobes of up to eight voxels are merged into those of their parent.
enum class LodMethod : std::uint8_t {
    Moments,     ///< SGGX-H: merges the closest second moments, exactly, until K are left
    Wasserstein, ///< SGGX-H of the paper: merges closest sampled histograms   [Fabre26, 4.4]
    Single,      ///< baseline: one SGGX, re-fitted at every level             [Fabre26, 4.3]
    Naive,       ///< baseline: the mean direction and the mean coverage
    Random,      ///< baseline: the lobe of one child, like Houdini's rasterizer
    Interpolate  ///< baseline: one SGGX, the mean of the children's matrices S  [Heitz15]
};

/// The names on the command line and in files, in the order of LodMethod.
inline constexpr std::array<const char*, 6> kLodMethodNames{
    "moments", "wasserstein", "single", "naive", "random", "interpolate"};

[[nodiscard]] constexpr const char* name_of(LodMethod method) {
    return kLodMethodNames[static_cast<std::size_t>(method)];
}
[[nodiscard]] constexpr std::optional<LodMethod> lod_method_of(std::string_view name) {
    for (std::size_t i = 0; i < kLodMethodNames.size(); ++i) {
        if (name == kLodMethodNames[i]) return static_cast<LodMethod>(i);
    }
    return std::nullopt;
}

} // namespace heddle
