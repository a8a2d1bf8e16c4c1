#include <heddle/base/random.h>
#include <heddle/voxel/plane_slab.h>
#include <heddle/voxelize/test_swatch.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heddle {
namespace {

using namespace heddle::test;
using Polygon = std::vector<Vec3d>;

constexpr Vec3d kEdges{0.5, 0.35, 0.6};

/// Returns the part of a polygon where sign * (p[axis] - at) <= 0.
Polygon cut(const Polygon& from, int axis, double at, double sign) {
    Polygon out;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3d a = from[i];
        const Vec3d b = from[(i + 1) % from.size()];
        const double x = sign * (a[axis] - at);
        const double y = sign * (b[axis] - at);
        if (x <= 0.0) out.push_back(a);
        if ((x < 0.0) != (y < 0.0) && x != 0.0 && y != 0.0) {
            out.push_back(a + (b - a) * (x / (x - y)));
        }
    }
    return out;
}

/// A range of positions along a normal, measured from a voxel's centre.
struct Positions {
    double min = 1e300;
    double max = -1e300;
};

/// Returns the positions of all triangles' pieces inside a voxel, in scene units.
/// @param grow    each face of the voxel is moved outwards by this share of its edges
/// @param counts  counts(mesh): whether a mesh's triangles are meant
template <typename Counts>
Positions clip_to_voxel(
    const Geometry& g, Vec3i at, Vec3d edges, Vec3d normal, double grow, const Counts& counts) {
    Positions out;
    const Vec3d lo = Vec3d{double(at.x), double(at.y), double(at.z)} * edges;
    for (const Mesh& mesh : g.meshes) {
        if (!counts(mesh)) continue;
        for (const auto& corner : mesh.triangles) {
            Polygon p;
            for (const std::uint32_t v : corner) p.push_back(to_double(mesh.positions[v]));
            for (int a = 0; a < 3; ++a) {
                p = cut(p, a, lo[a] - grow * edges[a], -1.0);
                p = cut(p, a, lo[a] + (1.0 + grow) * edges[a], 1.0);
            }
            for (const Vec3d& q : p) {
                const double x = dot(q - (lo + edges * 0.5), normal);
                out.min = std::min(out.min, x);
                out.max = std::max(out.max, x);
            }
        }
    }
    return out;
}

VoxelizeOptions options_of(Vec3d edges, int lobes = 3) {
    VoxelizeOptions options;
    options.voxel_size = edges;
    options.max_lobes = lobes;
    options.spool_dir = testing::TempDir();
    return options;
}

Vec3f point(CounterRandom& random, float size) {
    const float x = (random.uniform() - 0.5f) * size;
    const float y = (random.uniform() - 0.5f) * size;
    return {x, y, (random.uniform() - 0.5f) * size};
}

