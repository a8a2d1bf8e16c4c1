#pragma once

#include <cstddef>
#include <cstdint>

namespace heddle {

// The versions of docs/format.md
inline constexpr std::int32_t kPlainFormat = 2;
inline constexpr std::int32_t kPlacedFormat = 3; ///< voxels know where in them matter is

inline constexpr std::size_t kMaxLevels = 28; ///< 8 x 2^27 subvoxels still fit an int32

// File-level metadata keys
inline constexpr const char* kFormatKey = "heddle_format";       ///< int32
inline constexpr const char* kLevelsKey = "heddle_levels";       ///< int32
inline constexpr const char* kInfoKey = "heddle_info";           ///< string, JSON object
inline constexpr const char* kMaterialsKey = "heddle_materials"; ///< string, JSON array
inline constexpr const char* kYarnsKey = "heddle_yarns";         ///< string, JSON array

} // namespace heddle
