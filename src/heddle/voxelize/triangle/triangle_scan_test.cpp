#include <heddle/voxelize/triangle/triangle_scan.h>

#include <heddle/base/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace heddle {
namespace {

using Hit = std::array<std::int32_t, 4>; // axis, i, j, k
using Triangle = std::array<Vec3d, 3>;
using Int128 = __int128;

constexpr SubvoxelBox kEverywhere{{-(1 << 30), -(1 << 30), -(1 << 30)},
                                  {1 << 30, 1 << 30, 1 << 30}};

ScanTriangle prepare(const Triangle& t) {
    return prepare_triangle(t[0], t[1], t[2]);
}

std::vector<Hit> hits_of(const Triangle& t, const SubvoxelBox& box = kEverywhere) {
    std::vector<Hit> hits;
    scan_triangle(
        prepare(t), box,
        [&](int axis, std::int32_t i, std::int32_t j, std::int32_t k, float, float, float) {
            hits.push_back({axis, i, j, k});
        });
    return hits;
}

struct Random {
    CounterRandom stream;
    double operator()(double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(stream.next() >> 11) * 0x1p-53;
    }
    Vec3d point(double lo, double hi) {
        const double x = (*this)(lo, hi), y = (*this)(lo, hi);
        return {x, y, (*this)(lo, hi)};
    }
};

std::int64_t snap(double x) {
    return static_cast<std::int64_t>(std::floor(x * 4096.0 + 0.5));
}

// Side of the edge (au, av)-(bu, bv) on which the point lies that sits an infinitesimal right of,
// and a far smaller infinitesimal above, (pu, pv). Never 0 for an edge with length.
int side(std::int64_t au,
         std::int64_t av,
         std::int64_t bu,
         std::int64_t bv,
         std::int64_t pu,
         std::int64_t pv) {
    const Int128 e = Int128{bu - au} * (pv - av) - Int128{bv - av} * (pu - au);
    if (e != 0) return e > 0 ? 1 : -1;
    if (bv != av) return av > bv ? 1 : -1;
    return bu > au ? 1 : bu < au ? -1 : 0;
}

// Every centre line in the bounds against the three exact edge functions; depth from the plane.
std::vector<Hit> brute_hits(const Triangle& t) {
    std::vector<Hit> hits;
    std::int64_t p[3][3];
    for (int n = 0; n < 3; ++n)
        for (int a = 0; a < 3; ++a) p[n][a] = snap(t[static_cast<std::size_t>(n)][a]);
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto [u_lo, u_hi] = std::minmax({p[0][u], p[1][u], p[2][u]});
        const auto [v_lo, v_hi] = std::minmax({p[0][v], p[1][v], p[2][v]});
        for (std::int64_t c = (u_lo >> 12) - 1; c <= (u_hi >> 12) + 1; ++c)
            for (std::int64_t r = (v_lo >> 12) - 1; r <= (v_hi >> 12) + 1; ++r) {
                const std::int64_t pu = c * 4096 + 2048, pv = r * 4096 + 2048;
                const auto edge = [&](int a, int b) {
                    return side(p[a][u], p[a][v], p[b][u], p[b][v], pu, pv);
                };
                if (edge(0, 1) != edge(1, 2) || edge(1, 2) != edge(2, 0)) continue;
                const auto weight = [&](int a, int b) {
                    return Int128{p[b][u] - p[a][u]} * (pv - p[a][v]) -
                           Int128{p[b][v] - p[a][v]} * (pu - p[a][u]);
                };
                const Int128 e0 = weight(1, 2), e1 = weight(2, 0), e2 = weight(0, 1);
                if (e0 + e1 + e2 == 0) continue;
                const long double depth =
                    (static_cast<long double>(e0) * static_cast<long double>(p[0][axis]) +
                     static_cast<long double>(e1) * static_cast<long double>(p[1][axis]) +
                     static_cast<long double>(e2) * static_cast<long double>(p[2][axis])) /
                    static_cast<long double>(e0 + e1 + e2) / 4096.0L;
                Hit h{axis, 0, 0, 0};
                h[static_cast<std::size_t>(1 + u)] = static_cast<std::int32_t>(c);
                h[static_cast<std::size_t>(1 + v)] = static_cast<std::int32_t>(r);
                h[static_cast<std::size_t>(1 + axis)] =
                    static_cast<std::int32_t>(std::floor(depth + 0x1p-20L)); // as the scan nudges
                hits.push_back(h);
            }
    }
    return hits;
}

