#pragma once

#include <heddle/geom/bounds.h>
#include <heddle/geom/curves.h>
#include <heddle/geom/material.h>
#include <heddle/geom/mesh.h>
#include <heddle/geom/texture.h>
#include <heddle/geom/yarn.h>

#include <string>
#include <vector>

namespace heddle {

/// The contents of a file or the result of a generator: the input of the voxelizer.
struct Geometry {
    std::string name; ///< the object's name, from the file name
    std::vector<CurveSet> curves;
    std::vector<Mesh> meshes;
    std::vector<Material> materials; ///< at most 256: a lobe stores its material in a byte
    std::vector<Texture> textures;
    std::vector<YarnType> yarns;
    /// what the reader assumed, one sentence each, to show to the user
    std::vector<std::string> notes;

    /// The yarn whose centrelines the set's curves are, or null: each curve is one fiber.
    [[nodiscard]] const YarnType* yarn_of(const CurveSet& set) const {
        return set.yarn < 0 ? nullptr : &yarns[static_cast<std::size_t>(set.yarn)];
    }
};

/// The smallest and largest radius of a set's curves, in scene units.
struct CurveRadii {
    float least = 0.0f, most = 0.0f;
};

/// The yarn's own radius if it has one, else the radii of the points.
/// @param yarn  the yarn of the set; null: its curves are fibers
[[nodiscard]] CurveRadii radii_of(const CurveSet& set, const YarnType* yarn);

/// Mean radius of the fibers of a material, over control points; flyaway hairs are not counted.
/// @return  scene units; 0 if no fiber has that material
[[nodiscard]] float mean_fiber_radius(const Geometry& geometry, std::uint32_t material);

} // namespace heddle
