#pragma once

#include <heddle/scene/scene.h>
#include <heddle/scene/table_reader.h>

#include <string>
#include <vector>

/// One reader for each kind of table in a scene file; docs/scene.md lists their keys. Problems are
/// added to those of the reader; the result is only valid if there are none.
namespace heddle::scene_form {

[[nodiscard]] SceneCamera read_camera(TableReader& reader);
void read_film(TableReader& reader, Scene& scene);
[[nodiscard]] SceneIntegrator read_integrator(TableReader& reader);
[[nodiscard]] SceneLight read_light(TableReader& reader);
[[nodiscard]] ScatterMaterial read_material(TableReader& reader);

/// Reads the transform of an object or instance: matrix, or scale, then rotation, then translation.
[[nodiscard]] Affine read_transform(TableReader& reader);

/// A material that an object names; it is looked up after all files are read.
struct MaterialUse {
    FileLocation location;
    std::string name;
};

[[nodiscard]] SceneObject
read_object(TableReader& reader, const std::string& name, std::vector<MaterialUse>& uses);

} // namespace heddle::scene_form
