#include <heddle/base/error.h>
#include <heddle/io/mesh/add_parts.h>
#include <heddle/io/mesh/read_mesh.h>

#include <cmath>

namespace heddle {

void set_height_map(Geometry& geometry, Texture height, float scale, float offset) {
    if (height.texels.empty())
        throw Error(ErrorCode::InvalidArgument, "the height map is empty", "give an image");
    if (!std::isfinite(scale) || !std::isfinite(offset))
        throw Error(ErrorCode::InvalidArgument,
                    str("height scale ", scale, " and offset ", offset, " must be finite"));
    for (const Mesh& mesh : geometry.meshes) {
        if (mesh.uvs.empty())
            throw Error(ErrorCode::InvalidArgument,
                        str("'", geometry.name, "' has a mesh without uv, a height map needs them"),
                        "unwrap the mesh in its editor");
    }
    height.srgb = false;
    const std::int32_t index = add_texture(geometry, std::move(height));
    for (Material& material : geometry.materials) {
        if (material.kind != MaterialKind::Surface) continue;
        material.height_map = index;
        material.height_scale = scale;
        material.height_offset = offset;
    }
}

} // namespace heddle
