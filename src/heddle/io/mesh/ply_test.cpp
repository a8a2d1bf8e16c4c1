#include <heddle/io/mesh/read_mesh.h>

#include <heddle/io/mesh/test_files.h>

#include <algorithm>
#include <cstring>

namespace heddle {
namespace {

class ReadPly : public FileTest {
protected:
    Geometry read(const std::string& bytes) const { return read_ply(write("a.ply", bytes)); }
    std::string error(const std::string& bytes) const {
        return error_of([&] { (void)read(bytes); });
    }
};

std::string header(const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\ncomment made by a test\n" + elements + "end_header\n";
}

constexpr const char* kSquare =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "element face 1\nproperty uchar quality\nproperty list uchar int vertex_indices\n";
constexpr const char* kSquareRows = "0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n7 4 0 1 2 3\n";

/// The rows of the square in binary.
std::string binary_rows(bool big_endian) {
    std::string out;
    const auto put = [&](auto value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        if (big_endian) std::reverse(raw, raw + sizeof value);
        out.append(raw, sizeof value);
    };
    for (const auto& [x, y] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}}) {
        put(x);
        put(y);
        put(0.0f);
        put(std::uint8_t{9});
    }
    put(std::uint8_t{7});
    put(std::uint8_t{4});
    for (const int i : {0, 1, 2, 3}) put(i);
    return out;
}

void expect_square(const Geometry& g) {
    ASSERT_EQ(g.meshes.size(), 1u);
    const Mesh& mesh = g.meshes[0];
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[2], (Vec3f{1.0f, 1.0f, 0.0f}));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
    EXPECT_TRUE(mesh.normals.empty());
}

TEST_F(ReadPly, AllThreeEncodingsGiveTheSameSquare) {
    expect_square(read(header("ascii", kSquare) + kSquareRows));
    expect_square(read(header("binary_little_endian", kSquare) + binary_rows(false)));
    expect_square(read(header("binary_big_endian", kSquare) + binary_rows(true)));
}

TEST_F(ReadPly, NormalsAndUvAreRead) {
    const Geometry g =
        read(header("ascii", "element vertex 3\nproperty double x\nproperty double y\n"
                             "property double z\nproperty float nx\nproperty float ny\n"
                             "property float nz\nproperty float s\nproperty float t\n"
                             "element face 1\nproperty list int uint vertex_index\n") +
             "0 0 0 0 0 2 0 0.25\r\n1 0 0 0 0 2 1 0\r\n0 1 0 0 0 2 0 1\r\n3 0 1 2");
    const Mesh& mesh = g.meshes.at(0);
    EXPECT_EQ(mesh.normals.at(1), (Vec3f{0.0f, 0.0f, 1.0f}));
    EXPECT_FLOAT_EQ(mesh.uvs.at(0).v, 0.75f);
}

TEST_F(ReadPly, EdgesBecomeCurvesWithTheirRadius) {
    const Geometry g =
        read(header("ascii", "element vertex 3\nproperty float x\nproperty float y\n"
                             "property float z\nproperty float radius\n"
                             "element edge 2\nproperty int vertex1\nproperty int vertex2\n") +
             "0 0 0 0.1\n1 0 0 0.2\n2 0 0 0.3\n1 0\n1 2\n");
    EXPECT_TRUE(g.meshes.empty());
    ASSERT_EQ(g.curves.size(), 1u);
    EXPECT_EQ(g.curves[0].curve_count(), 1u);
    EXPECT_EQ(g.curves[0].radius, (std::vector<float>{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(g.materials.at(g.curves[0].material).kind, MaterialKind::Fiber);
}

TEST_F(ReadPly, StripsTurnEveryOtherTriangle) {
    const Geometry g = read(header("ascii", "element vertex 4\nproperty float x\nproperty float y\n"
                                            "property float z\nelement tristrips 1\n"
                                            "property list int int vertex_indices\n") +
                            "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 3\n");
    using T = std::array<std::uint32_t, 3>;
    EXPECT_EQ(g.meshes.at(0).triangles, (std::vector<T>{T{0, 1, 2}, T{2, 1, 3}, T{0, 1, 3}}));
}

TEST_F(ReadPly, CountsLargerThanTheFileAreRefused) {
    for (const char* format : {"ascii", "binary_little_endian"}) {
        std::string elements = kSquare;
        elements.replace(elements.find("vertex 4"), 8, "vertex 400000000000");
        EXPECT_NE(error(header(format, elements) + kSquareRows).find("says 400000000000 rows"),
                  std::string::npos);
    }
    const std::string lists =
        "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uint int vertex_indices\n";
    EXPECT_NE(error(header("ascii", lists) + "0 0 0\n4000000000 0 0 0\n").find("has the length"),
              std::string::npos);
    EXPECT_NE(error(header("ascii", lists) + "0 0 0\n-1 0 0 0\n").find("has the length"),
              std::string::npos);
}

TEST_F(ReadPly, BadValuesAreErrorsWithTheirPlace) {
    const std::string head = header("ascii", kSquare);
    EXPECT_NE(
        error(head + "0 0 0 9\n1 nan 0 9\n1 1 0 9\n0 1 0 9\n7 4 0 1 2 3\n").find("vertex 1 has"),
        std::string::npos);
    EXPECT_NE(
        error(head + "0 0 0 9\n1 1e99 0 9\n1 1 0 9\n0 1 0 9\n7 4 0 1 2 3\n").find("vertex 1 has"),
        std::string::npos);
    EXPECT_NE(error(head + "0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n7 4 0 1 2 4\n")
                  .find("names vertex 4 of 4"),
              std::string::npos);
    EXPECT_NE(error(head + "0 0 0 9\n1 zero 0 9\n1 1 0 9\n0 1 0 9\n7 4 0 1 2 3\n")
                  .find("a.ply:14: 'zero'"),
              std::string::npos);
}

TEST_F(ReadPly, WrongHeadersAreErrors) {
    EXPECT_NE(error("").find("does not begin with 'ply'"), std::string::npos);
    EXPECT_NE(error("solid cube\n").find("does not begin with 'ply'"), std::string::npos);
    EXPECT_NE(error("ply\n").find("end_header"), std::string::npos);
    EXPECT_NE(error("ply\nend_header\n").find("no format"), std::string::npos);
    EXPECT_NE(error(header("ebcdic", "")).find("unknown format"), std::string::npos);
    EXPECT_NE(error(header("ascii", "element vertex -1\n")).find("has the count"),
              std::string::npos);
    EXPECT_NE(error(header("ascii", "property float x\n")).find("before the first"),
              std::string::npos);
    EXPECT_NE(error(header("ascii", "element vertex 1\nproperty quad x\n")).find("cannot read"),
              std::string::npos);
    EXPECT_NE(error(header("ascii", "element rows 18446744073709551615\n")).find("no face or edge"),
              std::string::npos);
    EXPECT_NE(error_of([&] { (void)read_ply(folder_); }).find("is a directory"), std::string::npos);
}

TEST_F(ReadPly, DamagedFilesNeverCrash) {
    const auto reader = [&](const std::string& bytes) { (void)read(bytes); };
    EXPECT_EQ(read_damaged(header("binary_little_endian", kSquare) + binary_rows(false), reader),
              0);
    EXPECT_EQ(read_damaged(header("binary_big_endian", kSquare) + binary_rows(true), reader), 0);
    EXPECT_EQ(read_damaged(header("ascii", kSquare) + kSquareRows, reader), 1); // less a line feed
}

} // namespace
} // namespace heddle
