#include <heddle/job/edit_materials.h>

#include <heddle/base/nearest_name.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/replace_materials.h>
#include <heddle/job/option_error.h>
#include <heddle/job/phase_clock.h>
#include <heddle/job/write_output.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

namespace heddle::job {
namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw OptionError("`set`: " + what);
}

std::string name_or_number(const std::vector<Material>& materials, std::size_t i) {
    return materials[i].name.empty() ? str(i) : materials[i].name;
}

/// Returns "; did you mean 'x'?", or a list of all names.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
    const std::string_view near = nearest_name(word, names);
    if (!near.empty()) return str("; did you mean '", near, "'?");
    std::string listed;
    for (const std::string& name : names) listed += str(listed.empty() ? "" : ", ", name);
    return str("; the file has: ", listed);
}

/// Returns the index of the material of that name, else of that number.
std::size_t find_material(const std::vector<Material>& materials, const std::string& word) {
    const auto named = [&](const Material& m) { return m.name == word; };
    const auto at = std::find_if(materials.begin(), materials.end(), named);
    if (at != materials.end()) {
        if (std::find_if(at + 1, materials.end(), named) != materials.end()) {
            refuse(str("more than one material is named '", word, "'; give its number"));
        }
        return static_cast<std::size_t>(at - materials.begin());
    }
    std::size_t number = 0;
    const char* end = word.data() + word.size();
    const auto [stop, status] = std::from_chars(word.data(), end, number);
    if (status == std::errc{} && stop == end && number < materials.size()) return number;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        names.push_back(name_or_number(materials, i));
    }
    if (names.empty()) refuse("the file has no materials");
    refuse(str("no material '", word, "'", suggestion(word, names)));
}

/// Applies edits to materials, and refuses to set a value twice.
class Editor {
public:
    explicit Editor(std::vector<Material> materials)
        : before_(materials), after_(std::move(materials)) {}

    void apply(const MaterialEdit& edit) {
        at_ = find_material(before_, edit.material);
        if (edit.name && edit.name->empty()) refuse("a material's name is empty");
        take("name", edit.name, after_[at_].name);
        take("albedo", edit.albedo, after_[at_].albedo);
        take_share("roughness", edit.roughness, after_[at_].roughness);
        take_share("metalness", edit.metalness, after_[at_].metalness);
        take_share("anisotropy", edit.anisotropy, after_[at_].anisotropy);
        take("anisotropy_rotation", edit.anisotropy_rotation, after_[at_].anisotropy_rotation);
        take_share("alpha", edit.alpha, after_[at_].alpha);
        const Vec3f& rgb = after_[at_].albedo;
        for (int a = 0; a < 3 && edit.albedo; ++a) check_share("albedo", rgb[a]);
    }

    [[nodiscard]] std::vector<Material> finish() {
        for (std::size_t i = 0; i < after_.size(); ++i) {
            if (after_[i].name == before_[i].name) continue;
            for (std::size_t j = 0; j < after_.size(); ++j) {
                if (i != j && after_[i].name == after_[j].name) {
                    refuse(str("two materials would be named '", after_[i].name, "'"));
                }
            }
        }
        return std::move(after_);
    }

private:
    template <typename T>
    void take(const char* key, const std::optional<T>& value, T& out) {
        if (!value) return;
        if (!done_.emplace(at_, key).second) {
            refuse(str("'", name_or_number(before_, at_), ".", key, "' is given more than once"));
        }
        out = *value;
    }
    void check_share(const char* key, float value) const {
        if (value >= 0.0f && value <= 1.0f) return;
        refuse(str("'", name_or_number(before_, at_), ".", key, "' is ", value,
                   "; it must be 0 to 1"));
    }
    void take_share(const char* key, const std::optional<float>& value, float& out) {
        take(key, value, out);
        if (value) check_share(key, *value);
    }

    std::vector<Material> before_, after_;
    std::set<std::pair<std::size_t, std::string>> done_;
    std::size_t at_ = 0;
};

/// Returns a note for each edit of anisotropy that needs tangents if the file has none.
std::vector<std::string> missing_tangents(const VoxelLevelInfo& info,
                                          const std::vector<Material>& materials) {
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < materials.size() && !info.fields.tangents; ++i) {
        const bool surface = materials[i].kind == MaterialKind::Surface;
        if (!surface || materials[i].anisotropy == info.materials[i].anisotropy) continue;
        notes.push_back(str(
            "the anisotropy of '", name_or_number(materials, i),
            "' needs tangents, which the file does not store; set anisotropy in the mesh's material and voxelize again"));
    }
    return notes;
}

} // namespace

const std::vector<std::string>& material_keys() {
    static const std::vector<std::string> keys{
        "name", "albedo", "roughness", "metalness", "anisotropy", "anisotropy_rotation", "alpha"};
    return keys;
}

std::vector<Material> edit_materials(const std::vector<Material>& materials,
                                     const std::vector<MaterialEdit>& edits) {
    Editor editor(materials);
    for (const MaterialEdit& edit : edits) editor.apply(edit);
    return editor.finish();
}

MaterialReport edit_materials_of_file(const std::string& path,
                                      const EditMaterialsOptions& options,
                                      Progress& progress) {
    const bool edits = !options.set.empty();
    if (options.output) {
        if (!edits) throw OptionError("`output` needs `set`");
        check_output(*options.output, ".vdb");
    }
    progress.begin("read", "files", 1);
    const VoxelLevelInfo info = read_infos(path)[0];
    MaterialReport report{options.output.value_or(path), info.materials, {}};
    if (edits) {
        report.materials = edit_materials(info.materials, options.set);
        write_output([&] { replace_materials(path, report.materials, report.file, progress); });
    }
    take_notes(report.notes, missing_tangents(info, report.materials), progress);
    return report;
}

} // namespace heddle::job
