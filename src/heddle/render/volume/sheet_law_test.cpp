#include <heddle/render/volume/test_sheet.h>

#include <gtest/gtest.h>

#include <cstdio>

namespace heddle {
namespace {

using namespace heddle::testing;

const LevelChoice kFinest{0, 0.0f, 0.5f};

TEST(Sheet, Probe) {
    struct View { const char* name; Vec3d n; };
    const double d = 3.14159265 / 180;
    const View views[] = {{"axis", {0, 0, 1}},
                          {"15", {std::sin(15 * d), 0, std::cos(15 * d)}},
                          {"30", {std::sin(30 * d), 0, std::cos(30 * d)}},
                          {"45", {1, 0, 1}},
                          {"111", {1, 1, 1}},
                          {"odd", {0.2, 0.5, 0.8}}};
    for (int level = 0; level < 4; ++level) {
        for (const View& v : views) {
            const Vec3d at{0.31, 0.27, 0.23};
            const VolumeInstance volume({sheet_level(plane_at(at, v.n), level < 2 ? 12 : 7, level)}, {}, {0});
            const double reach = level < 2 ? 8 : 4;
            StreamRandom random{4};
            for (const bool oblique : {false, true}) {
                MeanOf sheet, product;
                for (int i = 0; i < 6000; ++i) {
                    const Vec3d n = normalize(v.n);
                    Vec3d dir = n;
                    if (oblique) {
                        do dir = to_double(random_direction(random));
                        while (std::fabs(dot(dir, n)) < 0.3 || std::fabs(dot(dir, n)) > 0.8);
                    }
                    Vec3d p = to_double(random_direction(random)) * reach * 0.5;
                    p = at + p - n * dot(p, n);
                    Ray ray = ray_along(p - dir * 5.0, dir);
                    ray.t_max = 10.0f;
                    ray.sheet = random.uniform();
                    sheet.add((double)volume.transmittance(ray, Transport::Sheet, kFinest, random));
                    product.add((double)volume.transmittance(ray, Transport::Product, kFinest, random));
                }
                std::printf("level %d %-5s %-8s sheet %.4f product %.4f\n", level, v.name,
                            oblique ? "oblique" : "normal", sheet.mean(), product.mean());
            }
        }
    }
}

TEST(Sheet, Sphere) {
    for (const double R : {12.0, 6.0, 3.0, 1.6}) {
        for (int level : {0, 2}) {
            if (R > 7 && level > 0) continue;
            const Vec3d c{0.31, 0.77, 0.13};
            const VolumeInstance volume({sheet_level(sphere_at(c, R), static_cast<int>(R) + 2, level)}, {}, {0});
            StreamRandom random{4};
            MeanOf in[2], out[2], depth, bins[6];
            for (int i = 0; i < 20000; ++i) {
                const Vec3d dir = to_double(random_direction(random));
                Vec3d b = to_double(random_direction(random));
                b = normalize(b - dir * dot(b, dir));
                const double r = R * std::sqrt(static_cast<double>(random.uniform())) * (1 + 1.5 / R);
                const bool hit = r < R;
                Ray ray = ray_along(c - dir * 20.0 + b * r, dir);
                ray.t_max = 20.0f;
                ray.sheet = random.uniform();
                for (int t = 0; t < 2; ++t) {
                    const double T = (double)volume.transmittance(
                        ray, t == 0 ? Transport::Sheet : Transport::Product, kFinest, random);
                    if (hit) in[t].add(T); else out[t].add(1 - T);
                    if (hit && t == 0) bins[static_cast<int>(r / R * 6)].add(T);
                }
                VolumeHit h;
                ray.t_max = 1e9f;
                if (hit && volume.sample_flight(ray, Transport::Sheet, kFinest, random, h))
                    depth.add((double)h.t - (20 - std::sqrt(R * R - r * r)));
            }
            std::printf("R %.1f level %d leak %.4f (product %.4f) false stops %.4f (%.4f) depth %+.3f +- %.3f |", R, level,
                        in[0].mean(), in[1].mean(), out[0].mean(), out[1].mean(), depth.mean(), depth.error() * std::sqrt(depth.count));
            for (auto& b : bins) std::printf(" %.3f", b.mean());
            std::printf("\n");
        }
    }
}

} // namespace
} // namespace heddle
