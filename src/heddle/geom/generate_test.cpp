#include <heddle/geom/generate.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

namespace heddle {
namespace {

constexpr GenerateKind kAll[] = {GenerateKind::Knit,  GenerateKind::Rib,   GenerateKind::Cable,
                                 GenerateKind::Plain, GenerateKind::Twill, GenerateKind::Satin,
                                 GenerateKind::Hair,  GenerateKind::Curls, GenerateKind::Brushed,
                                 GenerateKind::Grass};
constexpr GenerateKind kCloth[] = {GenerateKind::Knit,  GenerateKind::Rib,   GenerateKind::Cable,
                                   GenerateKind::Plain, GenerateKind::Twill, GenerateKind::Satin};
constexpr GenerateKind kKnits[] = {GenerateKind::Knit, GenerateKind::Rib, GenerateKind::Cable};

/// Points along a Catmull-Rom curve, `per_span` of them on each span.
std::vector<Vec3d> trace(const CurveSet& set, std::size_t curve, int per_span) {
    std::vector<Vec3d> out;
    const auto point = [&](std::size_t i) { return to_double(set.points[set.first[curve] + i]); };
    for (std::size_t i = 0; i < set.span_count(curve); ++i) {
        for (int k = 0; k < per_span; ++k) {
            const double t = static_cast<double>(k) / per_span;
            const Vec3d a = point(i), b = point(i + 1), c = point(i + 2), d = point(i + 3);
            out.push_back((b * 2.0 + (c - a) * t + (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t) +
                           (b * 3.0 - a - c * 3.0 + d) * (t * t * t)) *
                          0.5);
        }
    }
    return out;
}

double curve_length(const CurveSet& set, std::size_t curve) {
    const std::vector<Vec3d> p = trace(set, curve, 4);
    double sum = 0.0;
    for (std::size_t i = 1; i < p.size(); ++i) sum += length(p[i] - p[i - 1]);
    return sum;
}

double total_length(const Geometry& geometry) {
    double sum = 0.0;
    for (const CurveSet& set : geometry.curves) {
        for (std::size_t c = 0; c < set.curve_count(); ++c) sum += curve_length(set, c);
    }
    return sum;
}

/// The smallest distance between points of different yarns, in yarn radii; 3 if none is closer.
double closest_yarns(const Geometry& geometry) {
    const double r = static_cast<double>(geometry.curves[0].default_radius);
    using Cell = std::tuple<int, int, int>;
    std::map<Cell, std::vector<std::pair<int, Vec3d>>> grid;
    double best = 3.0 * r;
    int yarn = 0;
    for (const CurveSet& set : geometry.curves) {
        for (std::size_t c = 0; c < set.curve_count(); ++c, ++yarn) {
            for (const Vec3d& p : trace(set, c, 4)) {
                const int x = static_cast<int>(std::floor(p.x / best)),
                          y = static_cast<int>(std::floor(p.y / best)),
                          z = static_cast<int>(std::floor(p.z / best));
                grid[{x, y, z}].emplace_back(yarn, p);
            }
        }
    }
    const double cell = best;
    for (const auto& [key, points] : grid) {
        for (int n = 0; n < 27; ++n) {
            const auto near =
                grid.find({std::get<0>(key) + n % 3 - 1, std::get<1>(key) + n / 3 % 3 - 1,
                           std::get<2>(key) + n / 9 - 1});
            if (near == grid.end()) continue;
            for (const auto& [i, p] : points) {
                for (const auto& [j, q] : near->second) {
                    if (i < j) best = std::min(best, length(p - q));
                }
            }
        }
    }
    EXPECT_LE(best, cell);
    return best / r;
}

GenerateOptions small(GenerateKind kind) {
    GenerateOptions o{.kind = kind, .nx = 14, .ny = 18};
    if (kind == GenerateKind::Brushed) o.nx = 100, o.ny = 70;
    return o;
}

template <typename T>
std::int64_t bytes(const std::vector<T>& v) {
    return static_cast<std::int64_t>(v.size() * sizeof(T));
}

TEST(Generate, NodesAndBytesAreThePredictedOnesAndFinite) {
    for (const GenerateKind kind : kAll) {
        const Geometry g = generate(small(kind));
        std::int64_t nodes = 0, size = 0;
        for (const CurveSet& set : g.curves) {
            nodes += static_cast<std::int64_t>(set.points.size());
            size += bytes(set.points) + bytes(set.first) + bytes(set.radius);
            EXPECT_EQ(set.first.back(), set.points.size());
            for (const Vec3f& p : set.points) EXPECT_TRUE(std::isfinite(length(p)));
            EXPECT_LT(set.material, g.materials.size());
        }
        for (const Mesh& mesh : g.meshes) {
            nodes += static_cast<std::int64_t>(mesh.positions.size());
            size += bytes(mesh.positions) + bytes(mesh.normals) + bytes(mesh.uvs) +
                    bytes(mesh.tangents) + bytes(mesh.triangles);
            for (const Vec3f& p : mesh.positions) EXPECT_TRUE(std::isfinite(length(p)));
        }
        for (const Texture& t : g.textures) {
            size += bytes(t.texels);
            EXPECT_EQ(bytes(t.texels), std::int64_t{t.width} * t.height * t.channels);
        }
        EXPECT_EQ(nodes, predict_nodes(small(kind))) << to_string(kind);
        EXPECT_EQ(size, predict_bytes(small(kind))) << to_string(kind);
        EXPECT_GT(nodes, 0);
        EXPECT_EQ(g.name, to_string(kind));
    }
}

TEST(Generate, ClothHasOneYarnForEachCourseOrThread) {
    EXPECT_EQ(generate(small(GenerateKind::Cable)).curves[0].curve_count(), 18u);
    const Geometry plain = generate(small(GenerateKind::Plain));
    EXPECT_EQ(plain.curves[0].curve_count(), 14u);
    EXPECT_EQ(plain.curves[1].curve_count(), 18u);
}

TEST(Generate, TwoHundredMillionNodesArePredictedIn64Bits) {
    EXPECT_EQ(predict_nodes({.kind = GenerateKind::Knit, .nx = 100000, .ny = 100}),
              100LL * (100000LL * 20 + 3));
    EXPECT_GT(predict_bytes({.kind = GenerateKind::Hair, .nx = 1LL << 30, .ny = 64}), 1LL << 40);
}

TEST(Generate, EveryKindAndShapeHasTheSameBitsOn1And4Threads) {
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() &&
               (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
    };
    for (const GenerateKind kind : kAll) {
        GenerateOptions o = small(kind);
        o.nx *= 10;
        if (kind <= GenerateKind::Satin) o.shape = GenerateShape::Hanging;
        set_thread_count(1);
        const Geometry one = generate(o);
        set_thread_count(4);
        const Geometry four = generate(o);
        set_thread_count(0);
        for (std::size_t s = 0; s < one.curves.size(); ++s) {
            EXPECT_TRUE(same(one.curves[s].points, four.curves[s].points)) << to_string(kind);
            EXPECT_TRUE(same(one.curves[s].radius, four.curves[s].radius)) << to_string(kind);
        }
        for (std::size_t s = 0; s < one.meshes.size(); ++s) {
            EXPECT_TRUE(same(one.meshes[s].positions, four.meshes[s].positions));
            EXPECT_TRUE(same(one.meshes[s].triangles, four.meshes[s].triangles));
        }
        for (std::size_t s = 0; s < one.textures.size(); ++s) {
            EXPECT_TRUE(same(one.textures[s].texels, four.textures[s].texels));
        }
    }
}

TEST(Generate, SeedChangesHairAndSurfaces) {
    for (const GenerateKind kind : {GenerateKind::Hair, GenerateKind::Curls}) {
        GenerateOptions o = small(kind);
        const Geometry a = generate(o);
        o.seed = 2;
        EXPECT_NE(generate(o).curves[0].points, a.curves[0].points);
    }
    GenerateOptions o = small(GenerateKind::Brushed);
    const Geometry a = generate(o);
    o.seed = 2;
    EXPECT_NE(generate(o).textures[0].texels, a.textures[0].texels);
}

TEST(Generate, WovenYarnsTouchAndDoNotIntersect) {
    for (const GenerateKind kind :
         {GenerateKind::Plain, GenerateKind::Twill, GenerateKind::Satin}) {
        for (const double spacing : {0.0, 3.4642, 6.0, 20.0}) {
            GenerateOptions o = small(kind);
            o.radius = 1.0;
            o.spacing = spacing;
            const double closest = closest_yarns(generate(o));
            EXPECT_GT(closest, 1.95) << to_string(kind) << ' ' << spacing;
            EXPECT_LT(closest, 2.02) << to_string(kind) << ' ' << spacing;
        }
    }
}

TEST(Generate, KnittedYarnsTouchAndDoNotIntersect) {
    for (const double spacing : {0.0, 8.2, 10.0, 16.0}) {
        const GenerateOptions o{.nx = 4, .ny = 6, .radius = 1.0, .spacing = spacing};
        const double closest = closest_yarns(generate(o));
        EXPECT_GT(closest, 1.9) << spacing;
        EXPECT_LT(closest, 2.1) << spacing;
    }
    EXPECT_GT(closest_yarns(generate({.kind = GenerateKind::Rib})), 1.7);
    // at a crossing one thread has to pass between two layers of loops
    EXPECT_GT(closest_yarns(generate({.kind = GenerateKind::Cable})), 0.4);
}

/// Crossings of two yarns seen along z: how many, and in how many the second is in front.
std::pair<int, int> crossings(const CurveSet& set, std::size_t a, std::size_t b) {
    const std::vector<Vec3d> p = trace(set, a, 1), q = trace(set, b, 1);
    int all = 0, front = 0;
    const auto side = [](Vec3d o, Vec3d e, Vec3d x) { return cross(e - o, x - o).z; };
    for (std::size_t i = 1; i < p.size(); ++i) {
        for (std::size_t j = 1; j < q.size(); ++j) {
            const double s0 = side(p[i - 1], p[i], q[j - 1]), s1 = side(p[i - 1], p[i], q[j]);
            const double t0 = side(q[j - 1], q[j], p[i - 1]), t1 = side(q[j - 1], q[j], p[i]);
            if (s0 * s1 >= 0.0 || t0 * t1 >= 0.0) continue;
            ++all;
            if (q[j].z > p[i].z) ++front;
        }
    }
    return {all, front};
}

TEST(Generate, LoopsOfNeighbouringCoursesInterlock) {
    const GenerateOptions o{.nx = 10, .ny = 4};
    const Geometry g = generate(o);
    for (std::size_t row = 0; row + 1 < 4; ++row) {
        const auto [all, front] = crossings(g.curves[0], row, row + 1);
        EXPECT_EQ(all, 40); // two legs through a head, two legs past a foot, in each wale
        EXPECT_EQ(front, 20);
    }
    EXPECT_EQ(crossings(g.curves[0], 0, 2).first, 0);
}

TEST(Generate, RibTurnsHalfOfItsWalesToTheBack) {
    const Geometry knit = generate({.nx = 16, .ny = 3});
    const Geometry rib = generate({.kind = GenerateKind::Rib, .nx = 16, .ny = 3});
    const auto [all, front] = crossings(rib.curves[0], 0, 1);
    EXPECT_NEAR(all, crossings(knit.curves[0], 0, 1).first, 2); // the wave may hide one at an edge
    EXPECT_EQ(2 * front, all);
    // the third wale's legs lie behind its heads, the first wale's in front of them
    const auto legs_before_heads = [](const Geometry& g, std::size_t wale) {
        const Vec3f* p = &g.curves[0].points[1 + wale * 20];
        return p[5].z + p[15].z > 2.0f * p[10].z;
    };
    EXPECT_TRUE(legs_before_heads(rib, 0) && legs_before_heads(knit, 2));
    EXPECT_FALSE(legs_before_heads(rib, 2));
}

TEST(Generate, CableStrandsCrossInFrontOfEachOther) {
    const Geometry g = generate({.kind = GenerateKind::Cable, .nx = 8, .ny = 9});
    // course 4 is the first above a crossing: it visits the strands from the right first
    double lo = 1e9, hi = -1e9;
    for (const Vec3d& p : trace(g.curves[0], 4, 2)) {
        lo = std::min(lo, p.z);
        hi = std::max(hi, p.z);
    }
    EXPECT_GT(hi - lo, 8.0 * 0.1); // one layer of loops above another
}

TEST(Generate, FoldedAndHangingClothKeepsItsYarnLength) {
    for (const GenerateKind kind : kCloth) {
        const bool knit = kind <= GenerateKind::Cable;
        GenerateOptions o{.kind = kind, .nx = knit ? 30 : 60, .ny = knit ? 60 : 120};
        const double flat = total_length(generate(o));
        for (const GenerateShape shape : {GenerateShape::Folded, GenerateShape::Hanging}) {
            o.shape = shape;
            const double ratio = total_length(generate(o)) / flat;
            EXPECT_NEAR(ratio, 1.0, 0.02) << to_string(kind) << ' ' << static_cast<int>(shape);
        }
    }
}

TEST(Generate, FoldedAndHangingYarnsStayApart) {
    GenerateOptions o{.kind = GenerateKind::Plain, .nx = 60, .ny = 100};
    o.shape = GenerateShape::Folded;
    EXPECT_GT(closest_yarns(generate(o)), 1.8);
    o.shape = GenerateShape::Hanging;
    EXPECT_GT(closest_yarns(generate(o)), 1.8);
}

TEST(Generate, HangingFoldsDeepenDownward) {
    const Geometry g = generate({.shape = GenerateShape::Hanging, .nx = 60, .ny = 40});
    const auto depth = [&](std::size_t row) {
        double lo = 1e9, hi = -1e9;
        for (const Vec3d& p : trace(g.curves[0], row, 1)) {
            lo = std::min(lo, p.z);
            hi = std::max(hi, p.z);
        }
        return hi - lo;
    };
    EXPECT_GT(depth(0), 3.0 * depth(20) / 2.0);
    EXPECT_GT(depth(20), 2.0 * depth(39));
}

TEST(Generate, StrandsGrowFromTheGroundAndThin) {
    for (const GenerateKind kind : {GenerateKind::Hair, GenerateKind::Curls}) {
        const Geometry g = generate({.kind = kind, .nx = 100, .ny = 50});
        const CurveSet& set = g.curves[0];
        EXPECT_EQ(set.basis, Basis::Linear);
        for (std::size_t c = 0; c < set.curve_count(); ++c) {
            EXPECT_NEAR(set.points[set.first[c]].y, 0.0f, 1e-6f);
            EXPECT_GT(set.radius[set.first[c]], 3.0f * set.radius[set.first[c + 1] - 1]);
        }
    }
}

TEST(Generate, BrushedScratchesRunAlongTheTangent) {
    const Geometry g = generate({.kind = GenerateKind::Brushed, .nx = 256, .ny = 256});
    const Texture& t = g.textures[static_cast<std::size_t>(g.materials[0].anisotropy_map)];
    double along = 0.0, across = 0.0;
    for (std::size_t i = 256 * 3 + 4; i < t.texels.size(); i += 3) { // y of the direction
        along += std::abs(t.texels[i] - t.texels[i - 3]);
        across += std::abs(t.texels[i] - t.texels[i - 256 * 3]);
    }
    EXPECT_GT(across, 8.0 * along);
    EXPECT_EQ(g.materials[0].anisotropy, 1.0f);
    EXPECT_EQ(g.meshes[0].tangents.size(), g.meshes[0].positions.size());
}

TEST(Generate, GrassIsCutByItsAlphaAndItsNormalsFitItsTriangles) {
    const Geometry g = generate({.kind = GenerateKind::Grass, .nx = 200});
    const Texture& t = g.textures[0];
    std::size_t inside = 0;
    for (std::size_t i = 3; i < t.texels.size(); i += 4) inside += t.texels[i] > 127 ? 1 : 0;
    const double share = static_cast<double>(inside) / static_cast<double>(t.texels.size() / 4);
    EXPECT_GT(share, 0.2);
    EXPECT_LT(share, 0.8);
    const Mesh& m = g.meshes[0];
    for (const auto& [a, b, c] : m.triangles) {
        const Vec3f face =
            normalize(cross(m.positions[b] - m.positions[a], m.positions[c] - m.positions[a]));
        EXPECT_GT(dot(face, m.normals[a]), 0.8f);
        EXPECT_NEAR(length(m.normals[a]), 1.0f, 1e-5f);
    }
}

ErrorCode code_of(const GenerateOptions& o) {
    try {
        static_cast<void>(predict_bytes(o));
    } catch (const Error& e) {
        return e.code();
    }
    return ErrorCode::Internal;
}

TEST(Generate, BadOptionsAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const GenerateKind kind : kAll) {
        for (const GenerateOptions& o :
             {GenerateOptions{.kind = kind, .nx = -1}, GenerateOptions{.kind = kind, .ny = -1},
              GenerateOptions{.kind = kind, .nx = std::numeric_limits<std::int64_t>::max()},
              GenerateOptions{.kind = kind, .nx = 1LL << 35, .ny = 1LL << 35},
              GenerateOptions{.kind = kind, .radius = -1.0},
              GenerateOptions{.kind = kind, .radius = nan},
              GenerateOptions{.kind = kind, .radius = inf},
              GenerateOptions{.kind = kind, .spacing = -0.1},
              GenerateOptions{.kind = kind, .spacing = nan}}) {
            EXPECT_EQ(code_of(o), ErrorCode::InvalidArgument) << to_string(kind);
        }
    }
    for (const GenerateKind kind : kCloth) {
        EXPECT_EQ(code_of({.kind = kind, .radius = 1.0, .spacing = 3.0}),
                  ErrorCode::InvalidArgument);
    }
    EXPECT_EQ(code_of({.kind = GenerateKind::Hair, .ny = 1}), ErrorCode::InvalidArgument);
    EXPECT_EQ(code_of({.kind = GenerateKind::Grass, .nx = 1LL << 30, .ny = 4}),
              ErrorCode::InvalidArgument); // more than 2^32 vertices
    EXPECT_EQ(code_of({.kind = GenerateKind::Hair, .shape = GenerateShape::Folded}),
              ErrorCode::InvalidArgument);
    EXPECT_EQ(code_of({.kind = static_cast<GenerateKind>(77)}), ErrorCode::InvalidArgument);
    EXPECT_THROW(static_cast<void>(generate({.shape = GenerateShape::Folded, .ny = 2})), Error);
}

TEST(Generate, OneStitchAndOneCrossingAreEnough) {
    for (const GenerateKind kind : kAll) {
        const std::int64_t ny = kind == GenerateKind::Hair || kind == GenerateKind::Curls ? 2 : 1;
        EXPECT_GT(predict_nodes({.kind = kind, .nx = 1, .ny = ny}), 0);
        EXPECT_NO_THROW(static_cast<void>(generate({.kind = kind, .nx = 1, .ny = ny})));
    }
}

TEST(Generate, KindsAreFoundByName) {
    for (const GenerateKind kind : kAll) EXPECT_EQ(generate_kind_from(to_string(kind)), kind);
    EXPECT_FALSE(generate_kind_from("felt").has_value());
}

} // namespace
} // namespace heddle
