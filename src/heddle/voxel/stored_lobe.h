#pragma once

#include <heddle/base/platform.h>
#include <heddle/sggx/moment_lobes.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>

namespace heddle {

// What is stored of a lobe, computed from its sums by the same code on the CPU and on executors.

/// Returns the packed SGGX whose second moment is the mean of the pooled one.
/// @param moment  6 sums, laid out as DirectionSums::moment
/// @param weight  > 0
[[nodiscard]] HEDDLE_HD inline PackedSggx fit_packed(const std::int64_t* moment,
                                                     std::int64_t weight) {
    return pack(fit_sggx(detail::mean_moment(moment, weight)));
}

/// Returns a lobe's share of its voxel, as in Lobe::weight.
/// @param total  weight of all lobes of the voxel
[[nodiscard]] HEDDLE_HD inline std::uint8_t share_of(std::int64_t weight, std::int64_t total) {
    const double share = static_cast<double>(weight) / static_cast<double>(total);
    const int steps = static_cast<int>(share * 255.0 + 0.5);
    return static_cast<std::uint8_t>(steps > 1 ? steps : 1);
}

namespace detail {

[[nodiscard]] HEDDLE_HD inline std::uint8_t mean8(std::int64_t sum, std::int64_t weight) {
    const std::int64_t mean = (sum + weight / 2) / weight;
    return static_cast<std::uint8_t>(mean < 0 ? 0 : mean > 255 ? 255 : mean);
}

} // namespace detail

/// Returns the means of a lobe's map values.
/// @param weight  weight of the lobe, > 0
[[nodiscard]] HEDDLE_HD inline LobeMaps mean_maps(const MapSums& sums, std::int64_t weight) {
    LobeMaps mean;
    for (std::size_t i = 0; i < 3; ++i) mean.albedo[i] = detail::mean8(sums.albedo[i], weight);
    mean.roughness = detail::mean8(sums.roughness, weight);
    mean.metalness = detail::mean8(sums.metalness, weight);
    mean.anisotropy = detail::mean8(sums.anisotropy, weight);
    return mean;
}

/// Returns the packed SGGX of a lobe's tangents; all zero if the surface has none.
[[nodiscard]] HEDDLE_HD inline PackedSggx fit_tangents(const MapSums& sums) {
    std::int64_t moment[6];
    for (std::size_t i = 0; i < 6; ++i) moment[i] = sums.tangent[i];
    const std::int64_t trace = moment[0] + moment[1] + moment[2];
    return trace > 0 ? fit_packed(moment, trace) : PackedSggx{};
}

} // namespace heddle
