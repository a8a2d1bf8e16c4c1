#include <heddle/io/mesh/obj_indices.h>

#include <heddle/base/error.h>

#include <cstdint>
#include <string>

namespace heddle {
namespace {

/// The lengths of the arrays that corners index.
struct Counts {
    std::size_t positions, uvs, normals;
};

void check_index(int index,
                 std::size_t count,
                 bool may_lack,
                 const char* name,
                 const std::filesystem::path& path) {
    if (may_lack && index == -1) return;
    if (index >= 0 && static_cast<std::size_t>(index) < count) return;
    throw Error(ErrorCode::BadFile,
                str("a corner names ", name, " ", std::int64_t{index} + 1, " of ", count),
                "export the file again", {.path = path.string()});
}

void check_corners(const std::vector<tinyobj::index_t>& corners,
                   const Counts& counts,
                   const std::filesystem::path& path) {
    for (const tinyobj::index_t& corner : corners) {
        check_index(corner.vertex_index, counts.positions, false, "vertex", path);
        check_index(corner.texcoord_index, counts.uvs, true, "uv", path);
        check_index(corner.normal_index, counts.normals, true, "normal", path);
    }
}

} // namespace

void check_obj_indices(const tinyobj::attrib_t& attrib,
                       const std::vector<tinyobj::shape_t>& shapes,
                       const std::filesystem::path& path) {
    const Counts counts{attrib.vertices.size() / 3, attrib.texcoords.size() / 2,
                        attrib.normals.size() / 3};
    for (const tinyobj::shape_t& shape : shapes) {
        check_corners(shape.mesh.indices, counts, path);
        check_corners(shape.lines.indices, counts, path);
    }
}

} // namespace heddle
