#include <heddle/base/random.h>
#include <heddle/device/upload_surfaces.h>
#include <heddle/executor/atomic.h>
#include <heddle/executor/host_executor.h>
#include <heddle/geom/generate.h>
#include <heddle/voxelize/bin_op.h>
#include <heddle/voxelize/block_worker.h>
#include <heddle/voxelize/triangle/triangle_op.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>
#include <vector>

namespace heddle {
namespace {

/// The numbers of one voxel for one material: 3 words of columns, 8 of subvoxels, 7 of a lobe and
/// 12 of its maps. Each material has the bits of its own hits.
struct Dense {
    static constexpr int kSubvoxels = 3, kLobe = 11, kMap = kLobe + LobeField::Count,
                         kWords = kMap + MapField::Count;
    std::uint64_t* words;
    bool with_maps;

    HEDDLE_HD void or_column(int cell, int axis, std::uint64_t bits) const {
        executor::atomic_or(words + cell * kWords + axis, bits);
    }
    HEDDLE_HD void or_subvoxels(int cell, int word, std::uint64_t bits) const {
        executor::atomic_or(words + cell * kWords + kSubvoxels + word, bits);
    }
    HEDDLE_HD void add_lobe(int cell, int field, std::int64_t x) const {
        add(cell * kWords + kLobe + field, x);
    }
    HEDDLE_HD void add_map(int cell, int field, std::int64_t x) const {
        add(cell * kWords + kMap + field, x);
    }
    [[nodiscard]] HEDDLE_HD bool has_maps() const { return with_maps; }

private:
    HEDDLE_HD void add(int at, std::int64_t x) const {
        executor::atomic_add(words + at, static_cast<std::uint64_t>(x));
    }
};
constexpr std::size_t kPlane = std::size_t{Dense::kWords} * BlockSums::kVoxels;

/// Adds a triangle to a block if it is one of the triangle's.
struct AddToBlock {
    SurfaceView surfaces;
    LatticeUnits units;
    BlockRange range;
    std::uint64_t block;
    std::uint64_t* words; ///< a plane per material
    bool with_maps;

