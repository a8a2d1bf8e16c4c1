// Prints, as markdown, the brightness of a volume under one sun relative to its traced geometry, by
// the angle between the sun and the camera.
//
//     heddle_one_light SCENE.toml z|y LEVELS DEPTH ANGLES PATHS
//
// The object of the scene has a volume and geometry. The camera looks along -z, or along y. LEVELS
// and ANGLES are lists with commas. Values are R G B of radiance per covered area.

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/stage/stage.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace heddle::bench {
namespace {

struct Sums {
    Vec3d radiance{};
    double covered = 0.0;
};

struct View {
    Bounds box;
    Vec3d forward, right;
};

std::vector<double> read_list(const std::string& text) {
    std::vector<double> out;
    std::stringstream stream(text);
    for (std::string item; std::getline(stream, item, ',');) out.push_back(std::atof(item.c_str()));
    return out;
}

/// Returns a camera ray through a random point of the middle of the box.
Ray camera_ray(const View& view, std::uint64_t number) {
    StreamRandom random{hash64(99, number)};
    Vec3d at = view.forward * -length(view.box.size());
    for (int a = 0; a < 3; ++a) {
        at[a] += view.box.lo[a] +
                 (0.3 + 0.4 * static_cast<double>(random.uniform())) * view.box.size()[a];
    }
    Ray ray;
    ray.origin = at;
    ray.direction = to_float(view.forward);
    ray.width = 1e-4f;
    return ray;
}

/// The sun is `angle` radians to the right of the camera, and for half of the paths to the left.
Sums trace(PathScene scene, const View& view, const PathOptions& options, double angle, int paths) {
    Sums sum;
    for (const double side : {-1.0, 1.0}) {
        Light sun;
        sun.kind = LightKind::Directional;
        sun.color = {3, 3, 3};
        sun.direction =
            to_float(view.forward * std::cos(angle) - view.right * (side * std::sin(angle)));
        scene.lights = LightSet({sun}, length(view.box.size()));
        const auto add = [](Sums a, const Sums& b) {
            return Sums{a.radiance + b.radiance, a.covered + b.covered};
        };
        const auto map = [&](std::size_t begin, std::size_t end) {
            Sums part;
            for (std::size_t i = begin; i < end; ++i) {
                PathSampler sampler(7, i, side > 0.0 ? 2u : 0u);
                const PathSample path = trace_path(scene, options, camera_ray(view, i), sampler);
                part = add(part, {to_double(path.radiance),
                                  1.0 - static_cast<double>(path.transmittance)});
            }
            return part;
        };
        sum = add(sum, reduce_chunks(static_cast<std::size_t>(paths / 2), 64, Sums{}, map, add));
    }
    return sum;
}

void run(char** argv) {
    Scene scene = read_scene(argv[1]);
    const std::vector<double> levels = read_list(argv[3]), angles = read_list(argv[5]);
    const int paths = std::atoi(argv[6]);
    scene.integrator.level = 0;
    Progress silent;
    Stage volumes(scene, {false}, silent);
    while (volumes.load_next_level()) {
    }
    Stage traced(scene, {true}, silent);
    const bool along_y = argv[2][0] == 'y';
    const View view{volumes.scene().volumes.front().bounds(),
                    along_y ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1},
                    {1, 0, 0}};
    std::printf("| angle | traced |");
    for (const double level : levels) std::printf(" level %.0f |", level);
    std::printf("\n|---|---|");
    for (std::size_t i = 0; i < levels.size(); ++i) std::printf("---|");
    PathOptions options;
    options.max_depth = std::atoi(argv[4]);
    for (const double angle : angles) {
        const double radians = angle * std::numbers::pi / 180.0;
        const Sums truth = trace(traced.scene(), view, options, radians, paths);
        const Vec3d all = truth.radiance * (1.0 / paths);
        std::printf("\n| %.0f | %.4f %.4f %.4f |", angle, all.x, all.y, all.z);
        for (const double level : levels) {
            options.level = static_cast<int>(level);
            const Sums sum = trace(volumes.scene(), view, options, radians, paths);
            const double area = truth.covered / sum.covered;
            std::printf(" %.2f %.2f %.2f |", sum.radiance.x / truth.radiance.x * area,
                        sum.radiance.y / truth.radiance.y * area,
                        sum.radiance.z / truth.radiance.z * area);
        }
        std::fflush(stdout);
    }
    std::printf("\n");
}

} // namespace
} // namespace heddle::bench

int main(int argc, char** argv) {
    if (argc != 7) {
        std::fprintf(stderr, "usage: heddle_one_light SCENE.toml z|y LEVELS DEPTH ANGLES PATHS\n");
        return 2;
    }
    try {
        heddle::bench::run(argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "heddle_one_light: %s\n", e.what());
        return 1;
    }
}
