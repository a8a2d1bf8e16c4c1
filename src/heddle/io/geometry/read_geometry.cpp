#include <heddle/io/geometry/read_geometry.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/gltf/read_gltf.h>
#include <heddle/io/mesh/read_mesh.h>

namespace heddle {

Geometry read_geometry(const std::string& path, const CurveReadOptions& options) {
    if (is_curve_file(path)) return read_curves(path, options);
    const std::string suffix = suffix_of(path);
    if (suffix == ".obj") return read_obj(path);
    if (suffix == ".ply") return read_ply(path);
    if (suffix == ".gltf" || suffix == ".glb") return read_gltf(path);
    throw Error(ErrorCode::Unsupported, str("no reader for the suffix '", suffix, "'"),
                "known: .bcc .hair .data .pyp .obj .ply .gltf .glb", {.path = path});
}

} // namespace heddle
