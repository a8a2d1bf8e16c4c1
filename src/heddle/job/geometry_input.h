#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How curves or meshes are read, and what becomes of them. Nothing is required.
struct GeometryOptions {
    std::optional<std::string>
        yarn{}; ///< preset, or path of a yarn file; none: a curve is one fiber
    std::optional<double> yarn_radius{}; ///< scene units, > 0; none: from the file, or a guess
    std::int32_t repeat_x = 1;           ///< tiles of a .pyp along x, >= 1
    std::int32_t repeat_y = 1;
    std::optional<std::int64_t>
        fibers{}; ///< in all of a yarn, needs `yarn`; none: as the model has
    std::optional<double>
        fiber_radius{}; ///< of the yarn model, > 0; without `yarn`: of each curve,
                        ///< in scene units
    std::optional<std::string> height_map{}; ///< path of an image that displaces every mesh
    std::optional<double> height_scale{};    ///< displacement of white, scene units; none: 1
    std::optional<double> height_offset{};   ///< displacement of black, scene units; none: 0
};

/// Curves or meshes: of a file, or in memory.
struct GeometryInput {
    std::string path{};                 ///< .bcc .hair .data .pyp .obj .ply .gltf .glb
    std::optional<Geometry> geometry{}; ///< is taken in place of the file
    GeometryOptions options{};
};

/// Names of the built-in yarns, which GeometryOptions::yarn takes.
[[nodiscard]] std::vector<std::string> yarn_preset_names();

/// @throws OptionError  options that do not go together
void check_geometry_options(const GeometryOptions& options);

/// What the input says, with the yarn, radii and height map that are asked for; what was assumed
/// is in its notes.
/// @throws OptionError  as check_geometry_options; an option that this geometry has no use for
/// @throws Error        as read_geometry, read_yarn, set_fiber_count, read_image, set_height_map
[[nodiscard]] Geometry load_geometry(GeometryInput input);

} // namespace heddle::job
