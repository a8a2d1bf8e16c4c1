#include <heddle/render/volume/test_sheet.h>

#include <gtest/gtest.h>

#include <cstdio>

namespace heddle {
namespace {

using namespace heddle::testing;

const LevelChoice kFinest{0, 0.0f, 0.5f};

TEST(Sheet, Probe) {
    struct View {
        const char* name;
        Vec3d n;
    };
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
            const VolumeInstance volume({sheet_level(plane_at(at, v.n), level < 2 ? 12 : 7, level)},
                                        {}, {0});
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
                    product.add(
                        (double)volume.transmittance(ray, Transport::Product, kFinest, random));
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
            const VolumeInstance volume(
                {sheet_level(sphere_at(c, R), static_cast<int>(R) + 2, level)}, {}, {0});
            StreamRandom random{4};
            MeanOf in[2], out[2], depth, bins[6];
            for (int i = 0; i < 20000; ++i) {
                const Vec3d dir = to_double(random_direction(random));
                Vec3d b = to_double(random_direction(random));
                b = normalize(b - dir * dot(b, dir));
                const double r =
                    R * std::sqrt(static_cast<double>(random.uniform())) * (1 + 1.5 / R);
                const bool hit = r < R;
                Ray ray = ray_along(c - dir * 20.0 + b * r, dir);
                ray.t_max = 20.0f;
                ray.sheet = random.uniform();
                for (int t = 0; t < 2; ++t) {
                    const double T = (double)volume.transmittance(
                        ray, t == 0 ? Transport::Sheet : Transport::Product, kFinest, random);
                    if (hit)
                        in[t].add(T);
                    else
                        out[t].add(1 - T);
                    if (hit && t == 0) bins[static_cast<int>(r / R * 6)].add(T);
                }
                VolumeHit h;
                ray.t_max = 1e9f;
                if (hit && volume.sample_flight(ray, Transport::Sheet, kFinest, random, h))
                    depth.add((double)h.t - (20 - std::sqrt(R * R - r * r)));
            }
            std::printf(
                "R %.1f level %d leak %.4f (product %.4f) false stops %.4f (%.4f) depth %+.3f +- %.3f |",
                R, level, in[0].mean(), in[1].mean(), out[0].mean(), out[1].mean(), depth.mean(),
                depth.error() * std::sqrt(depth.count));
            for (auto& b : bins) std::printf(" %.3f", b.mean());
            std::printf("\n");
        }
    }
}

} // namespace
} // namespace heddle
namespace heddle {
namespace {
struct Disc {
    Vec3d at, n;
    double r;
    bool mask;
};

TEST(Sheet, Foliage) {
    for (const double r : {3.0, 1.0, 0.4}) {
        for (const double spread : {0.0, 0.3, 9.0}) {
            for (const bool mask : {false, true}) {
                StreamRandom random{9};
                std::vector<Disc> discs;
                const int extent = 6;
                const double area = 3.14 * r * r * (mask ? 0.5 : 1.0);
                const int count = static_cast<int>(8 * 216 * 0.12 / area) + 1;
                for (int i = 0; i < count; ++i) {
                    const auto u = [&] { return (double)(2 * random.uniform() - 1) * extent; };
                    Vec3d at{u(), u(), u()};
                    Vec3d n = normalize(Vec3d{0.3, 0.5, 0.8} +
                                        to_double(random_direction(random)) * spread);
                    discs.push_back({at, n, r, mask});
                }
                const auto has = [](const Disc& d, Vec3d p) {
                    const Vec3d q = p - d.at;
                    if (dot(q, q) > d.r * d.r) return false;
                    if (!d.mask) return true;
                    const Vec3d s = to_double(any_perpendicular(to_float(d.n)));
                    return std::sin(dot(q, s) * 9.0 / d.r) > 0.0;
                };
                const CrossSurface surface = [&](int axis, Vec3d line) {
                    std::vector<SurfacePoint> out;
                    for (const Disc& d : discs) {
                        Vec3d p = line;
                        p[axis] = 0;
                        p[axis] = dot(d.n, d.at - p) / d.n[axis];
                        if (has(d, p)) out.push_back({p, d.n});
                    }
                    return out;
                };
                const VolumeInstance volume({sheet_level(surface, extent, 0)}, {}, {0});
                for (const bool axial : {true, false}) {
                    MeanOf truth;
                    double bias[2]{}, err[2]{};
                    int n = 0;
                    for (int i = 0; i < 1500; ++i) {
                        Vec3d dir = to_double(random_direction(random));
                        if (axial) {
                            dir = {};
                            dir[i % 3] = 1;
                        }
                        const Vec3d side = to_double(any_perpendicular(to_float(dir)));
                        const Vec3d up = cross(dir, side);
                        const Vec3d c = to_double(random_direction(random)) * 3.0;
                        double t = 0, s[2]{};
                        constexpr int k = 6;
                        for (int j = 0; j < k * k; ++j) {
                            const Vec3d o = c + side * ((j % k + 0.5) / k - 0.5) +
                                            up * ((j / k + 0.5) / k - 0.5) - dir * 1.7;
                            bool open = true;
                            for (const Disc& d : discs) {
                                const double q = dot(d.n, d.at - o) / dot(d.n, dir);
                                if (q > 0 && q < 3.4 && has(d, o + dir * q)) open = false;
                            }
                            t += open;
                            Ray ray = ray_along(o, dir);
                            ray.t_max = 3.4f;
                            ray.sheet = random.uniform();
                            s[0] += (double)volume.transmittance(ray, Transport::Sheet, kFinest,
                                                                 random);
                            s[1] += (double)volume.transmittance(ray, Transport::Product, kFinest,
                                                                 random);
                        }
                        truth.add(t / k / k);
                        for (int m = 0; m < 2; ++m) {
                            bias[m] += (s[m] - t) / k / k;
                            err[m] += std::fabs(s[m] - t) / k / k;
                        }
                        ++n;
                    }
                    std::printf(
                        "r %.1f spread %.1f mask %d %-7s truth %.3f sheet %+.3f/%.3f product %+.3f/%.3f\n",
                        r, spread, mask, axial ? "axial" : "oblique", truth.mean(), bias[0] / n,
                        err[0] / n, bias[1] / n, err[1] / n);
                }
            }
        }
    }
}
} // namespace
} // namespace heddle
