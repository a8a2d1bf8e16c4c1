#include <heddle/io/gltf/read_gltf.h>

#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/io/gltf/gltf_material.h>
#include <heddle/io/gltf/gltf_model.h>
#include <heddle/io/gltf/placement.h>
#include <heddle/io/mesh/tangents.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace heddle {
namespace {

constexpr double kAlwaysFits = 1 << 26; // bytes; asking the system costs more than a small mesh

/// All transforms of each mesh of the file, in the order of the node tree.
using Placements = std::vector<std::vector<Placement>>;

Vec3d vector_or(const std::vector<double>& from, Vec3d fallback) {
    return from.size() == 3 ? Vec3d{from[0], from[1], from[2]} : fallback;
}

Placement placement_of(const tinygltf::Node& node) {
    const std::vector<double>& m = node.matrix; // by columns
    if (m.size() == 16)
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    std::array<double, 4> rotation{0.0, 0.0, 0.0, 1.0};
    if (node.rotation.size() == 4) std::copy_n(node.rotation.begin(), 4, rotation.begin());
    return placement_from(vector_or(node.translation, {}), rotation,
                          vector_or(node.scale, {1.0, 1.0, 1.0}));
}

/// The transforms that EXT_mesh_gpu_instancing gives a node's mesh; one if there is none.
std::vector<Placement> instances_of(const GltfModel& model, const tinygltf::Node& node) {
    const auto* extension = find_extension(node.extensions, "EXT_mesh_gpu_instancing");
    const auto* attributes = extension != nullptr ? find_member(*extension, "attributes") : nullptr;
    if (attributes == nullptr) return {Placement{}};
    std::size_t count = 0;
    const auto read = [&](const char* key, int components) {
        const int accessor =
            static_cast<int>(std::clamp(number_or(*attributes, key, -1.0), -1.0, 1e9));
        if (accessor < 0) return std::vector<float>{};
        std::vector<float> values = model.floats(accessor, components, str("instance ", key));
        const std::size_t rows = values.size() / static_cast<std::size_t>(components);
        if (count != 0 && rows != count) model.fail("instance attributes differ in length");
        count = rows;
        return values;
    };
    const std::vector<float> t = read("TRANSLATION", 3);
    const std::vector<float> r = read("ROTATION", 4);
    const std::vector<float> s = read("SCALE", 3);
    const auto vector_at = [](const std::vector<float>& v, std::size_t i, Vec3d fallback) {
        return v.empty() ? fallback : Vec3d{v[3 * i], v[3 * i + 1], v[3 * i + 2]};
    };
    std::vector<Placement> out;
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, 4> rotation{0.0, 0.0, 0.0, 1.0};
        if (!r.empty()) rotation = {r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]};
        out.push_back(
            placement_from(vector_at(t, i, {}), rotation, vector_at(s, i, {1.0, 1.0, 1.0})));
    }
    return out;
}

