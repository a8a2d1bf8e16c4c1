#include <heddle/io/mesh/read_mesh.h>

#include <heddle/base/error.h>
#include <heddle/io/mesh/edge_chains.h>
#include <heddle/io/mesh/ply_data.h>

#include <array>
#include <cmath>
#include <new>
#include <optional>

namespace heddle {
namespace {

/// The data of a file's elements, before they become a Geometry.
struct PlyParts {
    Mesh mesh;
    std::vector<float> radius;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::uint64_t small_faces = 0; ///< with fewer than 3 corners
};

/// Reads a row's values in file order; lists are skipped.
void read_row(PlyData& file, const PlyElement& element, std::vector<double>& row) {
    row.assign(element.properties.size(), 0.0);
    for (std::size_t i = 0; i < row.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.is_list)
            file.skip(property);
        else
            row[i] = file.next(property.type);
    }
}

/// The columns of a vector attribute; used if all exist.
template <std::size_t N>
struct Columns {
    std::array<int, N> index{};
    [[nodiscard]] bool all() const {
        for (const int i : index) {
            if (i < 0) return false;
        }
        return true;
    }
    [[nodiscard]] float at(const std::vector<double>& row, std::size_t k) const {
        return static_cast<float>(row[static_cast<std::size_t>(index[k])]);
    }
};

void read_vertices(PlyData& file, const PlyElement& element, PlyParts& out) {
    const Columns<3> p{{element.find({"x"}), element.find({"y"}), element.find({"z"})}};
    const Columns<3> n{{element.find({"nx"}), element.find({"ny"}), element.find({"nz"})}};
    const Columns<2> uv{
        {element.find({"u", "s", "texture_u"}), element.find({"v", "t", "texture_v"})}};
    const Columns<1> radius{{element.find({"radius"})}};
    if (!p.all()) file.fail("element 'vertex' has no x, y and z");
    if (element.count > ~std::uint32_t{0})
        file.fail(str(element.count, " vertices, the limit is 2^32 - 1"));
    out.mesh.positions.reserve(element.count);
    std::vector<double> row;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        read_row(file, element, row);
        for (const double value : row) {
            if (!std::isfinite(static_cast<float>(value)))
                file.fail(str("vertex ", i, " has the value ", value, ", all must be finite"));
        }
        out.mesh.positions.push_back({p.at(row, 0), p.at(row, 1), p.at(row, 2)});
        if (n.all())
            out.mesh.normals.push_back(
                to_float(normalize(Vec3d{n.at(row, 0), n.at(row, 1), n.at(row, 2)})));
        if (uv.all()) out.mesh.uvs.push_back({uv.at(row, 0), 1.0f - uv.at(row, 1)});
        if (radius.all()) out.radius.push_back(radius.at(row, 0));
    }
}

std::uint32_t vertex_index(PlyData& file, double value, std::size_t vertices, std::uint64_t row) {
    if (!(value >= 0.0) || value >= static_cast<double>(vertices) || value != std::floor(value))
        file.fail(str("row ", row, " names vertex ", value, " of ", vertices));
    return static_cast<std::uint32_t>(value);
}

void read_faces(PlyData& file, const PlyElement& element, PlyParts& out) {
    const int wanted = element.find({"vertex_indices", "vertex_index"});
    if (wanted < 0 || !element.properties[static_cast<std::size_t>(wanted)].is_list)
        file.fail("element 'face' has no list 'vertex_indices'");
    std::vector<std::uint32_t> corners;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            if (k != static_cast<std::size_t>(wanted)) {
                file.skip(property);
                continue;
            }
            corners.resize(file.next_count(property));
            for (std::uint32_t& corner : corners)
                corner = vertex_index(file, file.next(property.type), out.mesh.positions.size(), i);
        }
        out.small_faces += corners.size() < 3 ? 1 : 0;
        for (std::size_t k = 2; k < corners.size(); ++k)
            out.mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
}