// Same hits; a depth within rounding of a subvoxel border may fall to either side.
void expect_same(std::vector<Hit> a, std::vector<Hit> b, const char* what) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    ASSERT_EQ(a.size(), b.size()) << what;
    std::size_t other_depth = 0;
    const auto line = [](const Hit& h) {
        Hit l = h;
        l[static_cast<std::size_t>(1 + h[0])] = 0;
        return l;
    };
    std::map<Hit, std::int32_t> depth;
    for (const Hit& h : b) depth[line(h)] = h[static_cast<std::size_t>(1 + h[0])];
    for (const Hit& h : a) {
        const auto found = depth.find(line(h));
        ASSERT_NE(found, depth.end()) << what;
        const std::int32_t d = h[static_cast<std::size_t>(1 + h[0])] - found->second;
        ASSERT_LE(std::abs(d), 1) << what;
        other_depth += d != 0 ? 1u : 0u;
    }
    EXPECT_LE(other_depth, a.size() / 1000) << what;
}

TEST(TriangleScan, HitsAreThoseOfTheExactEdgeTest) {
    Random random{{1, 1}};
    for (int n = 0; n < 1200; ++n) {
        const double size = n % 4 == 0 ? 0.3 : n % 4 == 1 ? 2.0 : n % 4 == 2 ? 12.0 : 40.0;
        const Vec3d at = random.point(-1000.0, 1000.0);
        const Triangle t{at + random.point(-size, size), at + random.point(-size, size),
                         at + random.point(-size, size)};
        expect_same(hits_of(t), brute_hits(t), "random");
    }
}

TEST(TriangleScan, CornersOnCentresAndBordersAreDecidedOnce) {
    Random random{{2, 2}};
    for (int n = 0; n < 4000; ++n) { // multiples of 1/2: centres, borders, flat and empty triangles
        Triangle t;
        for (Vec3d& p : t)
            for (int a = 0; a < 3; ++a) p[a] = 0.5 * std::floor(random(-12.0, 12.0));
        expect_same(hits_of(t), brute_hits(t), "halves");
    }
}

TEST(TriangleScan, SliversAreExact) {
    Random random{{3, 3}};
    for (int n = 0; n < 2000; ++n) {
        const Vec3d a = random.point(-30.0, 30.0), b = random.point(-30.0, 30.0);
        const double width = n % 2 == 0 ? 1e-3 : 0.05;
        const Triangle t{a, b, a + (b - a) * random(0.0, 1.0) + random.point(-width, width)};
        expect_same(hits_of(t), brute_hits(t), "sliver");
    }
}

TEST(TriangleScan, AFlatTriangleOnALatticePlaneLiesAboveIt) {
    const std::vector<Hit> hits = hits_of({Vec3d{0, 0, 7}, Vec3d{10, 0, 7}, Vec3d{0, 10, 7}});
    ASSERT_EQ(hits.size(), 45u); // centres with i + j + 1 < 10: 9 + 8 + ... + 1
    for (const Hit& h : hits) {
        EXPECT_EQ(h[0], 2);
        EXPECT_EQ(h[3], 7);
    }
    EXPECT_TRUE(hits_of({Vec3d{1, 2, 3}, Vec3d{1, 2, 3}, Vec3d{1, 2, 3}}).empty());
    EXPECT_TRUE(hits_of({Vec3d{0, 0, 0}, Vec3d{5, 5, 5}, Vec3d{9, 9, 9}}).empty());
}

