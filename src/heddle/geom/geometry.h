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

/// All that a file or a generator holds: what the voxelizer takes.
struct Geometry {
    std::string name; ///< the object's name, from the file's
    std::vector<CurveSet> curves;
    std::vector<Mesh> meshes;
    std::vector<Material> materials; ///< at most 256: a voxel's lobe names one by a byte
    std::vector<Texture> textures;
    std::vector<YarnType> yarns;
    /// what the reader assumed, one sentence each, for the user to see
    std::vector<std::string> notes;

    /// The yarn that the set's curves are centrelines of, or null: each curve is one fiber.
    [[nodiscard]] const YarnType* yarn_of(const CurveSet& set) const {
        return set.yarn < 0 ? nullptr : &yarns[static_cast<std::size_t>(set.yarn)];
    }
};

/// Least and largest radius of a set's curves, scene units.
struct CurveRadii {
    float least = 0.0f, most = 0.0f;
};

/// The yarn's own radius where it has one, else those of the points.
/// @param yarn  of the set; null: its curves are fibers
[[nodiscard]] CurveRadii radii_of(const CurveSet& set, const YarnType* yarn);

/// Mean radius of the fibers of a material, over control points; flyaway hairs are not counted.
/// @return  scene units; 0 where nothing with that material is a fiber
[[nodiscard]] float mean_fiber_radius(const Geometry& geometry, std::uint32_t material);

} // namespace heddle
