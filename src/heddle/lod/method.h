#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace heddle {

/// How the lobes of up to eight voxels become those of their parent.
enum class LodMethod : std::uint8_t {
    Moments, ///< SGGX-H: the closest second moments merge, which is exact, until K are left
    /// SGGX-H of the paper: closest histograms of samples, re-fitted [Fabre26, 4.4]
    Wasserstein,
    Single,     ///< baseline: one SGGX, re-fitted at every level                     [Fabre26, 4.3]
    Naive,      ///< baseline: the mean direction and the mean coverage
    Random,     ///< baseline: one child's lobe, as Houdini's rasterizer keeps one direction
    Interpolate ///< baseline: one SGGX, linear in S                                  [Heitz15]
};

/// Names in the order of LodMethod, as the command line and files have them.
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
