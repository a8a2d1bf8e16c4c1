#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/material.h>

#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// New values for one material of a .vdb. All other properties are baked into the voxels.
struct MaterialEdit {
    std::string material{}; ///< name, or number from 0, before all edits
    std::optional<std::string> name{};
    std::optional<Vec3f> albedo{};    ///< linear RGB in [0, 1]
    std::optional<float> roughness{}; ///< in [0, 1], like the next two
    std::optional<float> metalness{};
    std::optional<float> anisotropy{};
    std::optional<float> anisotropy_rotation{}; ///< radians
    std::optional<float> alpha{};               ///< in [0, 1]
};

/// Returns the names of the fields of MaterialEdit that are values, in their order.
[[nodiscard]] const std::vector<std::string>& material_keys();

/// What is changed, and where the result is written.
struct EditMaterialsOptions {
    std::vector<MaterialEdit> set{};     ///< empty: nothing is written
    std::optional<std::string> output{}; ///< none: the input file is replaced
};

/// The materials of a file after all edits.
struct MaterialReport {
    std::string file{}; ///< path of the file that has these materials
    std::vector<Material> materials{};
    std::vector<std::string> notes{};
};

/// Returns the materials with all edits applied. If one edit is wrong, none is applied.
/// @throws OptionError  an edit names no material or more than one; a value is out of range; a
///                      field is given twice; two materials would have the same name
[[nodiscard]] std::vector<Material> edit_materials(const std::vector<Material>& materials,
                                                   const std::vector<MaterialEdit>& edits);

/// Changes the materials of a .vdb and leaves its voxels as they are. Without edits, reads them.
/// @return  the materials after the edits
/// @throws OptionError  as edit_materials; `output` is given without edits
/// @throws Error        as read_infos and replace_materials; CannotWrite, Cancelled
MaterialReport edit_materials_of_file(const std::string& path,
                                      const EditMaterialsOptions& options,
                                      Progress& progress);

} // namespace heddle::job
