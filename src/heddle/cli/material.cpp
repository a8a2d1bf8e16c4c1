#include <heddle/base/error.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/material_edit.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/job/edit_materials.h>

namespace heddle::cli {
namespace {

void report_materials(Report& report, const std::vector<Material>& materials) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const Material& m = materials[i];
        const char* kind = m.kind == MaterialKind::Fiber ? "fiber" : "surface";
        list.push_back({{"number", i},
                        {"name", m.name},
                        {"kind", kind},
                        {"albedo", {m.albedo.x, m.albedo.y, m.albedo.z}},
                        {"roughness", m.roughness},
                        {"metalness", m.metalness},
                        {"anisotropy", m.anisotropy},
                        {"anisotropy_rotation", m.anisotropy_rotation},
                        {"alpha", m.alpha}});
        rows.push_back({str(i), m.name.empty() ? "(unnamed)" : m.name, kind,
                        str(m.albedo.x, ",", m.albedo.y, ",", m.albedo.z), str(m.roughness),
                        str(m.metalness), str(m.anisotropy), str(m.anisotropy_rotation),
                        str(m.alpha)});
    }
    report.table("materials", std::move(list),
                 {"number", "name", "kind", "albedo", "roughness", "metalness", "anisotropy",
                  "anisotropy_rotation", "alpha"},
                 rows);
}

void run_material(const Arguments& arguments, Report& report, ProgressBar& bar) {
    job::EditMaterialsOptions options;
    for (const std::string& text : arguments.texts("set"))
        options.set.push_back(material_edit_from(text));
    options.output = arguments.find_text("output");
    const job::MaterialReport done =
        job::edit_materials_of_file(arguments.text("FILE"), options, bar);
    report_notes(report, done.notes);
    report.text("file", done.file);
    report_materials(report, done.materials);
}

} // namespace

Command material_command() {
    return {
        "material", "Lists or changes the materials of a .vdb.",
        joined({
            grouped("Input and output",
                    {
                        {"FILE", "", "", any_text(), "", "A .vdb written by heddle.", true},
                        {"-o, --output", "OUT.vdb", "(FILE itself)", any_text(), "",
                         "Output file of the changed volume; needs --set."},
                    }),
            grouped(
                "Materials",
                {
                    {"--set", "NAME.KEY=VALUE", "", any_text(), "",
                     "Changes a material; the voxels stay as they are. NAME: a material's name or number. KEY: " +
                         listed_material_keys() + ". albedo takes linear R,G,B.",
                     false, true},
                }),
        }),
        run_material};
}

} // namespace heddle::cli