TEST(TriangleScan, HugeTrianglesAreExactInABoxOfTheirInside) {
    Random random{{4, 4}};
    std::size_t total = 0;
    for (int n = 0; n < 200; ++n) { // 128-bit products; compared with a plane test in a small box
        const double size = n % 2 == 0 ? 0x1p23 : 0x1p29;
        const Triangle t{random.point(-size, size), random.point(-size, size),
                         random.point(-size, size)};
        const Vec3d inside = t[0] * 0.3 + t[1] * 0.3 + t[2] * 0.4;
        SubvoxelBox box;
        for (int a = 0; a < 3; ++a) {
            box.lo[a] = static_cast<std::int32_t>(inside[a]) - 8;
            box.hi[a] = box.lo[a] + 16;
        }
        const Vec3d normal = scene_normal(t[0], t[1], t[2], {1, 1, 1});
        for (const Hit& h : hits_of(t, box)) {
            const auto axis = h[0];
            Vec3d p{h[1] + 0.5, h[2] + 0.5, h[3] + 0.5};
            const double off = dot(normal, p - t[0]) / normal[axis];
            ASSERT_LE(std::abs(off), 0.501 + 1e-3 / std::abs(normal[axis]));
            ++total;
        }
    }
    EXPECT_GT(total, 200u * 150u); // a plane through a 16^3 box meets 256 lines or more in all
}

TEST(TriangleScan, BoxesThatTileSpaceShareOutTheSameHits) {
    Random random{{5, 5}};
    for (int n = 0; n < 200; ++n) {
        const double size = n % 3 == 0 ? 1.5 : 80.0;
        const Triangle t{random.point(-size, size), random.point(-size, size),
                         random.point(-size, size)};
        std::vector<Hit> whole = hits_of(t), parts;
        const Vec3i cut{static_cast<std::int32_t>(random(-size, size)),
                        static_cast<std::int32_t>(random(-size, size)),
                        static_cast<std::int32_t>(random(-size, size))};
        for (int part = 0; part < 8; ++part) {
            SubvoxelBox box = kEverywhere;
            for (int a = 0; a < 3; ++a) ((part >> a) & 1 ? box.lo : box.hi)[a] = cut[a];
            const std::vector<Hit> some = hits_of(t, box);
            parts.insert(parts.end(), some.begin(), some.end());
        }
        std::sort(whole.begin(), whole.end());
        std::sort(parts.begin(), parts.end());
        ASSERT_EQ(whole, parts);
    }
}

TEST(TriangleScan, BarycentricsGiveTheHitsPosition) {
    Random random{{6, 6}};
    double worst = 0.0;
    for (int n = 0; n < 200; ++n) {
        const Triangle t{random.point(-50, 50), random.point(-50, 50), random.point(-50, 50)};
        scan_triangle(prepare(t), kEverywhere,
                      [&](int axis, std::int32_t i, std::int32_t j, std::int32_t k, float b0,
                          float b1, float b2) {
                          EXPECT_NEAR(b0 + b1 + b2, 1.0f, 1e-6f);
                          const Vec3d p = t[0] * static_cast<double>(b0) +
                                          t[1] * static_cast<double>(b1) +
                                          t[2] * static_cast<double>(b2);
                          const Vec3d cell{static_cast<double>(i), static_cast<double>(j),
                                           static_cast<double>(k)};
                          for (int a = 0; a < 3; ++a) {
                              if (a == axis) {
                                  EXPECT_GE(p[a], cell[a] - 0.1);
                                  EXPECT_LE(p[a], cell[a] + 1.1);
                              } else {
                                  worst = std::max(worst, std::abs(p[a] - cell[a] - 0.5));
                              }
                          }
                      });
    }
    EXPECT_LT(worst, 1e-3);
}

// A closed surface: a sphere's octahedral subdivision with random radii, so folds and slivers
// occur.
std::vector<Triangle> closed_mesh(int n, double radius, double noise, std::uint64_t seed) {
    std::map<std::array<int, 3>, Vec3d> corner;
    Random random{{seed, 7}};
    const auto vertex = [&](int x, int y, int z) {
        const auto [at, fresh] = corner.try_emplace({x, y, z});
        if (fresh)
            at->second = normalize(Vec3d{static_cast<double>(x), static_cast<double>(y),
                                         static_cast<double>(z)}) *
                         (radius * random(1.0 - noise, 1.0 + noise));
        return at->second;
    };
    std::vector<Triangle> mesh;
    for (int face = 0; face < 8; ++face) {
        const int sx = face & 1 ? -1 : 1, sy = face & 2 ? -1 : 1, sz = face & 4 ? -1 : 1;
        const auto at = [&](int a, int b) { return vertex(sx * a, sy * b, sz * (n - a - b)); };
        for (int a = 0; a < n; ++a)
            for (int b = 0; a + b < n; ++b) {
                mesh.push_back({at(a, b), at(a + 1, b), at(a, b + 1)});
                if (a + b + 1 < n) mesh.push_back({at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)});
            }
    }
    return mesh;
}

