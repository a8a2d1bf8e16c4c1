#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/io/gltf/gltf_model.h>

#include <map>
#include <tuple>

namespace heddle {

/// The uv source of a material's maps: a TEXCOORD set, then KHR_texture_transform.
struct UvSource {
    int set = 0;
    double offset_u = 0.0, offset_v = 0.0;
    double rotation = 0.0; ///< radians
    double scale_u = 1.0, scale_v = 1.0;

    friend bool operator==(const UvSource&, const UvSource&) = default;
    [[nodiscard]] Uv apply(Uv uv) const;
};

/// Converts glTF materials to heddle's at their first use; each texture is decoded once.
class GltfMaterials {
public:
    struct Used {
        std::uint32_t index = 0; ///< into Geometry::materials
        UvSource uv;
    };

    /// @param model, geometry  must outlive this; `geometry` receives materials, textures and notes
    GltfMaterials(const GltfModel& model, Geometry& geometry)
        : model_(model), geometry_(geometry) {}

    /// @param material  index in the glTF file; -1: glTF's default material
    /// @throws BadFile; Unsupported: more than 256 materials
    Used use(int material);

private:
    Used convert(const tinygltf::Material& from);
    void read_anisotropy(const tinygltf::Value& extension, Material& to);
    void read_specular_glossiness(const tinygltf::Value& extension, Material& to);
    void read_alpha(const tinygltf::Material& from, Material& to);
    std::int32_t map(const tinygltf::Value& info, bool srgb);
    template <typename Info>
    std::int32_t map(const Info& info, bool srgb);
    std::int32_t map(int texture, const UvSource& uv, bool srgb);
    std::int32_t load(int texture, bool srgb);
    std::optional<Texture> image(int index);

    const GltfModel& model_;
    Geometry& geometry_;
    std::map<int, Used> used_;
    std::map<std::pair<int, bool>, std::int32_t> loaded_; ///< by glTF texture and srgb
    std::vector<UvSource> sources_;                       ///< of the maps of the current material
};

} // namespace heddle
