#include <heddle/io/vdb/grid_name.h>

#include <array>
#include <cstddef>

namespace heddle {

std::string grid_name(GridKind kind, int lobe, int level) {
    static constexpr std::array<const char*, 8> kStems{"density", "tangentu", "normal",  "coverage",
                                                       "lobe",    "albedo",   "surface", "aniso"};
    std::string name = kStems[static_cast<std::size_t>(kind)];
    if (is_per_lobe(kind)) name += "_" + std::to_string(lobe);
    if (level > 0) name += "_level_" + std::to_string(level);
    return name;
}

} // namespace heddle
