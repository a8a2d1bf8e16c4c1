#include <heddle/io/mesh/obj_indices.h>

#include <heddle/io/mesh/test_files.h>

namespace heddle {
namespace {

/// Three vertices, two uv, one normal, and a triangle or a line whose last corner is `last`.
std::string check(tinyobj::index_t last, bool line = false) {
    tinyobj::attrib_t attrib;
    attrib.vertices.resize(9);
    attrib.texcoords.resize(4);
    attrib.normals.resize(3);
    tinyobj::shape_t shape;
    (line ? shape.lines.indices : shape.mesh.indices) = {{0, -1, -1}, {1, 0, 1}, last};
    return error_of([&] { check_obj_indices(attrib, {shape}, "a.obj"); });
}

TEST(ObjIndices, OnesThatNameSomethingPass) {
    EXPECT_EQ(check({2, 0, 1}), "no error");
    EXPECT_EQ(check({2, -1, -1}), "no error");
    EXPECT_EQ(check({2, -1, -1}, true), "no error");
}

TEST(ObjIndices, OnesThatNameNothingAreErrors) {
    for (const bool line : {false, true}) {
        EXPECT_EQ(check({3, -1, -1}, line),
                  "a.obj: a corner names vertex 4 of 3; export the file again");
        EXPECT_NE(check({-1, -1, -1}, line).find("names vertex 0 of 3"), std::string::npos);
        EXPECT_NE(check({2, -1, 2}, line).find("names uv 3 of 2"), std::string::npos);
        EXPECT_NE(check({2, -1, -2}, line).find("names uv -1 of 2"), std::string::npos);
        EXPECT_NE(check({2, 1, 0}, line).find("names normal 2 of 1"), std::string::npos);
        EXPECT_NE(check({2, 2147483647, 0}, line).find("names normal 2147483648 of 1"),
                  std::string::npos);
    }
}

} // namespace
} // namespace heddle