/// Strips end with -1; every other triangle of a strip has reversed winding   [Stanford archive]
void read_strips(PlyData& file, const PlyElement& element, PlyParts& out) {
    const int wanted = element.find({"vertex_indices", "vertex_index"});
    if (wanted != 0 || element.properties.size() != 1 || !element.properties[0].is_list)
        file.fail("element 'tristrips' is not one list 'vertex_indices'");
    for (std::uint64_t i = 0; i < element.count; ++i) {
        const std::uint64_t count = file.next_count(element.properties[0]);
        std::array<std::uint32_t, 2> last{};
        std::uint64_t length = 0;
        for (std::uint64_t k = 0; k < count; ++k) {
            const double value = file.next(element.properties[0].type);
            if (value == -1.0) {
                length = 0;
                continue;
            }
            const std::uint32_t v = vertex_index(file, value, out.mesh.positions.size(), i);
            if (length >= 2 && length % 2 == 0) out.mesh.triangles.push_back({last[0], last[1], v});
            if (length >= 2 && length % 2 == 1) out.mesh.triangles.push_back({last[1], last[0], v});
            last = {last[1], v};
            ++length;
        }
    }
}

void read_edges(PlyData& file, const PlyElement& element, PlyParts& out) {
    const Columns<2> ends{{element.find({"vertex1"}), element.find({"vertex2"})}};
    if (!ends.all()) file.fail("element 'edge' has no vertex1 and vertex2");
    std::vector<double> row;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        read_row(file, element, row);
        std::array<std::uint32_t, 2> edge{};
        for (std::size_t k = 0; k < 2; ++k)
            edge[k] = vertex_index(file, row[static_cast<std::size_t>(ends.index[k])],
                                   out.mesh.positions.size(), i);
        out.edges.push_back(edge);
    }
}

PlyParts read_parts(PlyData& file) {
    PlyParts out;
    for (const PlyElement& element : file.elements()) {
        file.check_rows(element);
        if (element.name == "vertex") {
            if (!out.mesh.positions.empty()) file.fail("has a second element 'vertex'");
            read_vertices(file, element, out);
        } else if (element.name == "face") {
            read_faces(file, element, out);
        } else if (element.name == "tristrips") {
            read_strips(file, element, out);
        } else if (element.name == "edge") {
            read_edges(file, element, out);
        } else if (!element.properties.empty()) {
            std::vector<double> row;
            for (std::uint64_t i = 0; i < element.count; ++i) read_row(file, element, row);
        }
    }
    return out;
}

Material named(const char* name, MaterialKind kind) {
    Material material;
    material.name = name;
    material.kind = kind;
    return material;
}

} // namespace

Geometry read_ply(const std::filesystem::path& path) try {
    PlyData file(path);
    PlyParts parts = read_parts(file);
    Geometry out;
    out.name = path.stem().string();
    if (parts.small_faces > 0)
        out.notes.push_back(str(parts.small_faces, " faces have fewer than 3 corners: left out"));
    CurveSet curves = chain_edges(parts.mesh.positions, parts.radius, parts.edges);
    if (parts.mesh.triangles.empty() && curves.curve_count() == 0)
        throw Error(ErrorCode::BadFile,
                    str("has ", parts.mesh.positions.size(), " vertices and no face or edge"),
                    "points alone have no surface", {.path = path.string()});
    if (!parts.mesh.triangles.empty()) {
        out.materials.push_back(named("default", MaterialKind::Surface));
        out.meshes.push_back(std::move(parts.mesh));
    }
    if (curves.curve_count() > 0) {
        curves.material = static_cast<std::uint32_t>(out.materials.size());
        out.materials.push_back(named("lines", MaterialKind::Fiber));
        out.curves.push_back(std::move(curves));
    }
    return out;
} catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "needs more memory than there is", "split the file",
                {.path = path.string()});
}

} // namespace heddle
