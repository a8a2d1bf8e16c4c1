#include <heddle/io/mesh/read_mesh.h>

#include <heddle/io/image/image.h>
#include <heddle/io/mesh/test_files.h>

#include <array>

namespace heddle {
namespace {

class ReadObj : public FileTest {
protected:
    Geometry read(const std::string& text) const { return read_obj(write("a.obj", text)); }
    std::string error(const std::string& text) const {
        return error_of([&] { (void)read(text); });
    }
    void image(const std::string& name, int channels, std::array<std::uint8_t, 4> texel) const {
        std::vector<std::uint8_t> texels;
        for (int i = 0; i < 4; ++i)
            texels.insert(texels.end(), texel.begin(), texel.begin() + channels);
        write_png(folder_ / name, 2, 2, channels, texels);
    }
};

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(ReadObj, AQuadBecomesTwoTrianglesWithFaceNormals) {
    const Geometry g = read(std::string(kSquare) + "f 1 2 3 4\n");
    EXPECT_EQ(g.name, "a");
    ASSERT_EQ(g.meshes.size(), 1u);
    EXPECT_EQ(g.meshes[0].triangles.size(), 2u);
    EXPECT_EQ(g.meshes[0].positions.size(), 4u);
    EXPECT_TRUE(g.meshes[0].normals.empty());
    EXPECT_TRUE(g.meshes[0].uvs.empty());
    EXPECT_EQ(g.materials.at(g.meshes[0].material).kind, MaterialKind::Surface);
}

TEST_F(ReadObj, NegativeIndicesContinuedLinesAndCarriageReturnsAreRead) {
    const Geometry g =
        read("v 0 0 0\r\nv 1 0 0\r\nv +1 1e0 .0\r\nf -3 \\\r\n -2 -1\r\n# end without line feed");
    ASSERT_EQ(g.meshes.at(0).triangles.size(), 1u);
    EXPECT_EQ(g.meshes[0].positions.at(2), (Vec3f{1.0f, 1.0f, 0.0f}));
}

/// `text` with every line break replaced by `end`.
std::string with_line_ends(const std::string& text, const std::string& end) {
    std::string out;
    for (const char c : text) out += c == '\n' ? end : std::string(1, c);
    return out;
}

TEST_F(ReadObj, LinesEndWithACarriageReturnALineFeedOrBoth) {
    write("m.mtl", "newmtl red\rKd 1 0 0\r");
    const std::string text = "# a comment\nmtllib m.mtl\n" + std::string(kSquare) +
                             "usemtl red\nf 1 2 \\\n3 4\n# the end";
    for (const char* end : {"\n", "\r\n", "\r"}) {
        const Geometry g = read(with_line_ends(text, end));
        ASSERT_EQ(g.meshes.size(), 1u);
        EXPECT_EQ(g.meshes[0].triangles.size(), 2u);
        EXPECT_EQ(g.meshes[0].positions.size(), 4u);
        EXPECT_EQ(g.materials.at(0).albedo, (Vec3f{1.0f, 0.0f, 0.0f}));
        EXPECT_TRUE(g.notes.empty());
    }
}

TEST_F(ReadObj, WhatIsBadIsTheSameErrorWithEveryLineEnd) {
    const std::string square = kSquare;
    for (const std::string& text :
         {square + "f 1 2 3000000\n", square + "f 1 2 5\n", square + "f 1//7 2//7 3//7\n",
          square + "f 1/2 2/2 3/2\n", square + "l 1 9\n", square + "# a\nv nan 0 0\nf 1 2 5\n"}) {
        const std::string expected = error(text);
        EXPECT_NE(expected, "no error");
        EXPECT_EQ(error(with_line_ends(text, "\r")), expected);
        EXPECT_EQ(error(with_line_ends(text, "\r\n")), expected);
    }
    EXPECT_NE(error(square + "# a\rf 1 2 5\n").find("a.obj:6: names vertex 5 of 4"),
              std::string::npos)
        << "one alone in a file of line feeds ends a line too";
}

TEST_F(ReadObj, ACornerThatEndsWithASlashHasNoMoreThanStandsBeforeIt) {
    const std::string lists = std::string(kSquare) + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
    for (const char* face : {"f 1/ 2 3\n", "f 1/ 2/ 3/\n", "f 1/\t2/ 3\n", "f 1 2 3/\n"}) {
        for (const std::string& before : {std::string(kSquare), lists}) {
            const Geometry g = read(before + face);
            ASSERT_EQ(g.meshes.at(0).triangles.size(), 1u) << face;
            EXPECT_TRUE(g.meshes[0].uvs.empty()) << face;
            EXPECT_EQ(g.meshes[0].positions.at(1), (Vec3f{1.0f, 0.0f, 0.0f})) << face;
        }
    }
    const Geometry g = read(lists + "f 1/1/ 2/2/ 3/3/\n");
    EXPECT_TRUE(g.meshes.at(0).normals.empty());
    EXPECT_EQ(g.meshes[0].uvs.at(1).u, 1.0f);
    EXPECT_EQ(read(lists + "l 1/ 2\n").curves.at(0).points.size(), 2u);
    EXPECT_NE(error(lists + "f 1// 2 3\n").find("which names no normal"), std::string::npos);
    EXPECT_NE(error(lists + "f 1/1/1/ 2 3\n"), "no error");
}

TEST_F(ReadObj, UvIsTurnedToRunDownTheImageAndSeamsSplitVertices) {
    const Geometry g =
        read(std::string(kSquare) + "vt 0 0.25\nvt 1 0\nvt 1 1\nvt 0.5 0.5\nvn 0 0 2\n"
                                    "f 1/1/1 2/2/1 3/3/1\nf 1/4/1 3/3/1 4/1/1\n");
    const Mesh& mesh = g.meshes.at(0);
    EXPECT_EQ(mesh.positions.size(), 5u); // vertex 1 has two uv
    EXPECT_FLOAT_EQ(mesh.uvs.at(mesh.triangles[0][0]).v, 0.75f);
    EXPECT_EQ(mesh.normals.at(0), (Vec3f{0.0f, 0.0f, 1.0f}));
    EXPECT_TRUE(mesh.tangents.empty());
}

TEST_F(ReadObj, EachUsedMaterialGetsAMesh) {
    write("m.mtl",
          "newmtl red\nKd 1 0 0\nd 0.5\nnewmtl unused\nnewmtl blue\nKd 0 0 1\nPr 0.25\nPm 1\n");
    const Geometry g = read(std::string("mtllib m.mtl\n") + kSquare +
                            "usemtl blue\nf 1 2 3\nusemtl red\nf 1 3 4\nusemtl blue\nf 1 2 4\n");
    ASSERT_EQ(g.meshes.size(), 2u);
    ASSERT_EQ(g.materials.size(), 2u);
    EXPECT_EQ(g.materials[0].name, "blue");
    EXPECT_EQ(g.materials[0].albedo, (Vec3f{0.0f, 0.0f, 1.0f}));
    EXPECT_FLOAT_EQ(g.materials[0].roughness, 0.25f);
    EXPECT_FLOAT_EQ(g.materials[0].metalness, 1.0f);
    EXPECT_EQ(g.meshes[0].triangles.size(), 2u);
    EXPECT_EQ(g.materials[1].alpha_mode, AlphaMode::Blend);
    EXPECT_FLOAT_EQ(g.materials[1].alpha, 0.5f);
}

TEST_F(ReadObj, MapsAreLoadedAndAlphaIsPutIntoTheColour) {
    image("c.png", 3, {10, 20, 30, 0});
    image("mask.png", 1, {77, 0, 0, 0});
    image("n.png", 3, {128, 128, 255, 0});
    write("m.mtl", "newmtl leaf\nKd 0 0 0\nmap_Kd dir\\c.png\nmap_d mask.png\nmap_bump n.png\n");
    const Geometry g = read(std::string("mtllib m.mtl\n") + kSquare +
                            "vt 0 0\nvt 1 0\nvt 1 1\nusemtl leaf\nf 1/1 2/2 3/3\n");
    const Material& leaf = g.materials.at(0);
    EXPECT_EQ(leaf.albedo, (Vec3f{1.0f, 1.0f, 1.0f}));
    EXPECT_EQ(leaf.alpha_mode, AlphaMode::Mask);
    const Texture& color = g.textures.at(static_cast<std::size_t>(leaf.albedo_map));
    EXPECT_TRUE(color.srgb);
    ASSERT_EQ(color.channels, 4);
    EXPECT_EQ((std::vector<std::uint8_t>(color.texels.begin(), color.texels.begin() + 4)),
              (std::vector<std::uint8_t>{10, 20, 30, 77}));
    ASSERT_GE(leaf.normal_map, 0);
    EXPECT_FALSE(g.textures.at(static_cast<std::size_t>(leaf.normal_map)).srgb);
    const Mesh& mesh = g.meshes.at(0); // tangents need normals: flat ones were made
    ASSERT_EQ(mesh.tangents.size(), 3u);
    EXPECT_NEAR(mesh.tangents[0].x, 1.0f, 1e-6f);
    EXPECT_EQ(mesh.tangents[0].w, 1.0f);
}

TEST_F(ReadObj, AMissingMapOrLibraryIsANote) {
    write("m.mtl", "newmtl a\nmap_Kd no.png\n");
    const Geometry g =
        read(std::string("mtllib m.mtl\nmtllib gone.mtl\n") + kSquare + "usemtl a\nf 1 2 3\n");
    EXPECT_EQ(g.materials.at(0).albedo_map, -1);
    ASSERT_EQ(g.notes.size(), 2u);
    EXPECT_NE(g.notes[0].find("gone.mtl"), std::string::npos);
    EXPECT_NE(g.notes[1].find("no.png"), std::string::npos);
}

TEST_F(ReadObj, LinesBecomeLinearCurves) {
    const Geometry g = read(std::string(kSquare) + "l 1 2 3\nl 3 4\n");
    EXPECT_TRUE(g.meshes.empty());
    ASSERT_EQ(g.curves.size(), 1u);
    EXPECT_EQ(g.curves[0].basis, Basis::Linear);
    EXPECT_EQ(g.curves[0].first, (std::vector<std::uint64_t>{0, 3, 5}));
    EXPECT_EQ(g.curves[0].points[4], (Vec3f{0.0f, 1.0f, 0.0f}));
    EXPECT_EQ(g.materials.at(g.curves[0].material).kind, MaterialKind::Fiber);
}

TEST_F(ReadObj, BadStatementsAreErrorsWithTheirLine) {
    const std::string square = kSquare;
    EXPECT_NE(error("v 0 0 0\nv nan 0 0\n").find("a.obj:2: vertex 2 has 'nan'"), std::string::npos);
    EXPECT_NE(error("v 0 inf 0\n").find(":1: vertex 1"), std::string::npos);
    EXPECT_NE(error("v 0 1e300 0\n").find(":1: vertex 1"), std::string::npos);
    EXPECT_NE(error("v 0 0\n").find(":1: vertex 1"), std::string::npos);
    EXPECT_NE(error(square + "f 1 2 5\nv 0 0 0\nf 1 2 99\n").find(":7: names vertex 99 of 5"),
              std::string::npos);
    EXPECT_NE(error(square + "f 1 2 -5\n").find(":5: names vertex -5"), std::string::npos);
    EXPECT_NE(error(square + "f 1 2 0\n").find(":5: a face has the corner '0'"), std::string::npos);
    EXPECT_NE(error(square + "f 1/1 2/1 3/1\n").find("names uv 1 of 0"), std::string::npos);
    EXPECT_NE(error(square + "f 1//1 2//1 3//1\n").find("names normal 1 of 0"), std::string::npos);
    EXPECT_NE(error(square + "f 1 2\n").find("a face has 2 corners"), std::string::npos);
    EXPECT_NE(error(square + "f 1 2 99999999999999999999\n").find(":5: "), std::string::npos);
}

TEST_F(ReadObj, FilesWithoutGeometryAreErrors) {
    EXPECT_NE(error("").find("no face or line"), std::string::npos);
    EXPECT_NE(error(kSquare).find("has 4 vertices and no face or line"), std::string::npos);
    EXPECT_NE(error("just some words\nt a 2147483647/0/0\n").find("no face or line"),
              std::string::npos);
    EXPECT_NE(error(std::string("BCC\x44\0\0", 6)).find("byte 4: a zero byte"), std::string::npos);
    EXPECT_NE(error_of([&] { (void)read_obj(folder_); }).find("is a directory"), std::string::npos);
    EXPECT_NE(error_of([&] { (void)read_obj(folder_ / "no.obj"); }).find("no such file"),
              std::string::npos);
}

TEST_F(ReadObj, MoreThan256MaterialsAreRefused) {
    std::string mtl;
    std::string obj = std::string("mtllib m.mtl\n") + kSquare;
    for (int i = 0; i < 257; ++i) {
        mtl += "newmtl m" + std::to_string(i) + "\n";
        obj += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
    }
    write("m.mtl", mtl);
    EXPECT_NE(error(obj).find("more than 256 materials"), std::string::npos);
}

TEST_F(ReadObj, DamagedFilesNeverCrash) {
    write("m.mtl", "newmtl a\nKd 1 0 0\n");
    const std::string whole = std::string("mtllib m.mtl\n") + kSquare +
                              "vt 0 0\nvn 0 0 1\nusemtl a\nl 1 2\nf 1/1/1 2/1/1 3/1/1 4/1/1\n";
    const int accepted = read_damaged(whole, [&](const std::string& bytes) { (void)read(bytes); });
    EXPECT_LT(accepted, 40); // only those that end after `l 1 2`
    EXPECT_GT(accepted, 0);
}

TEST_F(ReadObj, ADamagedMaterialLibraryNeverCrashes) {
    image("c.png", 3, {10, 20, 30, 0});
    const std::string obj = std::string("mtllib m.mtl\n") + kSquare + "usemtl a\nf 1 2 3\n";
    const std::string whole =
        "newmtl a\nKd 1 0 0\nmap_Kd -clamp on -mm 0 1 c.png\nd 0.5\naniso 0.5\n";
    const int accepted = read_damaged(whole, [&](const std::string& bytes) {
        write("m.mtl", bytes);
        (void)read(obj);
    });
    EXPECT_EQ(accepted, static_cast<int>(whole.size()));
}

TEST_F(ReadObj, AHeightMapIsPutOnEveryMaterialOfAMeshWithUv) {
    Geometry g = read(std::string(kSquare) + "vt 0 0\nf 1/1 2/1 3/1\n");
    image("h.png", 1, {9, 0, 0, 0});
    set_height_map(g, read_image(folder_ / "h.png"), 0.5f, -0.25f);
    const Material& m = g.materials.at(0);
    EXPECT_EQ(g.textures.at(static_cast<std::size_t>(m.height_map)).texels[0], 9);
    EXPECT_FLOAT_EQ(m.height_scale, 0.5f);
    EXPECT_FLOAT_EQ(m.height_offset, -0.25f);
    EXPECT_THROW(set_height_map(g, Texture{}, 1.0f, 0.0f), Error);
    Geometry bare = read(std::string(kSquare) + "f 1 2 3\n");
    EXPECT_THROW(set_height_map(bare, read_image(folder_ / "h.png"), 1.0f, 0.0f), Error);
}

} // namespace
} // namespace heddle
