#include <heddle/io/mesh/read_mesh.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/mesh/add_parts.h>
#include <heddle/io/mesh/obj_indices.h>
#include <heddle/io/mesh/obj_material.h>
#include <heddle/io/mesh/obj_text.h>
#include <heddle/io/mesh/tangents.h>

#include <tiny_obj_loader.h>
#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <sstream>

namespace heddle {
namespace {

namespace fs = std::filesystem;
constexpr std::uint32_t kNone = ~0U;

/// The texts of all material libraries that exist, concatenated.
std::string read_libraries(const fs::path& folder, const ObjText& obj, Geometry& out) {
    std::string text;
    for (const std::string& line : obj.libraries) {
        std::vector<std::string> names{line}; // one name with blanks or several names
        if (!fs::is_regular_file(folder / line)) {
            std::istringstream words(line);
            names.assign(std::istream_iterator<std::string>(words), {});
        }
        for (const std::string& name : names) {
            if (!fs::is_regular_file(folder / name)) {
                out.notes.push_back(str("material library '", name, "' is missing"));
                continue;
            }
            text += read_whole_file((folder / name).string());
            text.push_back('\n');
        }
    }
    return text;
}

/// Builds one mesh per material from corners that have separate indices of position, uv and normal.
class ObjMeshes {
public:
    ObjMeshes(const tinyobj::attrib_t& attrib, Geometry& out)
        : attrib_(attrib), out_(out), chain_(attrib.vertices.size() / 3, kNone) {}

    void add_triangle(const tinyobj::index_t* corners, std::size_t mesh) {
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = vertex_of(corners[k], mesh);
        out_.meshes[mesh].triangles.push_back(triangle);
    }

    std::size_t new_mesh(std::uint32_t material) {
        out_.meshes.emplace_back().material = material;
        has_uv_.push_back(false);
        all_normals_.push_back(true);
        return out_.meshes.size() - 1;
    }

    /// Drops arrays that were not filled by every corner.
    void finish() {
        for (std::size_t m = 0; m < out_.meshes.size(); ++m) {
            Mesh& mesh = out_.meshes[m];
            if (!has_uv_[m]) mesh.uvs = {};
            if (!all_normals_[m]) {
                const bool some = std::any_of(mesh.normals.begin(), mesh.normals.end(),
                                              [](Vec3f n) { return n != Vec3f{}; });
                if (some)
                    out_.notes.emplace_back("some corners have no normal: face normals are taken");
                mesh.normals = {};
            }
        }
    }

private:
    /// A vertex that was made from a position; the vertices of a position form a chain.
    struct Made {
        tinyobj::index_t index;
        std::size_t mesh;
        std::uint32_t vertex;
        std::uint32_t next;
    };

    std::uint32_t vertex_of(const tinyobj::index_t& index, std::size_t mesh) {
        std::uint32_t& first = chain_[static_cast<std::size_t>(index.vertex_index)];
        for (std::uint32_t i = first; i != kNone; i = made_[i].next) {
            const Made& made = made_[i];
            if (made.mesh == mesh && made.index.texcoord_index == index.texcoord_index &&
                made.index.normal_index == index.normal_index)
                return made.vertex;
        }
        const std::uint32_t vertex = new_vertex(index, mesh);
        made_.push_back({index, mesh, vertex, first});
        first = static_cast<std::uint32_t>(made_.size() - 1);
        return vertex;
    }

    std::uint32_t new_vertex(const tinyobj::index_t& index, std::size_t m) {
        Mesh& mesh = out_.meshes[m];
        const float* p = &attrib_.vertices[3 * static_cast<std::size_t>(index.vertex_index)];
        mesh.positions.push_back({p[0], p[1], p[2]});
        Uv uv;
        if (index.texcoord_index >= 0) {
            const float* t = &attrib_.texcoords[2 * static_cast<std::size_t>(index.texcoord_index)];
            uv = {t[0], 1.0f - t[1]};
            has_uv_[m] = true;
        }
        mesh.uvs.push_back(uv);
        Vec3f normal;
        if (index.normal_index >= 0) {
            const float* n = &attrib_.normals[3 * static_cast<std::size_t>(index.normal_index)];
            normal = to_float(normalize(Vec3d{n[0], n[1], n[2]}));
        } else {
            all_normals_[m] = false;
        }
        mesh.normals.push_back(normal);
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }

