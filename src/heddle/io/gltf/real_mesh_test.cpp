#include <heddle/geom/bounds.h>
#include <heddle/io/gltf/read_gltf.h>
#include <heddle/io/mesh/read_mesh.h>
#include <heddle/io/mesh/tangents.h>
#include <heddle/io/mesh/test_files.h>

#include <cmath>

namespace heddle {
namespace {

namespace fs = std::filesystem;

struct Counts {
    std::size_t meshes, vertices, triangles, materials, textures;
    friend bool operator==(const Counts&, const Counts&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Counts& c) {
        return out << c.meshes << " meshes, " << c.vertices << " vertices, " << c.triangles
                   << " triangles, " << c.materials << " materials, " << c.textures << " textures";
    }
};

Counts counts_of(const Geometry& g) {
    Counts counts{g.meshes.size(), 0, 0, g.materials.size(), g.textures.size()};
    for (const Mesh& mesh : g.meshes) {
        counts.vertices += mesh.positions.size();
        counts.triangles += mesh.triangles.size();
    }
    return counts;
}

Bounds bounds_of(const Geometry& g) {
    Bounds bounds;
    for (const Mesh& mesh : g.meshes) {
        for (const Vec3f p : mesh.positions) bounds.grow(to_double(p));
    }
    return bounds;
}

/// Every array is empty or as long as the positions, every index in range, every frame unit.
void expect_sound(const Geometry& g) {
    for (const Mesh& mesh : g.meshes) {
        const std::size_t n = mesh.positions.size();
        ASSERT_LT(mesh.material, g.materials.size());
        ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == n);
        ASSERT_TRUE(mesh.tangents.empty() || mesh.tangents.size() == n);
        ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == n);
        std::size_t outside = 0;
        for (const auto& triangle : mesh.triangles) {
            for (const std::uint32_t corner : triangle) outside += corner < n ? 0 : 1;
        }
        EXPECT_EQ(outside, 0u);
        std::size_t odd = 0;
        for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
            const Tangent t = mesh.tangents[i];
            const Vec3f along{t.x, t.y, t.z};
            odd += std::abs(length(along) - 1.0f) < 1e-5f && std::abs(t.w) == 1.0f &&
                           std::abs(dot(along, mesh.normals[i])) < 1e-5f
                       ? 0
                       : 1;
        }
        EXPECT_EQ(odd, 0u);
    }
}

class RealMesh : public FileTest {
protected:
    void SetUp() override {
        mesh_ = testing::find_data("mesh");
        if (mesh_.empty()) GTEST_SKIP() << "no meshes; set HEDDLE_TEST_DATA";
    }
    fs::path unpacked(const std::string& name) const {
        const fs::path packed = mesh_ / (name + ".xz");
        const fs::path plain = folder_ / packed.stem();
        const std::string command = "xz -dkc '" + packed.string() + "' > '" + plain.string() + "'";
        if (std::system(command.c_str()) != 0) ADD_FAILURE() << command;
        return plain;
    }
    static const Texture& texture(const Geometry& g, std::int32_t index) {
        return g.textures.at(static_cast<std::size_t>(index));
    }
    fs::path mesh_;
};

TEST_F(RealMesh, SpotHasItsSeams) {
    const Geometry g = read_obj(mesh_ / "spot.obj");
    EXPECT_EQ(counts_of(g), (Counts{1, 3225, 5856, 1, 0}));
    EXPECT_EQ(g.meshes[0].uvs.size(), 3225u);
    expect_sound(g);
}

TEST_F(RealMesh, OgreIsWhole) {
    const Geometry g = read_obj(unpacked("ogre.obj"));
    EXPECT_EQ(counts_of(g), (Counts{1, 62194, 124008, 1, 0}));
    EXPECT_TRUE(g.meshes[0].normals.empty());
    expect_sound(g);
}

TEST_F(RealMesh, BunnyIsWhole) {
    const Geometry g = read_obj(unpacked("stanford-bunny.obj"));
    EXPECT_EQ(counts_of(g), (Counts{1, 34834, 69451, 1, 0})); // of 35947 points, some unused
    EXPECT_NEAR(bounds_of(g).size().x, 0.1557, 1e-4);
    expect_sound(g);
}

TEST_F(RealMesh, CooksoniaKeepsItsNormals) {
    const Geometry g = read_obj(unpacked("foliage/cooksonia.obj"));
    EXPECT_EQ(counts_of(g), (Counts{1, 41142, 77920, 1, 0}));
    EXPECT_EQ(g.meshes[0].normals.size(), 41142u);
    expect_sound(g);
}

