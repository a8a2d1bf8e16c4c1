#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/material.h>

#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// What becomes of one material of a .vdb. What else a material has went into the voxels for good.
struct MaterialEdit {
    std::string material{}; ///< its name, else its number from 0; as they are before all edits
    std::optional<std::string> name{};
    std::optional<Vec3f> albedo{};    ///< linear RGB in [0, 1]
    std::optional<float> roughness{}; ///< in [0, 1], as the next two
    std::optional<float> metalness{};
    std::optional<float> anisotropy{};
    std::optional<float> anisotropy_rotation{}; ///< radians
    std::optional<float> alpha{};               ///< in [0, 1]
};

/// Names of the fields of MaterialEdit that change something, in their order.
[[nodiscard]] const std::vector<std::string>& material_keys();

struct EditMaterialsOptions {
    std::vector<MaterialEdit> set{};     ///< none: nothing is written
    std::optional<std::string> output{}; ///< none: the file itself
};

struct MaterialReport {
    std::string file{}; ///< that has these materials
    std::vector<Material> materials{};
    std::vector<std::string> notes{};
};

/// The materials as these edits leave them: all, or none where one is wrong.
/// @throws OptionError  no such material, or more than one; a value out of range; a field that is
///                      given twice; two materials of one name
[[nodiscard]] std::vector<Material> edit_materials(const std::vector<Material>& materials,
                                                   const std::vector<MaterialEdit>& edits);

/// Changes the materials of a .vdb, and no voxel; or reads them.
/// @throws OptionError  as above; `output` without edits
/// @throws Error        as read_infos and replace_materials; CannotWrite, Cancelled
MaterialReport edit_materials_of_file(const std::string& path,
                                      const EditMaterialsOptions& options,
                                      Progress& progress);

} // namespace heddle::job