    const tinyobj::attrib_t& attrib_;
    Geometry& out_;
    std::vector<std::uint32_t> chain_;
    std::vector<Made> made_;
    std::vector<bool> has_uv_;
    std::vector<bool> all_normals_;
};

void add_meshes(const tinyobj::ObjReader& obj, const fs::path& path, Geometry& out) {
    ObjMaterials materials(path.parent_path(), out);
    ObjMeshes meshes(obj.GetAttrib(), out);
    std::map<int, std::size_t> mesh_of; // by material of the file
    for (const tinyobj::shape_t& shape : obj.GetShapes()) {
        for (std::size_t t = 0; t < shape.mesh.material_ids.size(); ++t) {
            const int id = shape.mesh.material_ids[t];
            const auto [place, is_new] = mesh_of.try_emplace(id, 0);
            if (is_new) {
                Material material;
                material.name = "default";
                if (id >= 0)
                    material = materials.convert(obj.GetMaterials()[static_cast<std::size_t>(id)]);
                place->second =
                    meshes.new_mesh(add_material(out, std::move(material), path.string()));
            }
            meshes.add_triangle(&shape.mesh.indices[3 * t], place->second);
        }
    }
    meshes.finish();
    for (Mesh& mesh : out.meshes) {
        const Material& material = out.materials[mesh.material];
        if (material.normal_map >= 0 || material.anisotropy > 0.0f) set_tangents(mesh);
    }
}

void add_lines(const tinyobj::ObjReader& obj, const fs::path& path, Geometry& out) {
    CurveSet lines;
    lines.basis = Basis::Linear;
    lines.first.push_back(0);
    const std::vector<float>& vertices = obj.GetAttrib().vertices;
    for (const tinyobj::shape_t& shape : obj.GetShapes()) {
        std::size_t next = 0;
        for (const int count : shape.lines.num_line_vertices) {
            for (int i = 0; i < count; ++i) {
                const auto p = static_cast<std::size_t>(shape.lines.indices[next++].vertex_index);
                lines.points.push_back({vertices[3 * p], vertices[3 * p + 1], vertices[3 * p + 2]});
            }
            lines.first.push_back(lines.points.size());
        }
    }
    if (lines.curve_count() == 0) return;
    Material fiber;
    fiber.name = "lines";
    fiber.kind = MaterialKind::Fiber;
    lines.material = add_material(out, std::move(fiber), path.string());
    out.curves.push_back(std::move(lines));
}

} // namespace

Geometry read_obj(const fs::path& path) try {
    Geometry out;
    out.name = path.stem().string();
    ObjText text = read_obj_text(path);
    const std::string library = read_libraries(path.parent_path(), text, out);
    text.statements.insert(0, "mtllib library\n"); // here the parser asks for `library`
    tinyobj::ObjReader obj;
    tinyobj::ObjReaderConfig config;
    config.vertex_color = false;
    if (!obj.ParseFromString(text.statements, library, config))
        throw Error(ErrorCode::BadFile, obj.Error(), "export the file again",
                    {.path = path.string()});
    text = {};
    check_obj_indices(obj.GetAttrib(), obj.GetShapes(), path);
    add_meshes(obj, path, out);
    add_lines(obj, path, out);
    if (out.meshes.empty() && out.curves.empty())
        throw Error(
            ErrorCode::BadFile,
            str("has ", obj.GetAttrib().vertices.size() / 3, " vertices and no face or line"),
            "check what kind of file it is", {.path = path.string()});
    return out;
} catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "needs more memory than there is", "split the file",
                {.path = path.string()});
}

} // namespace heddle
