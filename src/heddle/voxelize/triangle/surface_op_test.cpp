#include <heddle/surface/surface_source.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/voxelize/triangle/triangle_scan.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace heddle {
namespace {

constexpr SubvoxelBox kEverywhere{{-(1 << 30), -(1 << 30), -(1 << 30)},
                                  {1 << 30, 1 << 30, 1 << 30}};

Texture make_texture(int width,
                     int height,
                     int channels,
                     const std::function<int(int x, int y, int c)>& value) {
    Texture t;
    t.width = width, t.height = height, t.channels = channels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                t.texels.push_back(static_cast<std::uint8_t>(value(x, y, c)));
    return t;
}

// A square of `edge` subvoxels at z = 0.5, uv from (0, 0) to (1, 1), u along x and v along y.
Geometry square(float edge) {
    Geometry g;
    Mesh m;
    m.positions = {{0, 0, 0.5f}, {edge, 0, 0.5f}, {edge, edge, 0.5f}, {0, edge, 0.5f}};
    m.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    g.meshes.push_back(m);
    g.materials.emplace_back();
    return g;
}

// Calls visit(sample) for every hit along z of the geometry's first mesh, for as many layers at
// different depths.
void sample_all(const Geometry& g,
                const std::function<void(const SurfaceSample&)>& visit,
                int layers = 1) {
    const SurfaceSource surfaces(g, {1, 1, 1}, 7);
    const Mesh& mesh = g.meshes[0];
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const auto& [a, b, c] = mesh.triangles[n];
        const TriangleSetup setup = set_up_triangle(surfaces.view(), surfaces.view_of(mesh), n);
        scan_triangle(prepare_triangle(to_double(mesh.positions[a]), to_double(mesh.positions[b]),
                                       to_double(mesh.positions[c])),
                      kEverywhere,
                      [&](int axis, std::int32_t i, std::int32_t j, std::int32_t k, float b0,
                          float b1, float b2) {
                          for (int depth = k; axis == 2 && depth < k + layers; ++depth)
                              visit(sample_at(7, setup, {axis, i, j, depth, b0, b1, b2}));
                      });
    }
}

double covered_fraction(const Geometry& g, int layers = 1) {
    double covered = 0.0, all = 0.0;
    sample_all(
        g,
        [&](const SurfaceSample& s) {
            covered += s.covered ? 1.0 : 0.0;
            all += 1.0;
        },
        layers);
    return covered / all;
}

// Needles, 3 texels wide with soft borders, in a fan that repeats every 32 texels; red where they
// are, bright green around.
Texture needles(int size) {
    return make_texture(size, size, 4, [](int x, int y, int c) {
        const double u = std::fmod(x + 0.37 * y, 32.0) - 16.0;
        const double a = std::clamp(2.2 - std::abs(u) + 0.3 * std::sin(0.2 * y), 0.0, 1.0);
        if (c == 3) return static_cast<int>(255.0 * a);
        if (a > 0.0) return c == 0 ? 200 : 0;
        return c == 1 ? 255 : 0;
    });
}

double exact_coverage(const Texture& t, float cutoff) {
    const FilteredTexture texture(t, TexelWeight::Mask, cutoff, false);
    double sum = 0.0;
    const int n = 3 * t.width;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            sum += static_cast<double>(texture.coverage_at_point(
                {(static_cast<float>(x) + 0.5f) / static_cast<float>(n),
                 (static_cast<float>(y) + 0.5f) / static_cast<float>(n)}));
    return sum / n / n;
}

