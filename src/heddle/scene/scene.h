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
    Vec3f color{1, 1, 1};  ///< radiance (constant, area), irradiance at right angles (directional),
                           ///< intensity (point); multiplies an environment's texels
    std::string image;     ///< environment: path of an .exr, .png or .jpg, width twice its height
    double turn_deg = 0.0; ///< environment: about the up axis
    Vec3d direction{0, 0, -1}; ///< directional: the way light travels; unit
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
    double view_angle_deg = 35.0; ///< perspective: across the picture's height
    double view_height = 1.0;     ///< orthographic: the picture's height, scene units
    double lens_radius = 0.0;     ///< 0: everything is sharp
    double focus_distance = 0.0;  ///< 0: the target's
};

struct SceneIntegrator {
    std::int64_t samples = 64; ///< per pixel
    int max_depth = 64;        ///< scattering events of a path
    int roulette_depth = 5;    ///< events before Russian roulette
    std::uint64_t seed = 0;
    int level = -1;        ///< of detail everywhere; -1: by footprint
    std::string transport; ///< empty: the default
};

/// What an object is made of: a volume, explicit geometry, or both: then the volume is rendered, and
/// the geometry where the traced reference is asked for.
struct SceneObject {
    std::string name;
    std::string volume;                      ///< path of a .vdb; may be empty
    std::string geometry;                    ///< path of curves or a mesh; may be empty
    std::optional<GenerateOptions> generate; ///< instead of `geometry`
    std::string yarn;         ///< preset, or path of a yarn file; empty: each curve is one fiber
    double yarn_radius = 0.0; ///< 0: what the file says
    std::int64_t fibers = 0;  ///< per yarn; 0: what the model says
    double fiber_radius = 0.0;
    std::vector<Affine> instances; ///< object to world; one at least
    /// material of the input -> of the scene; "*": all
    std::map<std::string, std::string> materials;
};

/// A whole scene, as a file describes it: paths resolved, nothing loaded.
struct Scene {
    std::vector<SceneObject> objects;                 ///< what is included first; a file's by name
    std::map<std::string, ScatterMaterial> materials; ///< by name
    std::vector<SceneLight> lights;
    std::optional<SceneCamera> camera; ///< none: framed
    std::int32_t width = 512;          ///< px
    std::int32_t height = 512;         ///< px
    SceneIntegrator integrator;
};

/// Reads a scene file (docs/scene.md).
///
/// Every problem of the file and of what it includes is found before it throws, but what follows a
/// line that is no TOML in its file. Nothing but scene files is opened; that the others are there is
/// checked. Whether a transport of that name exists the renderer says.
/// @throws Error  NotFound: no such file; BadFile: all problems, one a line ('\n' between them), each
///                "path:line: what; what to do"
[[nodiscard]] Scene read_scene(const std::string& path);

} // namespace heddle
