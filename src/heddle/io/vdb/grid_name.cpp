#include <heddle/io/vdb/grid_name.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>

namespace heddle {
namespace {

constexpr std::string_view kLevelMark = "_level_";

} // namespace

std::string grid_name(GridKind kind, int index, int level, int part) {
    static constexpr auto kStems =
        std::to_array<const char*>({"density", "tangentu", "normal", "coverage", "columns",
                                    "footprint", "footprint", "occupancy", "correlation", "slab",
                                    "merge", "lobe", "albedo", "surface", "aniso", "sums"});
    std::string name = kStems[static_cast<std::size_t>(kind)];
    if (kind == GridKind::Columns || kind == GridKind::FootprintAxis) {
        name += std::string("_") + "xyz"[index];
    }
    if (kind >= GridKind::Lobe) name += "_" + std::to_string(index);
    if (kind == GridKind::Sums) name += "_" + std::to_string(part);
    if (level > 0) name.append(kLevelMark).append(std::to_string(level));
    return name;
}

GridStem split_grid_name(const std::string& name) {
    const std::size_t at = name.rfind(kLevelMark);
    if (at == std::string::npos) return {name, 0};
    const std::string_view digits = std::string_view(name).substr(at + kLevelMark.size());
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) {
        return {name, 0};
    }
    int level = 0;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), level);
    const bool plain = result.ec == std::errc{} && digits.front() != '0';
    return {name.substr(0, at), plain ? level : -1};
}

} // namespace heddle