/// The roots of the default scene; without scenes, the nodes that are not children.
std::vector<int> roots_of(const GltfModel& model) {
    if (!model->scenes.empty()) {
        const int scene = std::max(model->defaultScene, 0);
        if (static_cast<std::size_t>(scene) >= model->scenes.size())
            model.fail(str("names scene ", scene, " of ", model->scenes.size()));
        return model->scenes[static_cast<std::size_t>(scene)].nodes;
    }
    std::vector<bool> is_child(model->nodes.size(), false);
    for (const tinygltf::Node& node : model->nodes) {
        for (const int child : node.children) {
            if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
                is_child[static_cast<std::size_t>(child)] = true;
        }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
        if (!is_child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
}

Placements find_placements(const GltfModel& model, Geometry& out) {
    struct Visit {
        int node;
        Placement outer;
    };
    std::vector<Visit> stack;
    const auto push = [&stack](const std::vector<int>& nodes, const Placement& outer) {
        for (std::size_t i = nodes.size(); i-- > 0;) stack.push_back({nodes[i], outer});
    };
    push(roots_of(model), {});
    Placements placements(model->meshes.size());
    std::vector<bool> seen(model->nodes.size(), false);
    while (!stack.empty()) {
        const auto [index, outer] = stack.back();
        stack.pop_back();
        const auto at = static_cast<std::size_t>(index);
        if (index < 0 || at >= seen.size())
            model.fail(str("names node ", index, " of ", seen.size()));
        if (seen[at]) model.fail(str("node ", index, " has two parents, or is its own ancestor"));
        seen[at] = true;
        const tinygltf::Node& node = model->nodes[at];
        const Placement here = outer * placement_of(node);
        push(node.children, here);
        if (node.mesh == -1) continue;
        if (node.mesh < 0 || static_cast<std::size_t>(node.mesh) >= placements.size())
            model.fail(str("names mesh ", node.mesh, " of ", placements.size()));
        if (node.skin >= 0)
            out.notes.push_back(str("node '", node.name, "' is read in its rest pose"));
        for (const Placement& instance : instances_of(model, node))
            placements[static_cast<std::size_t>(node.mesh)].push_back(here * instance);
    }
    return placements;
}

/// The triangles of a list, strip or fan of corners                        [glTF 2.0, 3.7.2.1]
std::vector<std::array<std::uint32_t, 3>> triangles_from(const std::vector<std::uint32_t>& corners,
                                                         int mode) {
    std::vector<std::array<std::uint32_t, 3>> out;
    const std::size_t n = corners.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        for (std::size_t i = 2; i < n; i += 3)
            out.push_back({corners[i - 2], corners[i - 1], corners[i]});
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        for (std::size_t i = 2; i < n; ++i) {
            const std::size_t odd = i % 2;
            out.push_back({corners[i - 2], corners[i - 1 + odd], corners[i - odd]});
        }
    } else {
        for (std::size_t i = 2; i < n; ++i) out.push_back({corners[0], corners[i - 1], corners[i]});
    }
    return out;
}

class PrimitiveReader {
public:
    PrimitiveReader(const GltfModel& model, Geometry& out)
        : model_(model), out_(out), materials_(model, out) {}

    /// Adds a primitive with each of its transforms.
    void add(const tinygltf::Primitive& primitive, const std::vector<Placement>& places) {
        if (primitive.mode < TINYGLTF_MODE_TRIANGLES ||
            primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
            out_.notes.emplace_back("points and lines are left out");
            return;
        }
        if (!primitive.targets.empty()) out_.notes.emplace_back("morph targets are left out");
        const Mesh local = read(primitive);
        if (local.triangles.empty()) return;
        check_memory(local, places.size());
        Mesh* world = nullptr;
        for (const Placement& place : places) {
            const std::uint64_t limit = std::numeric_limits<std::uint32_t>::max();
            if (world == nullptr || world->positions.size() + local.positions.size() > limit) {
                world = &out_.meshes.emplace_back();
                world->material = local.material;
            }
            append_placed(local, place, *world);
        }
        check_finite(*world);
    }

private:
    Mesh read(const tinygltf::Primitive& primitive) {
        const auto accessor = [&](const std::string& name) {
            const auto place = primitive.attributes.find(name);
            return place == primitive.attributes.end() ? -1 : place->second;
        };
        Mesh mesh;
        if (accessor("POSITION") < 0) model_.fail("a primitive has no POSITION");
        fill(accessor("POSITION"), "POSITION", mesh.positions);
        const std::size_t count = mesh.positions.size();
        std::vector<std::uint32_t> corners;
        if (primitive.indices >= 0) {
            corners = model_.indices(primitive.indices, count);
        } else {
            for (std::uint32_t i = 0; i < count; ++i) corners.push_back(i);
        }
        mesh.triangles = triangles_from(corners, primitive.mode);
        const GltfMaterials::Used used = materials_.use(primitive.material);
        mesh.material = used.index;
        const std::string uv_name = str("TEXCOORD_", used.uv.set);
        if (accessor(uv_name) >= 0) fill(accessor(uv_name), uv_name, mesh.uvs);
        for (Uv& uv : mesh.uvs) uv = used.uv.apply(uv);
        if (accessor("NORMAL") >= 0) fill(accessor("NORMAL"), "NORMAL", mesh.normals);
        if (accessor("TANGENT") >= 0) fill(accessor("TANGENT"), "TANGENT", mesh.tangents);
        if (mesh.normals.empty()) set_flat_normals(mesh); // as glTF says; its tangents are invalid
        const Material& material = out_.materials[mesh.material];
        const bool needs_tangents = material.normal_map >= 0 || material.anisotropy > 0.0f;
        if (!needs_tangents)
            mesh.tangents = {};
        else if (mesh.tangents.empty())
            set_tangents(mesh);
        return mesh;
    }

    /// Reads an attribute that consists of floats; all attributes must have one length.
    template <typename T>
    void fill(int accessor, const std::string& name, std::vector<T>& to) {
        constexpr std::size_t kWidth = sizeof(T) / sizeof(float);
        const std::vector<float> values = model_.floats(accessor, static_cast<int>(kWidth), name);
        if (name == "POSITION") vertices_ = values.size() / kWidth;
        if (values.size() / kWidth != vertices_)
            model_.fail(
                str(name, " has ", values.size() / kWidth, " elements, POSITION has ", vertices_));
        if (vertices_ > std::numeric_limits<std::uint32_t>::max())
            model_.fail(str(vertices_, " vertices, the limit is 2^32 - 1"));
        to.resize(vertices_);
        for (std::size_t i = 0; i < vertices_; ++i) {
            const float* v = &values[i * kWidth];
            if constexpr (kWidth == 2)
                to[i] = {v[0], v[1]};
            else if constexpr (kWidth == 3)
                to[i] = {v[0], v[1], v[2]};
            else
                to[i] = {v[0], v[1], v[2], v[3] < 0.0f ? -1.0f : 1.0f};
        }
    }

    void check_memory(const Mesh& local, std::size_t places) const {
        const double vertex = sizeof(Vec3f) * 2 + sizeof(Tangent) + sizeof(Uv);
        const double bytes =
            static_cast<double>(places) * (static_cast<double>(local.positions.size()) * vertex +
                                           static_cast<double>(local.triangles.size()) * 12.0);
        if (bytes < kAlwaysFits) return;
        const auto free_bytes = static_cast<double>(available_bytes());
        if (free_bytes > 0.0 && bytes > free_bytes)
            throw Error(ErrorCode::OutOfMemory,
                        str("'", out_.name, "' places a mesh ", places, " times, which needs ",
                            bytes, " bytes of ", free_bytes),
                        "use fewer instances");
    }

    void check_finite(const Mesh& mesh) const {
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const Vec3f p = mesh.positions[i];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                model_.fail(str("its node moves vertex ", i, " out of the finite numbers"));
        }
    }

    const GltfModel& model_;
    Geometry& out_;
    GltfMaterials materials_;
    std::size_t vertices_ = 0;
};

} // namespace

Geometry read_gltf(const std::filesystem::path& path) try {
    const GltfModel model(path);
    Geometry out;
    out.name = path.stem().string();
    const Placements placements = find_placements(model, out);
    PrimitiveReader reader(model, out);
    for (std::size_t m = 0; m < placements.size(); ++m) {
        if (placements[m].empty()) continue;
        for (const tinygltf::Primitive& primitive : model->meshes[m].primitives)
            reader.add(primitive, placements[m]);
    }
    if (out.meshes.empty())
        model.fail(str("has no triangle in its scene (", model->meshes.size(), " meshes, ",
                       model->nodes.size(), " nodes)"));
    std::vector<std::string> notes; // each once
    for (std::string& note : out.notes) {
        if (std::find(notes.begin(), notes.end(), note) == notes.end())
            notes.push_back(std::move(note));
    }
    out.notes = std::move(notes);
    return out;
} catch (const Error&) {
    throw;
} catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "needs more memory than there is", "split the file",
                {.path = path.string()});
} catch (const std::exception& e) { // of tinygltf, for unexpected input
    throw Error(ErrorCode::BadFile, str("is not a valid glTF file (", e.what(), ")"),
                "export the file again", {.path = path.string()});
}

} // namespace heddle