TEST(TriangleScan, EveryLineMeetsAClosedMeshAnEvenNumberOfTimes) {
    for (const auto& [n, radius] : {std::pair{4, 20.0}, {24, 20.0}, {40, 6.0}}) {
        std::map<std::tuple<int, int, int>, std::vector<std::int32_t>> lines;
        for (const Triangle& t : closed_mesh(n, radius, 0.3, 11))
            for (const Hit& h : hits_of(t)) {
                const auto u = static_cast<std::size_t>(1 + (h[0] + 1) % 3);
                const auto v = static_cast<std::size_t>(1 + (h[0] + 2) % 3);
                lines[{h[0], h[u], h[v]}].push_back(h[static_cast<std::size_t>(1 + h[0])]);
            }
        EXPECT_GT(lines.size(), static_cast<std::size_t>(3.0 * 2.0 * radius * radius));
        for (auto& [line, depth] : lines) ASSERT_EQ(depth.size() % 2, 0u);
    }
}

TEST(TriangleScan, ClosedMeshEnclosesItsVolume) {
    double volume = 0.0;
    for (const Triangle& t : closed_mesh(16, 20.0, 0.1, 12))
        volume += std::abs(dot(t[0], cross(t[1], t[2]))) / 6.0; // star-shaped: all of one sign
    for (int axis = 0; axis < 3; ++axis) {
        std::map<std::pair<int, int>, std::vector<std::int32_t>> lines;
        for (const Triangle& t : closed_mesh(16, 20.0, 0.1, 12))
            for (const Hit& h : hits_of(t))
                if (h[0] == axis)
                    lines[{h[static_cast<std::size_t>(1 + (axis + 1) % 3)],
                           h[static_cast<std::size_t>(1 + (axis + 2) % 3)]}]
                        .push_back(h[static_cast<std::size_t>(1 + axis)]);
        double sum = 0.0;
        for (auto& [line, depth] : lines) {
            std::sort(depth.begin(), depth.end());
            for (std::size_t n = 0; n + 1 < depth.size(); n += 2) sum += depth[n + 1] - depth[n];
        }
        EXPECT_NEAR(sum / volume, 1.0, 0.005);
    }
}

TEST(TriangleScan, WeightsOfTheHitsSumToTheArea) {
    Random random{{8, 8}};
    for (const Vec3d size : {Vec3d{1, 1, 1}, Vec3d{0.02, 0.02, 0.005}, Vec3d{3, 0.5, 1}}) {
        double sum = 0.0, area = 0.0, worst = 0.0;
        for (int n = 0; n < 400; ++n) {
            const Triangle t{random.point(-60, 60), random.point(-60, 60), random.point(-60, 60)};
            const Vec3d normal = scene_normal(t[0], t[1], t[2], size);
            double weight = 0.0;
            for (const Hit& h : hits_of(t)) weight += hit_weight(normal, h[0], size);
            const double exact = 0.5 * length(cross((t[1] - t[0]) * size, (t[2] - t[0]) * size));
            worst = std::max(worst, std::abs(weight - exact) / (exact + 50 * size.x * size.y));
            sum += weight, area += exact;
        }
        EXPECT_NEAR(sum / area, 1.0, 0.001);
        EXPECT_LT(worst, 0.25);
    }
}

TEST(TriangleScan, TinyTrianglesKeepTheirAreaInTheMean) {
    Random random{{9, 9}};
    const Vec3d size{1.0, 2.0, 0.7};
    double sum = 0.0, area = 0.0;
    for (int n = 0; n < 200000; ++n) {
        const Vec3d at = random.point(-100, 100);
        const Triangle t{at, at + random.point(-0.4, 0.4), at + random.point(-0.4, 0.4)};
        const Vec3d normal = scene_normal(t[0], t[1], t[2], size);
        for (const Hit& h : hits_of(t)) sum += hit_weight(normal, h[0], size);
        area += 0.5 * length(cross((t[1] - t[0]) * size, (t[2] - t[0]) * size));
    }
    EXPECT_NEAR(sum / area, 1.0, 0.02);
}

} // namespace
} // namespace heddle
