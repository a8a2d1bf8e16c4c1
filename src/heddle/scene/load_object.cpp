#include <heddle/scene/load_object.h>

#include <heddle/base/error.h>
#include <heddle/io/image/image.h>
#include <heddle/io/input_file.h>
#include <heddle/io/mesh/read_mesh.h>
#include <heddle/io/yarn_file.h>

#include <utility>

namespace heddle {
namespace {

YarnType read_asked_yarn(const YarnOptions& options, std::vector<std::string>& notes) {
    YarnFile file =
        read_yarn(*options.yarn, [](const std::string& path) { return read_image(path); });
    notes.insert(notes.end(), file.notes.begin(), file.notes.end());
    if (options.fibers > 0) {
        const std::string note = set_fiber_count(file.yarn, options.fibers);
        if (!note.empty()) notes.push_back(note);
    }
    if (options.fiber_radius > 0.0f) file.yarn.fiber_radius = options.fiber_radius;
    if (options.yarn_radius > 0.0f) file.yarn.radius = options.yarn_radius;
    return std::move(file.yarn);
}

/// All curves become this yarn, in a fiber material of its colour.
void make_yarn(Geometry& geometry, YarnType yarn) {
    Material material;
    material.name = yarn.name;
    material.kind = MaterialKind::Fiber;
    material.albedo = yarn.albedo;
    if (geometry.meshes.empty())
        geometry.materials.clear(); // the reader's, which nothing names now
    geometry.materials.push_back(material);
    geometry.yarns.assign(1, std::move(yarn));
    for (CurveSet& set : geometry.curves) {
        set.yarn = 0;
        set.material = static_cast<std::uint32_t>(geometry.materials.size() - 1);
    }
}

} // namespace

Geometry read_geometry(const std::string& path, const CurveReadOptions& options) {
    if (is_curve_file(path)) return read_curves(path, options);
    const std::string suffix = suffix_of(path);
    if (suffix == ".obj") return read_obj(path);
    if (suffix == ".ply") return read_ply(path);
    if (suffix == ".gltf" || suffix == ".glb") return read_gltf(path);
    throw Error(ErrorCode::Unsupported, str("no reader for the suffix '", suffix, "'"),
                "known: .bcc .hair .data .pyp .obj .ply .gltf .glb", {.path = path});
}

void apply_yarn(Geometry& geometry, const YarnOptions& options) {
    if (geometry.curves.empty()) return;
    if (options.yarn) {
        return make_yarn(geometry, read_asked_yarn(options, geometry.notes));
    }
    const float radius = options.fiber_radius > 0.0f ? options.fiber_radius : options.yarn_radius;
    if (!(radius > 0.0f)) return;
    for (CurveSet& set : geometry.curves) {
        set.radius.clear();
        set.default_radius = radius;
    }
}

Geometry load_object_geometry(const SceneObject& object) {
    const auto refuse = [&](const std::string& what, const std::string& fix) {
        throw Error(ErrorCode::InvalidArgument, str("object '", object.name, "' ", what), fix);
    };
    YarnOptions options;
    if (!object.yarn.empty()) options.yarn = object.yarn;
    options.yarn_radius = static_cast<float>(object.yarn_radius);
    options.fibers = object.fibers;
    options.fiber_radius = static_cast<float>(object.fiber_radius);
    if (!object.generate && object.geometry.empty()) {
        refuse("has no geometry", "give it 'geometry' or 'generate'");
    }
    Geometry geometry = object.generate
                            ? generate(*object.generate)
                            : read_geometry(object.geometry, {.radius = options.yarn_radius});
    const bool asked = options.yarn || options.yarn_radius > 0.0f || options.fiber_radius > 0.0f;
    if (asked && geometry.curves.empty()) {
        refuse("has a yarn or a radius, but its geometry has no curves",
               "drop 'yarn', 'yarn_radius' and 'fiber_radius'");
    }
    apply_yarn(geometry, options);
    return geometry;
}

} // namespace heddle
