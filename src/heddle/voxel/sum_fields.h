#pragma once

#include <heddle/base/platform.h>
#include <heddle/voxel/voxel_level.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// The numbers of a lobe's sums, in the order of LobeMoment. Gathering addresses the sums by these
/// numbers, whether they are in a struct or are words on a device.
struct LobeField {
    enum : int {
        Moment = 0, ///< first of xx yy zz xy xz yz
        Weight = 6,
        Count = 7
    };
};
static_assert(offsetof(LobeMoment, weight) == LobeField::Weight * sizeof(std::int64_t));
static_assert(sizeof(LobeMoment) == LobeField::Count * sizeof(std::int64_t));

/// The numbers of a lobe's map sums, in the order of MapSums.
struct MapField {
    enum : int {
        Tangent = 0, ///< first of xx yy zz xy xz yz
        Albedo = 6,  ///< first of red, green, blue
        Roughness = 9,
        Metalness = 10,
        Anisotropy = 11,
        Count = 12
    };
};
static_assert(offsetof(MapSums, albedo) == MapField::Albedo * sizeof(std::int64_t));
static_assert(offsetof(MapSums, roughness) == MapField::Roughness * sizeof(std::int64_t));
static_assert(offsetof(MapSums, metalness) == MapField::Metalness * sizeof(std::int64_t));
static_assert(offsetof(MapSums, anisotropy) == MapField::Anisotropy * sizeof(std::int64_t));
static_assert(sizeof(MapSums) == MapField::Count * sizeof(std::int64_t));

/// Returns a lobe's sum by its number. @tparam Sums  has `moment` and `weight`
template <typename Sums>
[[nodiscard]] HEDDLE_HOST_INLINE std::int64_t& sum_of(Sums& lobe, int field) {
    return field < LobeField::Weight ? lobe.moment[static_cast<std::size_t>(field)] : lobe.weight;
}

/// Returns a map sum by its number.
[[nodiscard]] HEDDLE_HOST_INLINE std::int64_t& map_sum_of(MapSums& maps, int field) {
    switch (field) {
    case MapField::Roughness: return maps.roughness;
    case MapField::Metalness: return maps.metalness;
    case MapField::Anisotropy: return maps.anisotropy;
    default: break;
    }
    const auto i = static_cast<std::size_t>(field);
    return field < MapField::Albedo ? maps.tangent[i] : maps.albedo[i - MapField::Albedo];
}

} // namespace heddle