TEST(SurfaceSample, AMaskCoversWhatItCoversAtEveryFootprint) {
    const float cutoff = 0.6f;
    const Texture texture = needles(256);
    const double exact = exact_coverage(texture, cutoff);
    EXPECT_GT(exact, 0.05); // the mean alpha of a 32-texel patch never reaches the cut-off
    EXPECT_LT(exact, 0.15);
    for (const float texels : {0.25f, 1.0f, 4.0f, 16.0f}) {
        // not a whole number of texels, which would read one phase of the pattern only
        const float edge = 256.0f / texels * 0.97f;
        const int layers = static_cast<int>(4.0f * texels * texels) + 1;
        Geometry g = square(edge);
        g.textures.push_back(texture);
        g.materials[0].alpha_mode = AlphaMode::Mask;
        g.materials[0].alpha_cutoff = cutoff;
        g.materials[0].albedo_map = 0;
        // other depths throw other dice
        EXPECT_NEAR(covered_fraction(g, layers) / exact, 1.0, 0.02)
            << texels << " texels per subvoxel";
    }
}

TEST(SurfaceSample, ColourOfCutAwayTexelsDoesNotShow) {
    for (const float edge : {512.0f, 64.0f, 16.0f}) {
        Geometry g = square(edge);
        g.textures.push_back(needles(256));
        g.materials[0].alpha_mode = AlphaMode::Mask;
        g.materials[0].albedo_map = 0;
        sample_all(g, [&](const SurfaceSample& s) {
            if (!s.covered) return;
            ASSERT_NEAR(s.albedo.x, 200.0f / 255.0f, 1e-3f);
            ASSERT_LT(s.albedo.y, 1e-3f);
        });
    }
}

TEST(SurfaceSample, BlendCoversInProportionToAlpha) {
    Geometry g = square(300.0f);
    g.materials[0].alpha_mode = AlphaMode::Blend;
    g.materials[0].alpha = 0.5f;
    EXPECT_NEAR(covered_fraction(g), 0.5, 0.006); // four standard deviations of 90,000 throws
    g.textures.push_back(make_texture(2, 2, 4, [](int, int, int) { return 102; }));
    g.materials[0].albedo_map = 0;
    EXPECT_NEAR(covered_fraction(g), 0.2, 0.006);
    g.materials[0].alpha_mode = AlphaMode::Opaque;
    EXPECT_EQ(covered_fraction(g), 1.0);
    g.materials[0].alpha_mode = AlphaMode::Mask;
    g.materials[0].alpha = 0.0f;
    EXPECT_EQ(covered_fraction(g), 0.0);
}

TEST(SurfaceSample, MeanAlbedoIsTheTexturesInLinearLight) {
    Texture t = make_texture(96, 53, 3, [](int x, int y, int c) { // sizes that halve unevenly
        return static_cast<int>(
            hash64(1, static_cast<std::uint64_t>(x * 64 + y), static_cast<std::uint64_t>(c)) &
            (x < 40 ? 255u : 63u));
    });
    t.srgb = true;
    Vec3d exact;
    for (std::size_t i = 0; i < t.texels.size(); ++i) {
        const double c = t.texels[i] / 255.0;
        exact[static_cast<int>(i % 3)] +=
            (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4)) / (96 * 53);
    }
    for (const float edge : {300.0f, 96.0f, 20.0f, 5.0f}) {
        Geometry g = square(edge);
        g.textures.push_back(t);
        g.materials[0].albedo_map = 0;
        Vec3d mean;
        double count = 0.0;
        sample_all(g, [&](const SurfaceSample& s) {
            mean = mean + to_double(s.albedo);
            count += 1.0;
        });
        const double bound = edge > 90.0f ? 1e-3 : 6e-3;
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(mean[a] / count, exact[a], bound) << edge;
    }
    const FilteredTexture whole(t, TexelWeight::One, 0.0f, true);
    EXPECT_NEAR(whole.filtered({0.3f, 0.8f}, 99.0f).r, exact.x, 1e-4); // odd sizes keep the mean
}

TEST(SurfaceSample, RoughnessAndMetalnessComeFromGreenAndBlue) {
    Geometry g = square(4.0f);
    g.textures.push_back(make_texture(2, 2, 3, [](int, int, int c) { return 51 * (c + 1); }));
    g.materials[0].metal_rough_map = 0;
    sample_all(g, [&](const SurfaceSample& s) {
        ASSERT_NEAR(s.roughness, 0.4f, 1e-5f);
        ASSERT_NEAR(s.metalness, 0.6f, 1e-5f);
        ASSERT_EQ(s.albedo, (Vec3f{1, 1, 1}));
        ASSERT_EQ(s.normal, (Vec3f{0, 0, 1}));
    });
}

