#pragma once

#include <heddle/geom/geometry.h>
#include <heddle/surface/surface_view.h>
#include <heddle/surface/texture_filter.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

/// How the maps of a geometry are read.
enum class MapReading : std::uint8_t {
    Footprint, ///< averaged over footprints; only the maps that a voxel's sums need
    Point      ///< at points, at the finest level; all maps but the height map
};

/// The materials of a geometry with their maps ready to be read. Materials that read a texture in
/// the same way share it. It is immutable and thus thread-safe.
class GeometryMaps {
public:
    /// @param geometry  must outlive this, unchanged
    /// @throws Error    InvalidArgument: a texture with fewer bytes than its size requires, or an
    ///                  index (material, texture) that is out of range
    GeometryMaps(const Geometry& geometry, MapReading reading);

    /// Returns the maps by material number. Valid while this lives.
    [[nodiscard]] const std::vector<SurfaceMaps>& materials() const { return materials_; }
    [[nodiscard]] const SurfaceMaps& of(const Mesh& mesh) const {
        return materials_[mesh.material];
    }
    [[nodiscard]] std::size_t texture_count() const { return stored_.size(); }
    [[nodiscard]] const FilteredTexture& texture(std::size_t i) const {
        return *stored_[i].filtered;
    }
    /// Returns the memory of the averaged levels of the textures, in bytes.
    [[nodiscard]] std::int64_t bytes() const;

private:
    struct Stored {
        std::int32_t texture;
        TexelWeight weight;
        float threshold;
        bool levels;
        std::unique_ptr<FilteredTexture> filtered;
    };
    const TextureView*
    store(std::int32_t texture, TexelWeight weight, float threshold, bool levels);
    SurfaceMaps make_maps(const Material& material, MapReading reading);

    const Geometry& geometry_;
    std::vector<Stored> stored_;
    std::vector<SurfaceMaps> materials_;
};

/// Returns true if the material displaces its surface by a height map, provided that it has one.
[[nodiscard]] inline bool moves_surface(const Material& m) {
    return m.height_scale != 0.0f || m.height_offset != 0.0f;
}

/// Returns a mesh as pointers, of kind Constant and without a height map.
[[nodiscard]] MeshView mesh_view(const Mesh& mesh);

} // namespace heddle