    HEDDLE_HD void operator()(std::size_t triangle) const {
        const TriangleId at = surfaces.place(triangle);
        const MeshView& mesh = surfaces.meshes[at.mesh];
        const std::array<std::uint32_t, 3> c = mesh.triangles[at.triangle];
        const Vec3f corners[3] = {mesh.positions[c[0]], mesh.positions[c[1]], mesh.positions[c[2]]};
        for_each_block(corners, mesh.displacement, units, range, [&](int x, int y, int z) {
            if (range.number({x, y, z}) != block) return;
            Vec3i lo, hi;
            range.voxels(block, lo, hi);
            const Dense sums{words + mesh.material * kPlane, with_maps};
            add_triangle(surfaces, at, units, lo, hi, sums, NoScratch{});
        });
    }
};

/// A scene on a lattice: lo and hi are its voxels.
struct SurfaceCase {
    Geometry geometry;
    Lattice lattice;
    Vec3i lo, hi;
};

using Words = std::vector<std::uint64_t>;

/// The CPU's sums of a block in the layout of Dense. The first material has the bits of all
/// materials.
Words words_of(const BlockSums& sums, std::size_t materials) {
    Words words(materials * kPlane);
    for (int cell = 0; cell < BlockSums::kVoxels; ++cell) {
        const VoxelSums* voxel = sums.find(cell >> 10, cell >> 5 & 31, cell & 31);
        if (voxel == nullptr) continue;
        std::uint64_t* to = &words[static_cast<std::size_t>(cell) * Dense::kWords];
        std::copy(voxel->column.begin(), voxel->column.end(), to);
        std::copy(voxel->sub.begin(), voxel->sub.end(), to + Dense::kSubvoxels);
        for (const LobeSums* l = &voxel->lobe; l != nullptr; l = sums.next(*l)) {
            std::uint64_t* lobe = to + l->material * kPlane + Dense::kLobe;
            std::memcpy(lobe, l->moment.data(), 48);
            lobe[LobeField::Weight] = static_cast<std::uint64_t>(l->weight);
            const MapSums* maps = sums.find_maps(*voxel, *l);
            if (maps != nullptr) std::memcpy(lobe + LobeField::Count, maps, sizeof *maps);
        }
    }
    return words;
}

Words gather_block(executor::HostExecutor& exec, AddToBlock add) {
    const std::size_t materials = add.surfaces.material_count;
    const auto words = exec.make_zero<std::uint64_t>(materials * kPlane);
    add.words = words.data();
    exec.for_each(add.surfaces.triangle_count, add);
    Words out(words.size());
    exec.download(std::span(out), words.data());
    for (std::size_t m = 1; m < materials; ++m) { // bits of all to the first's
        for (std::size_t cell = 0; cell < BlockSums::kVoxels; ++cell) {
            std::uint64_t* to = &out[cell * Dense::kWords];
            std::uint64_t* from = to + m * kPlane;
            for (int w = 0; w < Dense::kLobe; ++w) to[w] |= std::exchange(from[w], 0);
        }
    }
    return out;
}

/// Compares all blocks of a scene by an uploaded view and by the CPU's gatherer.
/// @return  number of voxels that were hit
int expect_same_sums(const SurfaceCase& scene) {
    executor::Budget budget(std::int64_t{1} << 32);
    executor::HostExecutor exec(budget);
    const VoxelizeOptions options;
    PreparedGeometry prepared(scene.geometry, scene.lattice, scene.lo, scene.hi, options.seed);
    const VoxelizeContext context(prepared, options);
    const DeviceSurfaces arrays = upload_surfaces(exec, prepared.surfaces);
    const Progress silent;
    const Bins& bins = prepared.bins(silent);
    TriangleGatherer gatherer(prepared.surfaces, prepared.units, FitMode::Moments);
    BlockSums sums(context.fit.fields.map_sums());
    int voxels = 0;
    for (std::uint32_t block = 0; block < prepared.range.count(); ++block) {
        Vec3i lo, hi;
        prepared.range.voxels(block, lo, hi);
        sums.reset(lo, hi);
        gatherer.gather(bins.fill(std::span(&block, 1), silent).of(0), sums, silent);
        voxels += sums.count();
        const Words found = gather_block(
            exec, {arrays.view, prepared.units, prepared.range, block, nullptr, sums.has_maps()});
        EXPECT_TRUE(found == words_of(sums, scene.geometry.materials.size())) << block;
    }
    return voxels;
}

Bounds bounds_of(const Geometry& geometry) {
    Bounds box;
    for (const Mesh& mesh : geometry.meshes) {
        for (const Vec3f& p : mesh.positions) box.grow(to_double(p));
    }
    return box;
}

/// Along x.
double length_of(const Geometry& geometry) {
    return bounds_of(geometry).size().x;
}

/// The range of the voxels that contain a geometry's points, extended by `more` voxels.
SurfaceCase scene_of(Geometry geometry, Lattice lattice, int more = 1) {
    const Bounds box = bounds_of(geometry);
    SurfaceCase scene{std::move(geometry), lattice, {}, {}};
    for (int a = 0; a < 3; ++a) {
        scene.lo[a] = static_cast<int>(std::floor(box.lo[a] / lattice.voxel_size[a])) - more;
        scene.hi[a] = static_cast<int>(std::floor(box.hi[a] / lattice.voxel_size[a])) + 1 + more;
    }
    return scene;
}

Texture noise(std::int32_t width, std::int32_t height, std::int32_t channels, std::uint64_t seed) {
    Texture t;
    t.width = width;
    t.height = height;
    t.channels = channels;
    t.srgb = seed % 2 == 1;
    t.wrap_u = seed % 3 == 0 ? Wrap::Mirror : Wrap::Repeat;
    t.wrap_v = seed % 3 == 1 ? Wrap::Clamp : Wrap::Repeat;
    const auto n = static_cast<std::size_t>(width * height * channels);
    for (std::size_t i = 0; i < n; ++i) {
        t.texels.push_back(static_cast<std::uint8_t>(hash64(seed, i / 3) & 255));
    }
    return t;
}

/// A ball with uv, normals and a material about a point near the origin.
Mesh ball(std::uint32_t sides, float radius, std::uint32_t material) {
    Mesh m;
    m.material = material;
    const float pi = std::numbers::pi_v<float>;
    for (std::uint32_t i = 0; i <= sides; ++i) {
        for (std::uint32_t j = 0; j <= sides; ++j) {
            const float u = static_cast<float>(i) / static_cast<float>(sides);
            const float v = static_cast<float>(j) / static_cast<float>(sides);
            const Vec3f n{std::sin(pi * u) * std::cos(2 * pi * v), std::cos(pi * u),
                          std::sin(pi * u) * std::sin(2 * pi * v)};
            m.positions.push_back(n * radius + Vec3f{0.31f, -0.2f, 0.07f});
            m.normals.push_back(n);
            m.uvs.push_back({3.0f * v - 1.0f, 2.0f * u});
        }
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
            const std::uint32_t p = i * (sides + 1) + j;
            const std::uint32_t q = p + sides + 1;
            m.triangles.push_back({p, q, p + 1});
            m.triangles.push_back({p + 1, q, q + 1});
        }
    }
    return m;
}

/// A scene with all maps, all alpha modes, rotated anisotropy without tangents, and a plain ball.
Geometry textured_balls() {
    Geometry g;
    g.textures = {noise(64, 48, 4, 1), noise(32, 32, 3, 2), noise(17, 9, 3, 3),
                  noise(30, 20, 3, 4)};
    g.materials.resize(4);
    for (std::uint32_t m = 0; m < 3; ++m) {
        Material& material = g.materials[m];
        material.albedo_map = 0;
        material.normal_map = 1;
        material.metal_rough_map = 2;
        material.anisotropy_map = 3;
        material.anisotropy = 0.7f;
        material.anisotropy_rotation = 0.4f;
        material.alpha_mode = std::array{AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend}[m];
        g.meshes.push_back(ball(24, 1.0f - 0.07f * static_cast<float>(m), m));
    }
    g.materials[2].anisotropy = 0.0f;
    g.meshes[1].normals.clear();
    g.meshes.push_back(ball(9, 0.5f, 3));
    g.meshes.back().normals.clear();
    g.meshes.push_back(Mesh{}); // without a triangle
    return g;
}

TEST(UploadSurfaces, TheCopyNeedsNothingOfTheSource) {
    executor::Budget budget(std::int64_t{1} << 30);
    executor::HostExecutor exec(budget);
    const LatticeUnits units(Lattice{{0.06, 0.08, 0.05}, 4});
    const BlockRange range({-32, -32, -32}, {0, 0, 0});
    Words expected;
    DeviceSurfaces arrays;
    {
        const Geometry geometry = textured_balls();
        const SurfaceSource source(geometry, units, 1);
        expected = gather_block(exec, {source.view(), units, range, 0, nullptr, true});
        arrays = upload_surfaces(exec, source);
    }
    EXPECT_TRUE(gather_block(exec, {arrays.view, units, range, 0, nullptr, true}) == expected);
    EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [](auto w) { return w != 0; }));
}