/// A mesh of random triangles.
Mesh soup(int count, float size, float extent, std::uint64_t seed, std::uint32_t material = 0) {
    Mesh mesh;
    mesh.material = material;
    CounterRandom random{seed, 0};
    for (int i = 0; i < count; ++i) {
        const Vec3f center = point(random, extent);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int v = 0; v < 3; ++v) mesh.positions.push_back(center + point(random, size));
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

Geometry geometry_of_meshes(std::vector<Mesh> meshes) {
    Geometry g;
    g.name = "test";
    for (const Mesh& mesh : meshes) {
        g.materials.resize(std::max<std::size_t>(g.materials.size(), mesh.material + 1));
    }
    g.meshes = std::move(meshes);
    return g;
}

/// Expects that each voxel's slab holds what lies in the voxel and no more, to 1/256 of the
/// voxel's diagonal. @return  number of voxels whose slab says something
template <typename Counts>
int expect_exact(const Geometry& g, const VoxelLevel& level, const Counts& counts) {
    const Vec3d edges = level.info().lattice.voxel_size;
    const double close = length(edges) / 256.0;
    int said = 0;
    for_each_voxel(level, [&](const BlockVoxel& v) {
        const Vec3d n = slab_normal(v.slab());
        const double s = slab_half_extent(n, edges);
        // vertices are moved by up to 1/8192 of a subvoxel, so slivers may leave or enter the voxel
        const auto clip = [&](double grow) {
            return clip_to_voxel(g, v.at, edges, n, grow,
                                 [&](const Mesh& mesh) { return counts(v, mesh); });
        };
        const Positions must = clip(-1e-4);
        const Positions may = clip(1e-4);
        if (must.min > must.max) return;
        EXPECT_LE(slab_position(v.slab().lo, s), must.min + close);
        EXPECT_GE(slab_position(v.slab().hi, s), must.max - close);
        EXPECT_GE(slab_position(v.slab().lo, s), may.min - close);
        EXPECT_LE(slab_position(v.slab().hi, s), may.max + close);
        said += v.slab() == PlaneSlab{} ? 0 : 1;
    });
    return said;
}

bool is_of_first_lobe(const BlockVoxel& v, const Mesh& mesh) {
    return v.lobes().front().material == mesh.material;
}

TEST(SlabFitter, OnePlaneIsHeldTo1Over256OfTheDiagonal) {
    CounterRandom random{11, 0};
    for (const Vec3d edges : {Vec3d{0.5, 0.5, 0.5}, kEdges}) {
        for (int i = 0; i < 8; ++i) {
            const Vec3f u = normalize(point(random, 2.0f)) * 6.0f;
            const Vec3f v = normalize(cross(u, normalize(point(random, 2.0f)))) * 6.0f;
            Mesh mesh;
            const Vec3f corner = point(random, 1.0f);
            mesh.positions = {corner, corner + u, corner + u + v, corner + v};
            mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
            const Geometry g = geometry_of_meshes({mesh});
            const auto level = voxelize_now(g, options_of(edges));
            EXPECT_TRUE(level->info().fields.slabs);
            const int said = expect_exact(g, *level, is_of_first_lobe);
            EXPECT_EQ(said, level->info().voxel_count);
            const double diagonal = length(edges);
            for_each_voxel(*level, [&](const BlockVoxel& at) {
                const Vec3d n = slab_normal(at.slab());
                const double step = 2.0 * slab_half_extent(n, edges) / 255.0;
                EXPECT_LT((at.slab().hi - at.slab().lo) * step, diagonal / 50.0) << "it is thin";
            });
        }
    }
}

TEST(SlabFitter, AnAlignedPlaneHasEqualPlanesAndBelongsToTheVoxelAbove) {
    Mesh mesh;
    mesh.positions = {{0, 0, 2}, {4, 0, 2}, {4, 4, 2}, {0, 4, 2}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto level = voxelize_now(geometry_of_meshes({mesh}), options_of({1, 1, 1}));
    EXPECT_EQ(level->info().voxel_count, 16);
    for_each_voxel(*level, [](const BlockVoxel& v) {
        EXPECT_EQ(v.at.z, 2);
        EXPECT_EQ(v.slab(), (PlaneSlab{0, 0}));
    });
}

TEST(SlabFitter, ManyTrianglesAreHeldAndNoMore) {
    for (const float size : {0.2f, 1.0f, 5.0f}) {
        const Geometry g = geometry_of_meshes({soup(60, size, 6.0f, 3)});
        const auto level = voxelize_now(g, options_of(kEdges));
        EXPECT_GT(expect_exact(g, *level, is_of_first_lobe), 50) << size;
    }
}

TEST(SlabFitter, OtherLobesDoNotCountUntilTheyAreMerged) {
    std::vector<Mesh> meshes;
    for (std::uint32_t m = 0; m < 4; ++m) meshes.push_back(soup(40, 2.0f, 4.0f, 20 + m, m));
    const Geometry g = geometry_of_meshes(std::move(meshes));
    for (const int lobes : {1, 2, 4}) {
        const auto level = voxelize_now(g, options_of(kEdges, lobes));
        const auto counts = [&](const BlockVoxel& v, const Mesh& mesh) {
            if (is_of_first_lobe(v, mesh)) return true;
            if (v.lobe_count() < static_cast<std::size_t>(lobes)) return false;
            return std::none_of(v.lobes().begin(), v.lobes().end(),
                                [&](const Lobe& lobe) { return lobe.material == mesh.material; });
        };
        EXPECT_GT(expect_exact(g, *level, counts), 100) << lobes;
    }
}

TEST(SlabFitter, FibersHaveNoPlanes) {
    EXPECT_FALSE(voxelize_now(swatch(), options_of({0.2, 0.2, 0.2}))->info().fields.slabs);
    Geometry g = swatch();
    Mesh mesh = soup(20, 4.0f, 6.0f, 5);
    mesh.material = static_cast<std::uint32_t>(g.materials.size());
    g.materials.emplace_back();
    g.meshes.push_back(mesh);
    const auto level = voxelize_now(g, options_of({0.2, 0.2, 0.2}));
    int surfaces = 0;
    for_each_voxel(*level, [&](const BlockVoxel& v) {
        if (v.lobes().front().material == mesh.material) {
            surfaces += v.slab() == PlaneSlab{} ? 0 : 1;
        } else {
            EXPECT_EQ(v.slab(), PlaneSlab{});
        }
    });
    EXPECT_GT(surfaces, 100);
}

TEST(SlabFitter, ADisplacedPlateHasItsSlabWhereItWasMoved) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0.4f}, {2, 0, 0.4f}, {2, 2, 0.4f}, {0, 2, 0.4f}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    Geometry g = geometry_of_meshes({mesh});
    Texture texture;
    texture.width = texture.height = 1;
    texture.channels = 4;
    texture.texels = {128, 128, 128, 255};
    g.textures = {texture};
    g.materials[0].height_map = 0;
    g.materials[0].height_scale = 5.0f;
    const auto level = voxelize_now(g, options_of({0.25, 0.25, 0.25}));
    const double z = (0.4 + 5.0 * 128.0 / 255.0) / 0.25;
    const double value = 255.0 * (z - std::floor(z));
    for_each_voxel(*level, [&](const BlockVoxel& v) {
        EXPECT_NEAR(v.slab().lo, value, 2.0);
        EXPECT_NEAR(v.slab().hi, value, 2.0);
    });
}

} // namespace
} // namespace heddle
