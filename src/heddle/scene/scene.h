#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/affine.h>
#include <heddle/geom/generate.h>
#include <heddle/scatter/scatterer.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heddle {

/// A light of a scene. Colours are linear RGB.
struct SceneLight {
    enum class Kind : std::uint8_t { Constant, Environment, Directional, Point, Area };
    Kind kind = Kind::Constant;
    Vec3f color{1, 1, 1};  ///< radiance (constant, area), perpendicular irradiance (directional),
                           ///< intensity (point); multiplies an environment's texels
    std::string image;     ///< environment: path of an .exr, .png or .jpg, width twice its height
    double turn_deg = 0.0; ///< environment: rotation about the up axis
    Vec3d direction{0, 0, -1}; ///< directional: the direction in which light travels; unit
    Vec3d position;            ///< point; area: a corner
    Vec3d edge_u{1, 0, 0};     ///< area: a parallelogram, lit on the side of cross(edge_u, edge_v)
    Vec3d edge_v{0, 1, 0};
};

struct SceneCamera {
    enum class Kind : std::uint8_t { Perspective, Orthographic };
    Kind kind = Kind::Perspective;
    Vec3d eye{0, 0, 10};
    Vec3d target{};
    Vec3d up{0, 1, 0};
    double view_angle_deg = 35.0; ///< perspective: vertical field of view of the picture
    double view_height = 1.0;     ///< orthographic: height of the picture, scene units
    double lens_radius = 0.0;     ///< 0: pinhole, everything is in focus
    double focus_distance = 0.0;  ///< 0: the distance of the target
};

struct SceneIntegrator {
    std::int64_t samples = 64; ///< per pixel
    int max_depth = 64;        ///< most scattering events of a path
    int roulette_depth = 5;    ///< scattering events before Russian roulette
    std::uint64_t seed = 0;
    int level = -1;        ///< level of detail of all objects; -1: chosen by footprint
    std::string transport; ///< empty: the default
};

/// The parts of an object: a volume, explicit geometry, or both. With both the volume is rendered,
/// and the geometry if the traced reference is asked for.
struct SceneObject {
    std::string name;
    std::string volume;                      ///< path of a .vdb; may be empty
    std::string geometry;                    ///< path of curves or a mesh; may be empty
    std::optional<GenerateOptions> generate; ///< instead of `geometry`
    std::string yarn;         ///< preset, or path of a yarn file; empty: each curve is one fiber
    double yarn_radius = 0.0; ///< 0: as in the file
    std::int64_t fibers = 0;  ///< per yarn; 0: as in the model
    double fiber_radius = 0.0;
    std::vector<Affine> instances; ///< object to world; at least one
    /// material of the input -> material of the scene; "*": all others
    std::map<std::string, std::string> materials;
};

/// A whole scene as its files describe it: paths are resolved, nothing is loaded.
struct Scene {
    std::vector<SceneObject> objects; ///< those of included files first, then by name per file
    std::map<std::string, ScatterMaterial> materials; ///< by name
    std::vector<SceneLight> lights;
    std::optional<SceneCamera> camera; ///< none: chosen to frame the scene
    std::int32_t width = 512;          ///< px
    std::int32_t height = 512;         ///< px
    SceneIntegrator integrator;
};

/// Reads a scene file (docs/scene.md).
///
/// Every problem of the file and of the files that it includes is reported at once, except for
/// those after a TOML syntax error in the same file. Only scene files are opened; of other files
/// only the existence is checked. The renderer checks whether it knows the transport.
/// @throws Error  NotFound: no such file; BadFile: all problems, one per line (separated by '\n'),
///                each "path:line: what; what to do"
[[nodiscard]] Scene read_scene(const std::string& path);

} // namespace heddle
