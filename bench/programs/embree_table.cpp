// Traced yarns: bytes per segment, build rate, rays per second of one thread.
//   heddle_embree_table FILE.bcc YARN [fibers] [yarn radius] [curves of the file] [GiB] [smooth]
#include <heddle/base/memory.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/yarn/yarn_file.h>
#include <heddle/render/embree/embree_scene.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace heddle {
namespace {

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Counts the expanded segments and records when each phase began.
class Stages final : public Progress {
public:
    void begin(std::string_view stage, std::string_view, std::int64_t total) override {
        if (stage == "fibers") segments += total;
        if (stage == "tree") tree = now();
        if (stage == "tree") segments = total;
    }
    std::int64_t segments = 0;
    double tree = 0.0;
};

Geometry load(int argc, char** argv) {
    CurveReadOptions read;
    if (argc > 4) read.radius = std::strtof(argv[4], nullptr);
    Geometry geometry = read_bcc(argv[1], read);
    CurveSet& set = geometry.curves[0];
    const std::size_t curves = argc > 5 ? std::strtoul(argv[5], nullptr, 10) : 0;
    if (curves > 0 && curves < set.curve_count()) {
        set.first.resize(curves + 1);
        set.points.resize(set.first.back());
        if (!set.closed.empty()) set.closed.resize(curves);
    }
    YarnFile yarn = read_yarn(argv[2]);
    if (argc > 3 && std::atoi(argv[3]) > 0) set_fiber_count(yarn.yarn, std::atoi(argv[3]));
    if (argc > 7) yarn.yarn.flyaways = false;
    geometry.yarns.push_back(yarn.yarn);
    set.yarn = 0;
    return geometry;
}

/// Shoots rays through the object's box: parallel to z in pixel order, or from random points in it.
void shoot(const SurfaceScene& scene, const Bounds& box, bool inside) {
    StreamRandom random{1};
    constexpr int kRays = 1000000;
    int hits = 0;
    const Vec3d size = box.size();
    const double begin = now();
    for (int i = 0; i < kRays; ++i) {
        const Vec3d u{random.uniform(), random.uniform(), random.uniform()};
        Ray ray;
        ray.origin = box.lo + u * size;
        ray.direction = {0, 0, -1};
        if (inside) {
            const Vec3f d{random.uniform() - 0.5f, random.uniform() - 0.5f,
                          random.uniform() - 0.5f};
            ray.direction = normalize(d);
        } else {
            const Vec3d pixel{i % 1000 / 1e3, i / 1000 / 1e3, 2.0};
            ray.origin = box.lo + (pixel + u * Vec3d{1e-3, 1e-3, 0.0}) * size;
        }
        TracedHit hit;
        hits += scene.intersect(ray, hit) ? 1 : 0;
    }
    const double seconds = now() - begin;
    std::printf("%s: %.3f M rays/s, %.1f %% hit\n", inside ? "random inside" : "from the front",
                kRays / seconds / 1e6, 100.0 * hits / kRays);
}

int run(int argc, char** argv) {
    auto geometry = std::make_shared<Geometry>(load(argc, argv));
    Bounds box;
    for (const Vec3f p : geometry->curves[0].points) box.grow(to_double(p));
    std::size_t spans = 0;
    for (std::size_t c = 0; c < geometry->curves[0].curve_count(); ++c) {
        spans += geometry->curves[0].span_count(c);
    }
    const std::int64_t before = peak_resident_bytes();
    Stages stages;
    const TracedObject object{
        geometry, {Affine{}}, std::vector<std::uint32_t>(geometry->materials.size(), 0)};
    EmbreeOptions options;
    if (argc > 6) options.memory_bytes = static_cast<std::int64_t>(std::atof(argv[6]) * 0x1p30);
    const double begin = now();
    const auto scene = build_embree_scene({&object, 1}, {{}}, stages, options);
    const double end = now();
    const auto n = static_cast<double>(stages.segments);
    std::printf("%zu spans, %lld fibers, %.2f M segments (%.2f a span and fiber)\n", spans,
                static_cast<long long>(geometry->yarns[0].fiber_count()), n / 1e6,
                n / static_cast<double>(spans) /
                    static_cast<double>(geometry->yarns[0].fiber_count()));
    std::printf("held %.1f bytes/segment, %.3f GiB; resident peak +%.1f bytes/segment, %.3f GiB\n",
                static_cast<double>(scene->byte_count()) / n,
                static_cast<double>(scene->byte_count()) * 0x1p-30,
                static_cast<double>(peak_resident_bytes() - before) / n,
                static_cast<double>(peak_resident_bytes()) * 0x1p-30);
    std::printf("expanded in %.2f s, tree in %.2f s: %.2f M segments/s on %d threads\n",
                stages.tree - begin, end - stages.tree, n / (end - begin) / 1e6, thread_count());
    shoot(*scene, box, false);
    shoot(*scene, box, true);
    return 0;
}

} // namespace
} // namespace heddle

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s FILE.bcc YARN [fibers] [radius] [curves] [GiB]\n", argv[0]);
        return 2;
    }
    try {
        return heddle::run(argc, argv);
    } catch (const heddle::Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