TEST(SurfaceSample, NormalMapsKeepTheirSpreadAtCoarseFootprints) {
    for (const float edge : {512.0f, 64.0f}) { // ridges: half the texels lean to +x, half to -x
        Geometry g = square(edge);
        g.textures.push_back(make_texture(512, 512, 3, [](int x, int, int c) {
            return c == 0 ? (x % 8 < 4 ? 218 : 37) : c == 1 ? 128 : 218;
        }));
        g.materials[0].normal_map = 0;
        double xx = 0.0, zz = 0.0, count = 0.0;
        sample_all(g, [&](const SurfaceSample& s) {
            ASSERT_NEAR(length(s.normal), 1.0f, 1e-5f);
            xx += static_cast<double>(s.normal.x) * static_cast<double>(s.normal.x);
            zz += static_cast<double>(s.normal.z) * static_cast<double>(s.normal.z);
            count += 1.0;
        });
        EXPECT_GT(xx / count, 0.35) << edge; // 1/2 less what bilinear reading rounds off; a mean
        EXPECT_LT(xx / count, 0.51) << edge; // normal would give 0
        EXPECT_NEAR(xx / count + zz / count, 1.0, 1e-3) << edge;
    }
}

TEST(SurfaceSample, TangentsTurnWithRotationMapAndHandedness) {
    Geometry g = square(4.0f);
    g.materials[0].anisotropy = 0.7f;
    sample_all(g, [&](const SurfaceSample& s) { ASSERT_NEAR(s.tangent.x, 1.0f, 1e-6f); });
    g.materials[0].anisotropy_rotation = std::acos(0.0f);
    sample_all(g, [&](const SurfaceSample& s) { ASSERT_NEAR(s.tangent.y, 1.0f, 1e-6f); });
    g.meshes[0].tangents.assign(4, Tangent{1, 0, 0, -1});
    sample_all(g, [&](const SurfaceSample& s) { ASSERT_NEAR(s.tangent.y, -1.0f, 1e-6f); });
    g.meshes[0].tangents.clear();
    g.textures.push_back( // direction -x +y, strength 0.2
        make_texture(4, 4, 3, [](int, int, int c) { return c == 0   ? 0
                                                           : c == 1 ? 255
                                                                    : 51; }));
    g.materials[0].anisotropy_map = 0;
    sample_all(g, [&](const SurfaceSample& s) {
        ASSERT_NEAR(s.tangent.x, -std::sqrt(0.5f), 1e-5f); // turned by a quarter: -x -y
        ASSERT_NEAR(s.tangent.y, -std::sqrt(0.5f), 1e-5f);
        ASSERT_NEAR(s.anisotropy, 0.2f, 1e-5f);
    });
}

TEST(SurfaceSample, PlainTrianglesAreConstantAndSmoothOnesInterpolate) {
    Geometry g = square(8.0f);
    const auto kind = [&] { return SurfaceSource(g, {1, 1, 1}, 0).view_of(g.meshes[0]).kind; };
    EXPECT_EQ(kind(), SurfaceKind::Constant);
    const float s = std::sqrt(0.5f);
    g.meshes[0].normals = {{-s, 0, s}, {s, 0, s}, {s, 0, s}, {-s, 0, s}};
    const SurfaceSource surfaces(g, {1, 1, 1}, 0);
    const TriangleSetup setup = set_up_triangle(surfaces.view(), surfaces.view_of(g.meshes[0]), 0);
    EXPECT_EQ(kind(), SurfaceKind::Shaded);
    const Vec3f middle = sample_at(0, setup, {2, 0, 0, 0, 0.5f, 0.5f, 0.0f}).normal;
    EXPECT_NEAR(middle.x, 0.0f, 1e-6f);
    EXPECT_NEAR(middle.z, 1.0f, 1e-6f);
}

