// Prints, as markdown, the error of each transport's transmittance against traced geometry, over
// views and levels.
//
//     heddle_transport SCENE.toml [LEVELS]
//
// The objects of the scene have a volume and geometry. A pixel is as wide as the level's voxels and
// has 64 parallel rays. Pixels are at random in the middle half of the object, and count if the
// object is in either picture.

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/stage/stage.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace heddle::bench {
namespace {

constexpr std::size_t kPixels = 240; ///< of a view, over all its directions
constexpr int kRays = 8;             ///< per axis of a pixel

struct View {
    const char* name;
    std::vector<Vec3d> directions;
};

/// @param tilt  from z
Vec3d tilted(double tilt, double turn) {
    return {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
}

/// Along the axes, and 10 to 25, 30 to 70, and 80 degrees from z.
std::vector<View> make_views() {
    std::vector<View> views{{"x", {{1, 0, 0}}}, {"y", {{0, 1, 0}}}, {"z", {{0, 0, 1}}}};
    StreamRandom random{5};
    const auto add = [&](const char* name, double from, double to) {
        View& view = views.emplace_back(View{name, {}});
        for (int i = 0; i < 6; ++i) {
            const double tilt = (from + (to - from) * (i + 0.5) / 6) * std::numbers::pi / 180.0;
            view.directions.push_back(
                tilted(tilt, 2.0 * std::numbers::pi * static_cast<double>(random.uniform())));
        }
    };
    add("10-25", 10, 25);
    add("30-70", 30, 70);
    add("80", 80, 80);
    return views;
}

struct Sums {
    double bias = 0.0, error = 0.0, seconds = 0.0;
};

/// Sums over the touched pixels of one view and level.
struct Comparison {
    std::vector<Sums> of; ///< by transport
    double truth = 0.0;
    std::int64_t pixels = 0;
};

class Comparer {
public:
    Comparer(const PathScene& volumes, const SurfaceScene& truth, std::vector<Transport> transports)
        : volumes_(volumes), truth_(truth), transports_(std::move(transports)) {}

    void add_view(Vec3d toward, int level, std::size_t n, Comparison& sum) const {
        const VolumeInstance& volume = volumes_.volumes.front();
        const Bounds box = volume.bounds();
        const double pixel = std::ldexp(volume.voxel_size(), level);
        const Vec3d forward = normalize(toward);
        const Vec3d right = to_double(any_perpendicular(to_float(forward)));
        const Vec3d down = cross(forward, right);
        const double reach = length(box.size());
        std::vector<std::vector<double>> passed(transports_.size() + 1, std::vector<double>(n));
        std::vector<std::vector<double>> seconds(transports_.size(), std::vector<double>(n));
        parallel_chunks(n, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                StreamRandom random{hash64(static_cast<std::uint64_t>(level), i)};
                Vec3d eye = forward * -reach;
                for (int a = 0; a < 3; ++a) {
                    eye[a] += box.lo[a] +
                              (0.25 + 0.5 * static_cast<double>(random.uniform())) * box.size()[a];
                }
                for (int k = 0; k < kRays * kRays; ++k) {
                    const auto place = [&](int part) {
                        return (part + static_cast<double>(random.uniform())) / kRays * pixel;
                    };
                    Ray ray;
                    ray.origin = eye + right * place(k % kRays) + down * place(k / kRays);
                    ray.direction = to_float(forward);
                    ray.t_max = static_cast<float>(2.0 * reach);
                    passed.back()[i] += truth_.occluded(ray) ? 0.0 : 1.0;
                    for (std::size_t t = 0; t < transports_.size(); ++t) {
                        const auto start = std::chrono::steady_clock::now();
                        passed[t][i] += static_cast<double>(
                            volume.transmittance(ray, transports_[t], {level, 0.0f, 0.0f}, random));
                        const auto took = std::chrono::steady_clock::now() - start;
                        seconds[t][i] += std::chrono::duration<double>(took).count();
                    }
                }
            }
        });
        for (std::size_t i = 0; i < n; ++i) {
            bool touched = false;
            for (const auto& of : passed) touched |= of[i] < 0.9999 * kRays * kRays;
            if (!touched) continue;
            constexpr double kShare = 1.0 / (kRays * kRays);
            ++sum.pixels;
            sum.truth += passed.back()[i] * kShare;
            for (std::size_t t = 0; t < transports_.size(); ++t) {
                const double error = (passed[t][i] - passed.back()[i]) * kShare;
                sum.of[t].bias += error;
                sum.of[t].error += std::fabs(error);
                sum.of[t].seconds += seconds[t][i] * kShare;
            }
        }
    }

private:
    const PathScene& volumes_;
    const SurfaceScene& truth_;
    std::vector<Transport> transports_;
};

void run(const std::string& path, int levels) {
    Scene scene = read_scene(path);
    scene.integrator.level = 0;
    Progress silent;
    Stage volumes(scene, {false}, silent);
    while (volumes.load_next_level()) {
    }
    Stage traced(scene, {true}, silent);
    if (volumes.scene().volumes.empty() || !traced.scene().surfaces) {
        throw Error(ErrorCode::BadFile, "needs an object with a volume and geometry", "",
                    {.path = path});
    }
    const std::vector<Transport> transports{Transport::Product, Transport::Cells};
    const Comparer comparer(volumes.scene(), *traced.scene().surfaces, transports);
    std::printf("| level | view | truth | product | cells | ns a ray |\n"
                "|---|---|---|---|---|---|\n");
    const int last = static_cast<int>(volumes.scene().volumes.front().pyramid().size()) - 1;
    for (int level = 0; level <= std::min(levels - 1, last); ++level) {
        for (const View& view : make_views()) {
            Comparison sum{std::vector<Sums>(transports.size()), 0.0, 0};
            for (const Vec3d& d : view.directions)
                comparer.add_view(d, level, kPixels / view.directions.size(), sum);
            const double n = static_cast<double>(std::max<std::int64_t>(sum.pixels, 1));
            std::printf("| %d | %s | %.3f |", level, view.name, sum.truth / n);
            for (const Sums& s : sum.of) std::printf(" %+.3f / %.3f |", s.bias / n, s.error / n);
            for (const Sums& s : sum.of) std::printf(" %.0f", 1e9 * s.seconds / n);
            std::printf(" |\n");
        }
    }
}

} // namespace
} // namespace heddle::bench

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: heddle_transport SCENE.toml [LEVELS]\n");
        return 2;
    }
    try {
        heddle::bench::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 5);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "heddle_transport: %s\n", e.what());
        return 1;
    }
}
