#include <heddle/io/geometry/apply_yarn.h>

#include <heddle/io/image/image.h>
#include <heddle/io/yarn/yarn_file.h>

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

/// Makes all curves this yarn, with a fiber material of its colour.
void make_yarn(Geometry& geometry, YarnType yarn) {
    Material material;
    material.name = yarn.name;
    material.kind = MaterialKind::Fiber;
    material.albedo = yarn.albedo;
    if (geometry.meshes.empty())
        geometry.materials.clear(); // the reader's materials are no longer used
    geometry.materials.push_back(material);
    geometry.yarns.assign(1, std::move(yarn));
    for (CurveSet& set : geometry.curves) {
        set.yarn = 0;
        set.material = static_cast<std::uint32_t>(geometry.materials.size() - 1);
    }
}

} // namespace

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

} // namespace heddle