TEST(SurfaceSample, LevelsAreTheSameOnAnyNumberOfThreads) {
    Geometry g = square(16.0f);
    g.textures.push_back(needles(256));
    g.materials[0].albedo_map = 0;
    g.materials[0].alpha_mode = AlphaMode::Mask;
    std::vector<float> one, many;
    set_thread_count(1);
    sample_all(g, [&](const SurfaceSample& s) { one.push_back(s.albedo.x); });
    set_thread_count(4);
    sample_all(g, [&](const SurfaceSample& s) { many.push_back(s.albedo.x); });
    set_thread_count(0);
    EXPECT_EQ(one, many);
    const SurfaceSource surfaces(g, {1, 1, 1}, 0);
    EXPECT_EQ(surfaces.bytes(), SurfaceSource::predict_bytes(g));
    EXPECT_EQ(surfaces.bytes(), 8 * (128 * 128 * 4 - 1) / 3);
}

TEST(SurfaceSample, BadInputIsAnErrorAndBadCoordinatesAreHarmless) {
    Geometry g = square(8.0f);
    g.textures.push_back(needles(16));
    g.materials[0].albedo_map = 0;
    const float inf = std::numeric_limits<float>::infinity();
    for (const float bad : {inf, -inf, std::nanf(""), 1e30f, -1e30f}) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::Clamp, Wrap::Mirror}) {
            g.meshes[0].uvs[1] = {bad, bad};
            g.textures[0].wrap_u = g.textures[0].wrap_v = wrap;
            sample_all(g, [&](const SurfaceSample& s) { ASSERT_TRUE(s.albedo.x <= 1.0f); });
        }
    }
    g.textures[0].texels.pop_back();
    EXPECT_THROW(SurfaceSource(g, {1, 1, 1}, 0), Error);
    g.materials[0].albedo_map = 3;
    EXPECT_THROW(SurfaceSource(g, {1, 1, 1}, 0), Error);
}

TEST(SurfaceSample, WrapModesReadAcrossTheBorder) {
    Texture t = make_texture(4, 1, 1, [](int x, int, int) { return x * 85; });
    const auto at = [&](Wrap wrap, float u) {
        t.wrap_u = wrap;
        return FilteredTexture(t, TexelWeight::One, 0.0f, false).at_point({u, 0.5f}).r;
    };
    EXPECT_NEAR(at(Wrap::Repeat, 1.0f), 0.5f, 1e-5f); // half of the last texel, half of the first
    EXPECT_NEAR(at(Wrap::Repeat, -0.125f), 1.0f, 1e-5f);
    EXPECT_NEAR(at(Wrap::Clamp, 7.0f), 1.0f, 1e-5f);
    EXPECT_NEAR(at(Wrap::Clamp, -7.0f), 0.0f, 1e-5f);
    EXPECT_NEAR(at(Wrap::Mirror, 1.125f), 1.0f, 1e-5f);
    EXPECT_NEAR(at(Wrap::Mirror, -0.375f), 1.0f / 3.0f, 1e-5f);
}

TEST(SurfaceSample, HeightAndItsBoundComeFromTheMap) {
    Geometry g = square(64.0f);
    g.textures.push_back(make_texture(4, 4, 1, [](int x, int, int) { return 51 + 51 * x; }));
    g.materials[0].height_map = 0;
    EXPECT_EQ(SurfaceSource(g, {1, 1, 1}, 0).view_of(g.meshes[0]).kind, SurfaceKind::Constant);
    g.materials[0].height_scale = 2.0f;
    g.materials[0].height_offset = -1.0f;
    const SurfaceSource surfaces(g, {1, 1, 1}, 0);
    const MeshView& mesh = surfaces.view_of(g.meshes[0]);
    ASSERT_EQ(mesh.kind, SurfaceKind::Displaced);
    EXPECT_NEAR(surfaces.view().height_of(mesh)({0.125f, 0.5f}), -0.6f, 1e-5f);
    EXPECT_NEAR(max_displacement(g.materials[0], g.textures[0]), 0.6, 1e-6);
}

} // namespace
} // namespace heddle
