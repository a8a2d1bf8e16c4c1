#pragma once

#include <heddle/base/vec.h>

#include <array>
#include <cstdint>
#include <vector>

namespace heddle {

/// Tangent with the sign of the bitangent: bitangent = w cross(normal, tangent) [glTF 2.0, 3.7.2.1]
struct Tangent {
    float x = 1.0f, y = 0.0f, z = 0.0f, w = 1.0f;
};

struct Uv {
    float u = 0.0f, v = 0.0f;
};

/// Triangles of one material in world space; vertex arrays have one length, or are empty.
struct Mesh {
    std::vector<Vec3f> positions;  ///< n, scene units, finite
    std::vector<Vec3f> normals;    ///< n unit vectors; empty: face normals
    std::vector<Tangent> tangents; ///< n; empty unless the material needs them
    std::vector<Uv> uvs;           ///< n; empty: no textures
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices < n, counter-clockwise
    std::uint32_t material = 0;                          ///< index into Geometry::materials
};

} // namespace heddle