TEST_F(RealMesh, DamagedHelmetStandsUprightWithTangentsOfOurOwn) {
    const Geometry g = read_gltf(mesh_ / "DamagedHelmet.glb");
    EXPECT_EQ(counts_of(g), (Counts{1, 14556, 15452, 1, 3}));
    EXPECT_TRUE(g.notes.empty());
    EXPECT_EQ(g.meshes[0].tangents.size(), 14556u);
    EXPECT_EQ(texture(g, g.materials[0].normal_map).width, 2048);
    EXPECT_TRUE(texture(g, g.materials[0].albedo_map).srgb);
    EXPECT_FALSE(texture(g, g.materials[0].metal_rough_map).srgb);
    // the file's z becomes y: its node rotates by 90 degrees about x
    EXPECT_NEAR(bounds_of(g).hi.z, 0.8128, 1e-3);
    EXPECT_NEAR(bounds_of(g).hi.y, 0.9010, 1e-3);
    expect_sound(g);
}

TEST_F(RealMesh, AnisotropyStrengthTestHas49Strengths) {
    const Geometry g = read_gltf(mesh_ / "AnisotropyStrengthTest.glb");
    EXPECT_EQ(counts_of(g), (Counts{50, 53311, 97240, 50, 1}));
    EXPECT_NEAR(g.materials.at(5).anisotropy, 5.0 / 6.0, 1e-6);
    EXPECT_TRUE(g.meshes.at(0).tangents.empty()); // strength 0 needs none
    EXPECT_FALSE(g.meshes.at(5).tangents.empty());
    expect_sound(g);
}

TEST_F(RealMesh, OurTangentsAreThoseStoredInAnisotropyStrengthTest) {
    const Geometry g = read_gltf(mesh_ / "AnisotropyStrengthTest.glb");
    Mesh ours = g.meshes.at(5);
    const Mesh& stored = g.meshes.at(5);
    set_tangents(ours);
    ASSERT_EQ(ours.positions.size(), stored.positions.size());
    for (std::size_t i = 0; i < stored.tangents.size(); ++i) {
        const Tangent a = stored.tangents[i];
        const Tangent b = ours.tangents[i];
        ASSERT_EQ(a.w, b.w) << i;
        ASSERT_GT(a.x * b.x + a.y * b.y + a.z * b.z, 0.99999f) << i;
    }
}

TEST_F(RealMesh, BarnLampTakesTheJpegForItsMissingPng) {
    const Geometry g = read_gltf(mesh_ / "AnisotropyBarnLamp" / "AnisotropyBarnLamp.gltf");
    EXPECT_EQ(counts_of(g), (Counts{3, 7716, 10203, 3, 4}));
    const Material& metal = g.materials.at(0);
    EXPECT_EQ(metal.name, "lamp metal");
    EXPECT_FLOAT_EQ(metal.anisotropy, 0.75f);
    EXPECT_NEAR(metal.anisotropy_rotation, 0.785398f, 1e-6f);
    EXPECT_EQ(texture(g, metal.albedo_map).name, "AnisotropyBarnLamp_basecolor.jpeg");
    EXPECT_TRUE(texture(g, metal.albedo_map).srgb);
    EXPECT_FALSE(texture(g, metal.anisotropy_map).srgb);
    ASSERT_EQ(g.notes.size(), 1u);
    EXPECT_NE(g.notes[0].find("basecolor.png' is missing"), std::string::npos);
    expect_sound(g);
}

TEST_F(RealMesh, SheenClothIsTiledByItsTextureTransform) {
    const Geometry g = read_gltf(mesh_ / "SheenCloth" / "SheenCloth.gltf");
    EXPECT_EQ(counts_of(g), (Counts{1, 58081, 115200, 1, 3}));
    float lo = 1e9f;
    float hi = -1e9f;
    for (const Uv uv : g.meshes[0].uvs) {
        lo = std::min(lo, uv.u);
        hi = std::max(hi, uv.u);
    }
    EXPECT_GT(hi - lo, 20.0f); // 30 tiles over a chart that fills most of the unit square
    expect_sound(g);
}

TEST_F(RealMesh, SmallpineFindsItsImagesOutsideTheNamedFolder) {
    const Geometry g = read_gltf(mesh_ / "smallpine" / "scene.gltf");
    EXPECT_EQ(counts_of(g), (Counts{2, 1404, 1650, 2, 4}));
    const Material& needles = g.materials.at(1);
    EXPECT_EQ(needles.alpha_mode, AlphaMode::Blend);
    EXPECT_EQ(texture(g, needles.albedo_map).channels, 4);
    EXPECT_EQ(needles.normal_map, -1);
    EXPECT_GE(needles.metal_rough_map, 0);
    bool said = false;
    for (const std::string& note : g.notes)
        said |= note.find("M_TreeAtlas_normal.png' is missing: its map") != std::string::npos;
    EXPECT_TRUE(said);
    EXPECT_NEAR(bounds_of(g).hi.y, 75.0142, 1e-3); // upright after four nodes
    expect_sound(g);
}

} // namespace
} // namespace heddle
