#include <heddle/render/volume/test_sheet.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <string>

namespace heddle {
namespace {

using namespace heddle::testing;

const LevelChoice kFinest{0, 0.0f, 0.5f};

VolumeInstance volume_with(const CrossSurface& surface, int extent, int level = 0) {
    return {{sheet_level(surface, extent, level)}, {}, {0}};
}

double passes(const VolumeInstance& volume,
              const Ray& ray,
              StreamRandom& random,
              Transport transport = Transport::Automatic) {
    return static_cast<double>(volume.transmittance(ray, transport, kFinest, random));
}

double number(StreamRandom& random) {
    return static_cast<double>(random.uniform());
}

struct Tilt {
    const char* name;
    Vec3d normal;
};

constexpr double kDegree = 3.14159265358979 / 180.0;
const std::array<Tilt, 6> kTilts{
    {{"along an axis", {0, 0, 1}},
     {"15 degrees", {std::sin(15 * kDegree), 0, std::cos(15 * kDegree)}},
     {"30 degrees", {0.5, 0, std::cos(30 * kDegree)}},
     {"45 degrees", {1, 0, 1}},
     {"(1, 1, 1)", {1, 1, 1}},
     {"(2, 5, 8)", {2, 5, 8}}}};

/// The share of rays that pass opaque planes of random offsets.
struct Leak {
    MeanOf sheet, product;
};

Leak leak_of(Vec3d normal, int level, bool oblique, int planes) {
    Leak out;
    StreamRandom random{4};
    const Vec3d n = normalize(normal);
    const int extent = level < 2 ? 5 : 3;
    for (int plane = 0; plane < planes; ++plane) {
        const Vec3d at{number(random), number(random), number(random)};
        const VolumeInstance volume = volume_with(plane_at(at, n), extent, level);
        for (int i = 0; i < 400; ++i) {
            Vec3d d = n;
            while (oblique && (dot(d, n) < 0.3 || dot(d, n) > 0.8)) {
                d = to_double(random_direction(random));
            }
            Vec3d p = to_double(random_direction(random)) * (0.4 * extent);
            p = at + p - n * dot(p, n);
            Ray ray = ray_along(p - d * 3.0, d);
            ray.t_max = 6.0f;
            ray.sheet = random.uniform();
            out.sheet.add(passes(volume, ray, random));
            out.product.add(passes(volume, ray, random, Transport::Product));
        }
    }
    return out;
}

TEST(Sheet, AnOpaquePlanePassesNothing) {
    const bool print = std::getenv("HEDDLE_PRINT_TABLE") != nullptr; // bench/results/walls.md
    for (int level = 0; level < 4; ++level) {
        for (const Tilt& tilt : kTilts) {
            for (const bool oblique : {false, true}) {
                if (!print && level % 2 != 0) continue;
                const Leak leak = leak_of(tilt.normal, level, oblique, print ? 32 : 6);
                EXPECT_LT(leak.sheet.mean(), 0.01) << tilt.name; // by the planes' offsets
                EXPECT_GT(leak.product.mean(), leak.sheet.mean());
                if (!print) continue;
                std::cout << "| " << tilt.name << " | " << level << " | "
                          << (oblique ? "oblique" : "along the normal") << " | "
                          << leak.product.mean() << " | " << leak.sheet.mean() << " |\n";
            }
        }
    }
}

TEST(Sheet, ASphereHidesWhatIsBehindItAndNothingBeside) {
    for (const double radius : {12.0, 6.0, 3.0}) {
        const Vec3d center{0.31, 0.77, 0.13};
        const VolumeInstance volume =
            volume_with(sphere_at(center, radius), static_cast<int>(radius) + 2);
        StreamRandom random{4};
        MeanOf front, beside, depth;
        for (int i = 0; i < 8000; ++i) {
            const Vec3d d = to_double(random_direction(random));
            const Vec3d b = to_double(random_direction(random));
            const Vec3d aside = normalize(b - d * dot(b, d));
            const double r = (radius + 1.5) * std::sqrt(number(random));
            Ray ray = ray_along(center - d * 20.0 + aside * r, d);
            ray.t_max = 20.0f; // to the middle
            ray.sheet = random.uniform();
            (r < radius ? front : beside).add(passes(volume, ray, random));
            VolumeHit hit;
            if (r > 0.9 * radius) continue;
            ray.t_max = 100.0f;
            if (!volume.sample_flight(ray, Transport::Automatic, kFinest, random, hit)) continue;
            depth.add(static_cast<double>(hit.t) - 20.0 + std::sqrt(radius * radius - r * r));
        }
        EXPECT_LT(front.mean(), radius > 4.0 ? 0.005 : 0.015);
        EXPECT_GT(beside.mean(), 0.99);
        EXPECT_NEAR(depth.mean(), 0.0, 0.05);
    }
}

TEST(Sheet, APlaneEndsWhereItEnds) { // half a plane, and every second strip of one
    const Vec3d n = normalize(Vec3d{0.2, 0.3, 0.9});
    StreamRandom random{5};
    for (const bool strips : {false, true}) {
        const auto has = [&](Vec3d p) {
            const double x = p.x - 0.2 * p.y;
            return strips ? std::fmod(x + 60.0, 3.0) < 1.5 : x < 0.4;
        };
        const VolumeInstance volume = volume_with(plane_at({0.1, 0.2, 0.3}, n, has), 6);
        MeanOf error, size;
        for (int i = 0; i < 20000; ++i) {
            Vec3d d = to_double(random_direction(random));
            if (std::fabs(dot(d, n)) < 0.3) continue;
            Vec3d p = to_double(random_direction(random)) * 3.0;
            p = p - n * dot(p - Vec3d{0.1, 0.2, 0.3}, n);
            Ray ray = ray_along(p - d * 2.0, d);
            ray.t_max = 4.0f;
            ray.sheet = random.uniform();
            const double off = passes(volume, ray, random) - (has(p) ? 0.0 : 1.0);
            error.add(off);
            size.add(std::fabs(off));
        }
        EXPECT_NEAR(error.mean(), 0.0, 0.015);
        EXPECT_LT(size.mean(), strips ? 0.25 : 0.05);
    }
}

TEST(Sheet, ARayThatStartsOnASheetIsFreeOnItsSideAndMeetsOthers) {
    const auto two = [](int axis, Vec3d line) {
        std::vector<SurfacePoint> out = plane_at({0, 0, 0.3}, {0.1, 0.2, 1})(axis, line);
        for (const SurfacePoint& p : plane_at({0, 0, 2.6}, {0.1, 0.2, 1})(axis, line)) {
            out.push_back(p);
        }
        return out;
    };
    const VolumeInstance volume = volume_with(two, 6);
    StreamRandom random{6};
    MeanOf away, back;
    for (int i = 0; i < 4000; ++i) {
        Ray ray =
            ray_along({4.0 * number(random) - 2.0, 4.0 * number(random) - 2.0, 5}, {0, 0, -1});
        ray.sheet = random.uniform();
        VolumeHit hit;
        ASSERT_TRUE(volume.sample_flight(ray, Transport::Automatic, kFinest, random, hit));
        const Vec3d n = normalize(Vec3d{0.1, 0.2, 1});
        Vec3d d = to_double(random_direction(random));
        if (dot(d, n) < 0.0) d = d * -1.0;
        for (const double side : {1.0, -1.0}) {
            Ray next = ray_along(ray.at(static_cast<double>(hit.t)), d * side);
            if (std::fabs(dot(d, n)) < 0.1) continue;
            next.sheet = ray.sheet;
            next.t_max = 4.5f;
            next.from_sheet = {&volume, hit.level, hit.voxel, side > 0.0 ? hit.side : -hit.side};
            (side > 0.0 ? away : back).add(passes(volume, next, random));
            if (side < 0.0 && std::fabs(d.z) * 4.5 < 2.6) back.add(0.0); // does not get there
        }
    }
    EXPECT_GT(away.mean(), 0.999);
    EXPECT_LT(back.mean(), 0.5);
}

TEST(Sheet, FlightsPassAsOftenAsTransmittanceSays) {
    const auto mask = [](Vec3d p) { return std::sin(9.0 * p.x) + std::sin(7.0 * p.y) > 0.2; };
    const VolumeInstance volume =
        volume_with(plane_at({0.1, 0.2, 0.3}, normalize(Vec3d{0.2, 0.3, 0.9}), mask), 5);
    StreamRandom random{7};
    for (int r = 0; r < 8; ++r) {
        const Vec3d from = to_double(random_direction(random)) * 4.0;
        Ray ray = ray_along(from, to_double(random_direction(random)) - from);
        MeanOf passed, expected;
        for (int i = 0; i < 4000; ++i) {
            ray.sheet = random.uniform();
            VolumeHit hit;
            const bool stops =
                volume.sample_flight(ray, Transport::Automatic, kFinest, random, hit);
            passed.add(stops ? 0.0 : 1.0);
            expected.add(passes(volume, ray, random));
        }
        EXPECT_NEAR(passed.mean(), expected.mean(),
                    4.0 * (passed.error() + expected.error()) + 1e-6);
    }
}

TEST(Sheet, AlongAnAxisCoverageIsWhatPasses) {
    const Lattice lattice{{1, 1, 1}, 8};
    StreamRandom random{8};
    for (int i = 0; i < 300; ++i) {
        const PackedNormal normal = pack_normal(to_double(random_direction(random)));
        const auto a = static_cast<std::uint8_t>(random.next() % 256);
        const auto b = static_cast<std::uint8_t>(random.next() % 256);
        const std::array<double, 3> covered{0.9 * number(random), 0.9 * number(random),
                                            0.9 * number(random)};
        const PlaneSlab slab{std::min(a, b), std::max(a, b), normal};
        const SheetVoxel voxel = make_sheet(lattice, {slab, covered});
        if (voxel.depth == kOpaqueSheet) continue;
        const double present = -std::expm1(-static_cast<double>(voxel.depth) * 16.0 / 65535.0);
        const double half = slab_half_extent(slab_normal(slab), {1, 1, 1});
        const auto sheet =
            detail::project_sheet(slab_normal(slab), slab_position(slab.lo, half) - half / 255.0,
                                  slab_position(slab.hi, half) + half / 255.0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double rest = static_cast<double>(voxel.rest[axis]) * 16.0 / 65535.0;
            const double blocks = 1.0 - (1.0 - present * sheet[axis]) * std::exp(-rest);
            EXPECT_NEAR(blocks, std::max(covered[axis], present * sheet[axis]), 1e-3);
        }
    }
}

TEST(Sheet, TheProjectionOfASheetIsThatOfItsPolygon) {
    StreamRandom random{9};
    for (int i = 0; i < 40; ++i) {
        const Vec3d n = normalize(to_double(random_direction(random)));
        const double lo = 0.8 * number(random) - 0.4;
        const double hi = lo + 0.1 + 0.3 * number(random);
        const std::array<double, 3> exact = detail::project_sheet(n, lo, hi);
        for (int a = 0; a < 3; ++a) {
            int met = 0;
            constexpr int kLines = 20000;
            for (int k = 0; k < kLines; ++k) {
                Vec3d p{number(random) - 0.5, number(random) - 0.5, number(random) - 0.5};
                p[a] = 0.0;
                const double at = (lo + (hi - lo) * number(random) - dot(n, p)) / n[a];
                met += std::fabs(at) < 0.5 ? 1 : 0;
            }
            EXPECT_NEAR(static_cast<double>(met) / kLines, exact[static_cast<std::size_t>(a)],
                        0.015);
        }
    }
}

} // namespace
} // namespace heddle
