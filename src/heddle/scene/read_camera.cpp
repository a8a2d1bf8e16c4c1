#include <heddle/scene/scene_parts.h>

#include <heddle/base/error.h>

#include <limits>

namespace heddle::scene_form {
namespace {

constexpr std::int64_t kMaxSide = 1 << 16;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28; // the largest .exr that is read

/// The sine of the angle below which two directions count as parallel.
constexpr double kParallel = 1e-6;

void check_axes(const TableReader& reader, const SceneCamera& camera) {
    const Vec3d view = camera.target - camera.eye;
    const double distance = length(view);
    if (!(distance > 0.0)) {
        reader.problem(reader.has("target") ? "target" : "eye", "'eye' and 'target' are one point",
                       "move one of them");
        return;
    }
    const double tall = length(camera.up);
    if (!(length(cross(view, camera.up)) > kParallel * distance * tall)) {
        reader.problem(reader.has("up") ? "up" : "eye",
                       tall > 0.0 ? "'up' is parallel to the view" : "'up' has no length",
                       "choose another, such as [0, 1, 0] or [0, 0, 1]");
    }
}

} // namespace

SceneCamera read_camera(TableReader& reader) {
    SceneCamera camera;
    const std::optional<std::size_t> kind = reader.choose("kind", {"perspective", "orthographic"});
    if (kind == std::size_t{1}) camera.kind = SceneCamera::Kind::Orthographic;
    reader.vector("eye", camera.eye);
    reader.vector("target", camera.target);
    reader.vector("up", camera.up);
    if (camera.kind == SceneCamera::Kind::Perspective) {
        reader.number("view_angle", camera.view_angle_deg,
                      {.least = 0.0, .most = 179.0, .above = true, .below = true});
        reader.number("lens_radius", camera.lens_radius, kNotNegative);
        reader.number("focus_distance", camera.focus_distance, kNotNegative);
    } else {
        reader.number("view_height", camera.view_height, kPositive);
    }
    check_axes(reader, camera);
    reader.finish();
    return camera;
}

void read_film(TableReader& reader, Scene& scene) {
    const auto size =
        reader.numbers("size", {2}, {.least = 1.0, .most = static_cast<double>(kMaxSide)});
    if (size) {
        const auto width = static_cast<std::int64_t>((*size)[0]);
        const auto height = static_cast<std::int64_t>((*size)[1]);
        if (static_cast<double>(width) != (*size)[0] || static_cast<double>(height) != (*size)[1]) {
            reader.problem("size", "'size' holds a fraction of a pixel", "write whole numbers");
        } else if (width * height > kMaxPixels) {
            reader.problem("size",
                           str("'size' is ", width, " x ", height, " px, the limit is 2^28 px"),
                           "make it smaller");
        }
        scene.width = static_cast<std::int32_t>(width);
        scene.height = static_cast<std::int32_t>(height);
    }
    reader.finish();
}

SceneIntegrator read_integrator(TableReader& reader) {
    SceneIntegrator integrator;
    reader.integer("samples", integrator.samples, 1, 1 << 30);
    reader.integer("max_depth", integrator.max_depth, 1, 1 << 20);
    reader.integer("roulette_depth", integrator.roulette_depth, 0, 1 << 20);
    std::int64_t seed = 0;
    reader.integer("seed", seed, 0, std::numeric_limits<std::int64_t>::max());
    integrator.seed = static_cast<std::uint64_t>(seed);
    reader.integer("level", integrator.level, -1, 40);
    reader.text("transport", integrator.transport);
    reader.finish();
    return integrator;
}

} // namespace heddle::scene_form
