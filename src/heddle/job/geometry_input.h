#pragma once

#include <heddle/geom/geometry.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// How curves or meshes are read and modelled. Nothing is required.
struct GeometryOptions {
    std::optional<std::string>
        yarn{}; ///< preset, or path of a yarn file; none: each curve is one fiber
    std::optional<double> yarn_radius{}; ///< scene units, > 0; none: from the file, else estimated
    std::int32_t repeat_x = 1;           ///< tiles of a .pyp along x, >= 1
    std::int32_t repeat_y = 1;
    std::optional<std::int64_t>
        fibers{}; ///< fibers in a yarn, needs `yarn`; none: those of the yarn file
    std::optional<double>
        fiber_radius{}; ///< with `yarn`: in its model units, else the radius of each
                        ///< curve in scene units; > 0
    std::optional<std::string> height_map{}; ///< path of an image that displaces every mesh
    std::optional<double>
        height_scale{}; ///< displacement by white minus that by black, scene units; none: 1
    std::optional<double> height_offset{}; ///< displacement by black, scene units; none: 0
};

/// Curves or meshes, in a file or in memory.
struct GeometryInput {
    std::string path{};                 ///< .bcc .hair .data .pyp .obj .ply .gltf .glb
    std::optional<Geometry> geometry{}; ///< is used instead of the file
    GeometryOptions options{};
};

/// Returns the names of the built-in yarns, which GeometryOptions::yarn accepts.
[[nodiscard]] std::vector<std::string> yarn_preset_names();

/// Checks that the options can be used together and are in range.
/// @throws OptionError  they cannot, or are not
void check_geometry_options(const GeometryOptions& options);

/// Loads the geometry and applies the yarn, radii and height map of the options. The notes of the
/// result say what was assumed.
/// @throws OptionError  as check_geometry_options; an option does not apply to this geometry
/// @throws Error        as read_geometry, read_yarn, set_fiber_count, read_image, set_height_map
[[nodiscard]] Geometry load_geometry(GeometryInput input);

} // namespace heddle::job
