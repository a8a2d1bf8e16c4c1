#pragma once

#include <heddle/geom/geometry.h>

#include <tiny_obj_loader.h>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace heddle {

/// Converts .mtl materials to heddle's; an image that several of them use is loaded once.
class ObjMaterials {
public:
    /// @param folder    image names are relative to it
    /// @param geometry  receives textures and notes; must outlive this
    ObjMaterials(std::filesystem::path folder, Geometry& geometry)
        : folder_(std::move(folder)), geometry_(geometry) {}

    /// Reads Kd, d, Pr or Ns, Pm, aniso, anisor, map_Kd, map_d and norm, or a bump map that is a
    /// normal map; notes which other maps are ignored.
    [[nodiscard]] Material convert(const tinyobj::material_t& from);

private:
    std::int32_t load(const std::string& name, bool srgb, bool clamp);
    std::int32_t normal_map(const tinyobj::material_t& from);
    std::int32_t albedo_with_alpha(std::int32_t albedo, const tinyobj::material_t& from);

    std::filesystem::path folder_;
    Geometry& geometry_;
    std::map<std::pair<std::string, bool>, std::int32_t> loaded_; ///< by name and srgb
};

} // namespace heddle
