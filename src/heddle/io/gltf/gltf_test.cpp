#include <heddle/io/gltf/read_gltf.h>

#include <heddle/io/gltf/write_glb.h>
#include <heddle/io/image/image.h>
#include <heddle/io/mesh/test_files.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

namespace heddle {
namespace {

using Json = nlohmann::json;

/// A .gltf under construction: arrays are stored in one external buffer, a.bin.
class Scene {
public:
    Scene() {
        json["asset"]["version"] = "2.0";
        json["nodes"] = Json::array({{{"mesh", 0}}});
        json["materials"] = Json::array({{{"name", "m"}}});
    }

    /// Adds an accessor over `values` and returns its index.
    template <typename T>
    int add(const std::vector<T>& values, const char* type, int components, int component_type) {
        const Json view{
            {"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", values.size() * sizeof(T)}};
        bin.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        while (bin.size() % 4 != 0) bin.push_back('\0');
        json["bufferViews"].push_back(view);
        json["accessors"].push_back(
            {{"bufferView", json["bufferViews"].size() - 1},
             {"componentType", component_type},
             {"count", values.size() / static_cast<std::size_t>(components)},
             {"type", type}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    int add3(const std::vector<float>& values) { return add(values, "VEC3", 3, 5126); }
    int add2(const std::vector<float>& values) { return add(values, "VEC2", 2, 5126); }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }

    /// The triangle (0,0,0) (1,0,0) (0,1,0) with normals up.
    Scene& triangle() {
        primitive()["attributes"]["POSITION"] = add3({0, 0, 0, 1, 0, 0, 0, 1, 0});
        primitive()["attributes"]["NORMAL"] = add3({0, 0, 1, 0, 0, 1, 0, 0, 1});
        primitive()["material"] = 0;
        return *this;
    }

    Json json;
    std::string bin;
};

class ReadGltf : public FileTest {
protected:
    Geometry read(Scene& scene) const {
        scene.json["buffers"] = Json::array({{{"uri", "a.bin"}, {"byteLength", scene.bin.size()}}});
        write("a.bin", scene.bin);
        return read_gltf(write("a.gltf", scene.json.dump()));
    }
    std::string error(Scene& scene) const {
        return error_of([&] { (void)read(scene); });
    }
    void image(const std::string& name, int channels) const {
        const std::vector<std::uint8_t> texels(static_cast<std::size_t>(4 * channels), 200);
        write_png(folder_ / name, 2, 2, channels, texels);
    }
};

void expect_near(Vec3f a, Vec3f b) {
    EXPECT_NEAR(a.x, b.x, 1e-6f);
    EXPECT_NEAR(a.y, b.y, 1e-6f);
    EXPECT_NEAR(a.z, b.z, 1e-6f);
}

Texture texture(int width, int height, int channels, bool srgb, Wrap wrap) {
    Texture t;
    t.width = width;
    t.height = height;
    t.channels = channels;
    t.srgb = srgb;
    t.name = "t";
    t.wrap_u = wrap;
    for (int i = 0; i < width * height * channels; ++i)
        t.texels.push_back(static_cast<std::uint8_t>(i * 29));
    return t;
}

/// Two meshes, two materials, every map.
Geometry everything() {
    Geometry g;
    g.textures = {texture(3, 2, 4, true, Wrap::Mirror), texture(2, 2, 3, false, Wrap::Clamp),
                  texture(1, 2, 3, false, Wrap::Repeat)};
    Material metal;
    metal.name = "metal";
    metal.albedo = {0.1f, 0.2f, 0.3f};
    metal.roughness = 0.35f;
    metal.metalness = 0.75f;
    metal.anisotropy = 0.6f;
    metal.anisotropy_rotation = 1.25f;
    metal.anisotropy_map = 2;
    metal.normal_map = 1;
    metal.normal_scale = 0.5f;
    metal.metal_rough_map = 1;
    Material leaf;
    leaf.name = "leaf";
    leaf.alpha_mode = AlphaMode::Mask;
    leaf.alpha = 0.9f;
    leaf.alpha_cutoff = 0.25f;
    leaf.albedo_map = 0;
    g.materials = {metal, leaf};
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.tangents = {{1, 0, 0, -1}, {1, 0, 0, -1}, {0, 1, 0, -1}};
    mesh.uvs = {{0, 0}, {1, 0}, {0, 0.5f}};
    mesh.triangles = {{0, 1, 2}};
    g.meshes = {mesh, mesh};
    g.meshes[1].tangents.clear();
    g.meshes[1].material = 1;
    return g;
}

TEST_F(ReadGltf, AGlbReadsBackAsWritten) {
    const Geometry g = everything();
    write_glb(g, folder_ / "plate.glb");
    const Geometry read = read_gltf(folder_ / "plate.glb");
    EXPECT_EQ(read.name, "plate");
    EXPECT_TRUE(read.notes.empty());
    ASSERT_EQ(read.meshes.size(), 2u);
    for (std::size_t m = 0; m < 2; ++m) {
        EXPECT_EQ(read.meshes[m].positions, g.meshes[m].positions);
        EXPECT_EQ(read.meshes[m].normals, g.meshes[m].normals);
        EXPECT_EQ(read.meshes[m].triangles, g.meshes[m].triangles);
        EXPECT_EQ(read.meshes[m].uvs[2].v, 0.5f);
        ASSERT_EQ(read.meshes[m].tangents.size(), g.meshes[m].tangents.size());
    }
    EXPECT_EQ(read.meshes[0].tangents[2].y, 1.0f);
    EXPECT_EQ(read.meshes[0].tangents[2].w, -1.0f);
    const Material& metal = read.materials.at(0);
    EXPECT_EQ(metal.name, "metal");
    EXPECT_EQ(metal.albedo, g.materials[0].albedo);
    EXPECT_EQ(metal.roughness, 0.35f);
    EXPECT_EQ(metal.metalness, 0.75f);
    EXPECT_EQ(metal.anisotropy, 0.6f);
    EXPECT_EQ(metal.anisotropy_rotation, 1.25f);
    EXPECT_EQ(metal.normal_scale, 0.5f);
    EXPECT_EQ(metal.normal_map, metal.metal_rough_map); // one texture, used twice
    const Material& leaf = read.materials.at(1);
    EXPECT_EQ(leaf.alpha_mode, AlphaMode::Mask);
    EXPECT_EQ(leaf.alpha, 0.9f);
    EXPECT_EQ(leaf.alpha_cutoff, 0.25f);
    const auto expect_texture = [&](std::int32_t index, const Texture& written) {
        const Texture& t = read.textures.at(static_cast<std::size_t>(index));
        EXPECT_EQ(t.texels, written.texels);
        EXPECT_EQ(t.srgb, written.srgb);
        EXPECT_EQ(t.wrap_u, written.wrap_u);
        EXPECT_EQ(t.wrap_v, written.wrap_v);
    };
    expect_texture(leaf.albedo_map, g.textures[0]);
    expect_texture(metal.normal_map, g.textures[1]);
    expect_texture(metal.anisotropy_map, g.textures[2]);
}

TEST_F(ReadGltf, WhatAGlbCannotHoldIsRefused) {
    Geometry g = everything();
    g.materials[0].height_map = 0;
    EXPECT_THROW(write_glb(g, folder_ / "a.glb"), Error);
    g = everything();
    g.curves.emplace_back();
    EXPECT_THROW(write_glb(g, folder_ / "a.glb"), Error);
    EXPECT_THROW(write_glb(Geometry{}, folder_ / "a.glb"), Error);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.glb"));
    EXPECT_NE(
        error_of([&] { write_glb(everything(), folder_ / "no" / "a.glb"); }).find("cannot open"),
        std::string::npos);
}

TEST_F(ReadGltf, NodesTurnScaleAndMoveInThatOrder) {
    Scene scene;
    scene.triangle();
    const double h = std::sqrt(0.5);
    scene.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                           {{"mesh", 0}, {"rotation", {0, 0, h, h}}, {"scale", {2, 1, 1}}}};
    const Geometry g = read(scene);
    const Mesh& mesh = g.meshes.at(0);
    expect_near(mesh.positions[1], {10, 2, 0}); // (1,0,0) scaled to 2, rotated to y, moved
    expect_near(mesh.positions[2], {9, 0, 0});
    expect_near(mesh.normals[0], {0, 0, 1});
}

TEST_F(ReadGltf, NormalsFollowTheInverseTranspose) {
    Scene scene;
    scene.triangle();
    const float d = std::sqrt(0.5f);
    scene.primitive()["attributes"]["NORMAL"] = scene.add3({d, 0, d, d, 0, d, d, 0, d});
    scene.json["nodes"][0]["scale"] = {2, 1, 1};
    expect_near(read(scene).meshes.at(0).normals[0], normalize(Vec3f{0.5f, 0.0f, 1.0f}));
}

TEST_F(ReadGltf, AMirroringNodeFlipsWindingAndHandedness) {
    Scene scene;
    scene.triangle();
    scene.json["materials"][0]["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] =
        0.5;
    scene.primitive()["attributes"]["TANGENT"] =
        scene.add(std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4, 5126);
    scene.json["nodes"][0]["scale"] = {-1, 1, 1};
    const Geometry g = read(scene);
    const Mesh& mesh = g.meshes.at(0);
    const auto [a, b, c] = mesh.triangles.at(0);
    const Vec3f face =
        cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    EXPECT_GT(dot(face, mesh.normals[0]), 0.0f);
    expect_near(mesh.normals[0], {0, 0, 1});
    EXPECT_EQ(mesh.tangents[0].x, -1.0f);
    EXPECT_EQ(mesh.tangents[0].w, -1.0f); // the bitangent stays (0, 1, 0)
}

TEST_F(ReadGltf, EveryInstanceIsPlaced) {
    Scene scene;
    scene.triangle();
    const int offsets = scene.add3({0, 0, 1, 0, 0, 2, 0, 0, 3});
    scene.json["nodes"] = {
        {{"mesh", 0}},
        {{"mesh", 0},
         {"translation", {5, 0, 0}},
         {"extensions",
          {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", offsets}}}}}}}}};
    const Geometry g = read(scene);
    ASSERT_EQ(g.meshes.size(), 1u); // one primitive, one mesh
    EXPECT_EQ(g.meshes[0].triangles.size(), 4u);
    expect_near(g.meshes[0].positions[9], {5, 0, 3});
    EXPECT_EQ(g.materials.size(), 1u);
}

TEST_F(ReadGltf, StripsAndFansKeepTheirWinding) {
    Scene scene;
    scene.primitive()["attributes"]["POSITION"] = scene.add3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    scene.primitive()["indices"] =
        scene.add(std::vector<std::uint16_t>{0, 1, 2, 3}, "SCALAR", 1, 5123);
    scene.primitive()["mode"] = 5;
    const Geometry strip = read(scene);
    EXPECT_EQ(strip.meshes.at(0).triangles.size(), 2u);
    for (const Vec3f n : strip.meshes[0].normals) expect_near(n, {0, 0, 1});
    scene.json["meshes"][0]["primitives"][0]["indices"] =
        scene.add(std::vector<std::uint8_t>{0, 1, 3, 2}, "SCALAR", 1, 5121);
    scene.primitive()["mode"] = 6;
    const Geometry fan = read(scene);
    EXPECT_EQ(fan.meshes.at(0).triangles.size(), 2u);
    for (const Vec3f n : fan.meshes[0].normals) expect_near(n, {0, 0, 1}); // flat: none in file
}

TEST_F(ReadGltf, NormalizedIntegersAndSparseElementsAreRead) {
    Scene scene;
    scene.triangle();
    const int uv = scene.add(std::vector<std::uint16_t>{0, 65535, 65535, 0, 0, 0}, "VEC2", 2, 5123);
    scene.json["accessors"][static_cast<std::size_t>(uv)]["normalized"] = true;
    scene.primitive()["attributes"]["TEXCOORD_0"] = uv;
    scene.add(std::vector<std::uint8_t>{2}, "SCALAR", 1, 5121);
    const auto where = scene.json["bufferViews"].size() - 1;
    scene.add3({0, 7, 0});
    scene.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", where}, {"componentType", 5121}}},
        {"values", {{"bufferView", where + 1}}}};
    const Geometry g = read(scene);
    EXPECT_EQ(g.meshes.at(0).uvs.at(0).v, 1.0f);
    EXPECT_EQ(g.meshes[0].uvs[1].u, 1.0f);
    expect_near(g.meshes[0].positions[2], {0, 7, 0});
    scene.json["accessors"][0]["sparse"]["indices"]["bufferView"] = 99;
    EXPECT_NE(error(scene).find("names buffer view 99"), std::string::npos);
}

TEST_F(ReadGltf, MapsBringTheirTransformWrapAndColourSpace) {
    Scene scene;
    scene.triangle();
    image("a b.png", 1);
    scene.primitive()["attributes"]["TEXCOORD_0"] = scene.add2({9, 9, 9, 9, 9, 9});
    scene.primitive()["attributes"]["TEXCOORD_1"] = scene.add2({0, 0, 1, 0, 0, 1});
    scene.json["images"] = {{{"uri", "a%20b.png"}}};
    scene.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
    scene.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    const double quarter = std::acos(0.0);
    const Json info{{"index", 0},
                    {"texCoord", 1},
                    {"extensions",
                     {{"KHR_texture_transform",
                       {{"offset", {0.5, 0.25}}, {"rotation", quarter}, {"scale", {2, 3}}}}}}};
    Json& material = scene.json["materials"][0];
    material["pbrMetallicRoughness"]["baseColorTexture"] = info;
    material["normalTexture"] = info;
    material["alphaMode"] = "BLEND";
    const Geometry g = read(scene);
    EXPECT_TRUE(g.notes.empty());
    const Mesh& mesh = g.meshes.at(0);
    EXPECT_NEAR(mesh.uvs[1].u, 0.5f, 1e-6f); // (2, 0) rotated by a quarter: (0, -2)
    EXPECT_NEAR(mesh.uvs[1].v, -1.75f, 1e-6f);
    EXPECT_NEAR(mesh.uvs[2].u, 3.5f, 1e-6f); // (0, 3): (3, 0)
    EXPECT_EQ(mesh.tangents.size(), 3u);
    ASSERT_EQ(g.textures.size(), 2u); // as colour and as numbers
    const Material& m = g.materials.at(0);
    EXPECT_EQ(m.alpha_mode, AlphaMode::Blend);
    const Texture& color = g.textures.at(static_cast<std::size_t>(m.albedo_map));
    EXPECT_TRUE(color.srgb);
    EXPECT_EQ(color.channels, 3); // grey became RGB
    EXPECT_EQ(color.wrap_u, Wrap::Clamp);
    EXPECT_EQ(color.wrap_v, Wrap::Mirror);
    EXPECT_FALSE(g.textures.at(static_cast<std::size_t>(m.normal_map)).srgb);
}

TEST_F(ReadGltf, AMissingImageIsTakenFromItsSiblingOrDroppedWithANote) {
    Scene scene;
    scene.triangle();
    image("color.png", 3);
    write("broken.png", "no image");
    scene.json["images"] = {
        {{"uri", "maps/color.jpg"}}, {{"uri", "gone.png"}}, {{"uri", "broken.png"}}};
    scene.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
    Json& material = scene.json["materials"][0];
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"] = 2;
    material["normalTexture"]["index"] = 1;
    const Geometry g = read(scene);
    EXPECT_EQ(g.materials.at(0).albedo_map, 0);
    EXPECT_EQ(g.materials[0].normal_map, -1);
    EXPECT_EQ(g.materials[0].metal_rough_map, -1);
    ASSERT_EQ(g.notes.size(), 3u);
    EXPECT_NE(g.notes[0].find("'color.png' is taken in its place"), std::string::npos);
    EXPECT_NE(g.notes[1].find("'gone.png' is missing"), std::string::npos);
    EXPECT_NE(g.notes[2].find("not a PNG or JPEG"), std::string::npos);
    EXPECT_TRUE(g.meshes.at(0).tangents.empty()); // without a normal map it needs none
}

TEST_F(ReadGltf, SpecularGlossinessGivesItsDiffuseColour) {
    Scene scene;
    scene.triangle();
    scene.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"diffuseFactor", {0.1, 0.2, 0.3, 0.4}}, {"glossinessFactor", 0.25}};
    const Material m = read(scene).materials.at(0);
    EXPECT_EQ(m.albedo, (Vec3f{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(m.alpha, 0.4f);
    EXPECT_EQ(m.roughness, 0.75f);
    EXPECT_EQ(m.metalness, 0.0f);
}

TEST_F(ReadGltf, NodesInCyclesOrWithTwoParentsAreRefused) {
    Scene scene;
    scene.triangle();
    scene.json["scenes"] = {{{"nodes", {0}}}};
    scene.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
    EXPECT_NE(error(scene).find("its own ancestor"), std::string::npos);
    scene.json["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}};
    EXPECT_NE(error(scene).find("two parents"), std::string::npos);
    scene.json["nodes"] = {{{"children", {7}}}};
    EXPECT_NE(error(scene).find("names node 7 of 1"), std::string::npos);
    scene.json["nodes"] = {{{"mesh", 3}}};
    EXPECT_NE(error(scene).find("names mesh 3 of 1"), std::string::npos);
    scene.json["scenes"] = {{{"nodes", Json::array()}}};
    EXPECT_NE(error(scene).find("no triangle"), std::string::npos);
}

TEST_F(ReadGltf, ArraysThatDoNotFitAreRefused) {
    Scene scene;
    scene.triangle();
    scene.json["accessors"][0]["count"] = 4;
    EXPECT_NE(error(scene).find("POSITION has 4 elements, and its buffer view holds only 3"),
              std::string::npos);
    scene.json["accessors"][0]["count"] = 9000000000000000000;
    EXPECT_NE(error(scene).find("holds only 3"), std::string::npos);
    scene.json["accessors"][0]["byteOffset"] = 9000000000000000000;
    EXPECT_NE(error(scene).find("holds only 0"), std::string::npos);
    Scene zeros;
    zeros.triangle();
    zeros.json["accessors"][0].erase("bufferView");
    zeros.json["accessors"][0]["count"] = 4000000000;
    EXPECT_NE(error(zeros).find("no buffer view"), std::string::npos);
    Scene view;
    view.triangle();
    view.json["bufferViews"][0]["byteLength"] = 4000000000;
    EXPECT_NE(error(view).find("buffer view 0 has 4000000000 bytes"), std::string::npos);
    Scene index;
    index.triangle();
    index.primitive()["indices"] =
        index.add(std::vector<std::uint16_t>{0, 1, 3}, "SCALAR", 1, 5123);
    EXPECT_NE(error(index).find("index 2 names vertex 3 of 3"), std::string::npos);
    Scene shorter;
    shorter.triangle();
    shorter.primitive()["attributes"]["NORMAL"] = shorter.add3({0, 0, 1});
    EXPECT_NE(error(shorter).find("NORMAL has 1 elements, POSITION has 3"), std::string::npos);
}

TEST_F(ReadGltf, PositionsThatAreNotFiniteAreRefused) {
    Scene scene;
    scene.primitive()["attributes"]["POSITION"] = scene.add3({0, 0, 0, 1, 0, 0, 0, NAN, 0});
    EXPECT_NE(error(scene).find("POSITION of vertex 2 has the value nan"), std::string::npos);
    Scene moved;
    moved.triangle();
    moved.json["nodes"][0]["scale"] = {1e39, 1, 1};
    EXPECT_NE(error(moved).find("vertex 1 out of the finite numbers"), std::string::npos);
}

TEST_F(ReadGltf, MissingBuffersAndForeignFilesAreErrors) {
    Scene scene;
    scene.triangle();
    scene.json["buffers"] = {{{"uri", "gone.bin"}, {"byteLength", 72}}};
    const auto path = write("b.gltf", scene.json.dump());
    EXPECT_NE(error_of([&] { (void)read_gltf(path); }).find("gone.bin"), std::string::npos);
    const auto error_in = [&](const std::string& bytes) {
        const auto file = write("c.gltf", bytes);
        return error_of([&] { (void)read_gltf(file); });
    };
    EXPECT_NE(error_in("").find("c.gltf: "), std::string::npos);
    EXPECT_NE(error_in("v 0 0 0\n").find("c.gltf: "), std::string::npos);
    EXPECT_NE(error_in("{}").find("c.gltf: "), std::string::npos);
    EXPECT_NE(error_in("glTF").find("a .glb has 20 or more"), std::string::npos);
    EXPECT_NE(error_in("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(100000, '['))
                  .find("nested deeper"),
              std::string::npos);
    EXPECT_NE(error_of([&] { (void)read_gltf(folder_); }).find("is a directory"),
              std::string::npos);
}

TEST_F(ReadGltf, MoreThan256MaterialsAreRefused) {
    Scene scene;
    scene.triangle();
    for (std::size_t i = 1; i < 257; ++i) {
        scene.json["materials"].push_back({{"name", "m"}});
        scene.json["meshes"][0]["primitives"].push_back(scene.primitive());
        scene.json["meshes"][0]["primitives"][i]["material"] = i;
    }
    EXPECT_NE(error(scene).find("more than 256 materials"), std::string::npos);
}

TEST_F(ReadGltf, DamagedFilesNeverCrash) {
    Geometry g = everything();
    g.meshes.resize(1);
    write_glb(g, folder_ / "whole.glb");
    const auto reader = [&](const std::string& bytes) { (void)read_gltf(write("a.glb", bytes)); };
    EXPECT_EQ(read_damaged(bytes_of(folder_ / "whole.glb"), reader), 0);
    Scene scene;
    scene.triangle();
    (void)read(scene);
    EXPECT_EQ(read_damaged(bytes_of(folder_ / "a.gltf"), reader), 0);
}

} // namespace
} // namespace heddle