TEST(UploadSurfaces, ABrushedPlateHasTheCpusSums) {
    const Geometry plate = generate({.kind = GenerateKind::Brushed, .nx = 48});
    const double h = length_of(plate) / 50.0;
    EXPECT_GT(expect_same_sums(scene_of(plate, {{h, h, h}, 8})), 2000);
}

TEST(UploadSurfaces, GrassCutByAlphaHasTheCpusSums) {
    const Geometry grass = generate({.kind = GenerateKind::Grass, .nx = 5});
    const double h = length_of(grass) / 40.0;
    EXPECT_GT(expect_same_sums(scene_of(grass, {{h, h, h}, 4})), 300);
}

TEST(UploadSurfaces, TexturedBallsHaveTheCpusSumsInAnyVoxelsAndRegions) {
    for (const int subvoxels : {1, 2, 4, 8}) {
        SurfaceCase scene = scene_of(textured_balls(), {{0.06, 0.08, 0.05}, subvoxels});
        EXPECT_GT(expect_same_sums(scene), 5000) << subvoxels;
        scene.lo = scene.lo + Vec3i{7, 3, 0};
        scene.hi = scene.hi - Vec3i{0, 9, 11};
        EXPECT_GT(expect_same_sums(scene), 2000) << subvoxels;
    }
}

TEST(UploadSurfaces, DisplacedBallsHaveTheCpusSums) {
    Geometry g = textured_balls();
    for (Material& material : g.materials) {
        material.height_map = 3;
        material.height_scale = 0.1f;
        material.height_offset = -0.03f;
    }
    EXPECT_GT(expect_same_sums(scene_of(std::move(g), {{0.1, 0.12, 0.09}, 4}, 3)), 2000);
}

} // namespace
} // namespace heddle
