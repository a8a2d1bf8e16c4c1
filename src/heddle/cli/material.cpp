#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/replace_materials.h>

#include <algorithm>
#include <limits>
#include <set>

namespace heddle::cli {
namespace {

using Json = nlohmann::ordered_json;
using Numbers = std::vector<double>;

/// What --set can change. What else a material has went into the voxels for good.
struct Key {
    std::string name;
    Values values; ///< that are allowed
    void (*set)(Material&, const std::string& text, const Numbers&);
};

template <float Material::*Field>
void set_number(Material& m, const std::string&, const Numbers& value) {
    m.*Field = static_cast<float>(value[0]);
}

const std::vector<Key>& keys() {
    constexpr double kMost = std::numeric_limits<float>::max();
    static const std::vector<Key> all{
        {"name", any_text(),
         [](Material& m, const std::string& text, const Numbers&) { m.name = text; }},
        {"albedo", numbers(3, 3, 0.0, 1.0),
         [](Material& m, const std::string&, const Numbers& v) {
             m.albedo = to_float(Vec3d{v[0], v[1], v[2]});
         }},
        {"roughness", number(0.0, 1.0), set_number<&Material::roughness>},
        {"metalness", number(0.0, 1.0), set_number<&Material::metalness>},
        {"anisotropy", number(0.0, 1.0), set_number<&Material::anisotropy>},
        {"anisotropy_rotation", number(-kMost, kMost), set_number<&Material::anisotropy_rotation>},
        {"alpha", number(0.0, 1.0), set_number<&Material::alpha>},
    };
    return all;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += str(text.empty() ? "" : ", ", name);
    return text;
}

/// "; did you mean 'x'?", or all that would be right.
/// @param all  says what the names are
std::string
suggestion(const std::string& word, const std::vector<std::string>& names, const std::string& all) {
    const std::string_view near = nearest_name(word, names);
    if (!near.empty()) return str("; did you mean '", near, "'?");
    return str("; ", all, ": ", listed(names));
}

[[noreturn]] void refuse(const std::string& what) {
    throw UsageError("--set: " + what);
}

std::string name_or_number(const std::vector<Material>& materials, std::size_t i) {
    return materials[i].name.empty() ? str(i) : materials[i].name;
}

/// The material of that name, else of that number.
std::size_t find_material(const std::vector<Material>& materials, const std::string& word) {
    const auto named = [&](const Material& m) { return m.name == word; };
    const auto at = std::find_if(materials.begin(), materials.end(), named);
    if (at != materials.end()) {
        if (std::find_if(at + 1, materials.end(), named) != materials.end()) {
            refuse(str("more than one material is named '", word, "'; give its number"));
        }
        return static_cast<std::size_t>(at - materials.begin());
    }
    const std::optional<std::int64_t> number = parse_integer(word);
    if (number && *number >= 0 && *number < static_cast<std::int64_t>(materials.size())) {
        return static_cast<std::size_t>(*number);
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        names.push_back(name_or_number(materials, i));
    }
    if (names.empty()) refuse("the file has no materials");
    refuse(str("no material '", word, "'", suggestion(word, names, "the file has")));
}

const Key& find_key(const std::string& word) {
    std::vector<std::string> names;
    for (const Key& key : keys()) {
        if (key.name == word) return key;
        names.push_back(key.name);
    }
    refuse(str("no key '", word, "'", suggestion(word, names, "the keys are")));
}

/// One NAME.KEY=VALUE, taken apart.
struct Edit {
    std::size_t material = 0;
    const Key* key = nullptr;
    std::string value;
};

Edit parse_edit(const std::string& text, const std::vector<Material>& materials) {
    const std::size_t equals = text.find('=');
    const std::size_t dot = text.substr(0, equals).rfind('.');
    if (equals == std::string::npos || dot == std::string::npos) {
        refuse(str("'", text, "' is not NAME.KEY=VALUE"));
    }
    Edit edit;
    edit.material = find_material(materials, text.substr(0, dot));
    edit.key = &find_key(text.substr(dot + 1, equals - dot - 1));
    edit.value = text.substr(equals + 1);
    const std::string problem = edit.key->values.problem(edit.value);
    if (!problem.empty()) throw UsageError(str("--set ", text.substr(0, equals), ": ", problem));
    return edit;
}

/// All edits, or none where one is wrong. Names are those from before.
std::vector<Material> edit_materials(const std::vector<Material>& before,
                                     const std::vector<std::string>& edits) {
    std::vector<Material> after = before;
    std::set<std::pair<std::size_t, std::string>> done;
    for (const std::string& text : edits) {
        const Edit edit = parse_edit(text, before);
        if (!done.emplace(edit.material, edit.key->name).second) {
            refuse(str("'", name_or_number(before, edit.material), ".", edit.key->name,
                       "' is given more than once"));
        }
        Numbers values;
        if (edit.key->values.kind == ValueKind::Numbers) {
            for (const std::string& piece : split(edit.value, ',')) {
                values.push_back(parse_number(piece).value());
            }
        }
        edit.key->set(after[edit.material], edit.value, values);
    }
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (after[i].name == before[i].name) continue;
        for (std::size_t j = 0; j < after.size(); ++j) {
            if (i != j && after[i].name == after[j].name) {
                refuse(str("two materials would be named '", after[i].name, "'"));
            }
        }
    }
    return after;
}

void report_materials(Report& report, const std::vector<Material>& materials) {
    Json list = Json::array();
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
    const std::string& path = arguments.text("FILE");
    const bool edits = arguments.given("set");
    const std::string& output = arguments.given("output") ? arguments.text("output") : path;
    if (arguments.given("output")) {
        if (!edits) throw UsageError("--output needs --set");
        check_output(output, ".vdb");
    }
    bar.begin("read", "files", 1);
    const VoxelGridInfo info = read_infos(path)[0];
    std::vector<Material> materials = info.materials;
    if (edits) {
        materials = edit_materials(info.materials, arguments.texts("set"));
        write_output([&] { replace_materials(path, materials, output, bar); });
        bar.finish();
    }
    for (std::size_t i = 0; i < materials.size() && !info.fields.tangents; ++i) {
        const bool surface = materials[i].kind == MaterialKind::Surface;
        if (!surface || materials[i].anisotropy == info.materials[i].anisotropy) continue;
        report.note(str(
            "the anisotropy of '", name_or_number(materials, i),
            "' needs tangents, which the file does not store; set anisotropy in the mesh's material and voxelize again"));
    }
    report.text("file", output);
    report_materials(report, materials);
}

} // namespace

Command material_command() {
    std::vector<std::string> names;
    for (const Key& key : keys()) names.push_back(key.name);
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
                         listed(names) + ". albedo takes linear R,G,B.",
                     false, true},
                }),
        }),
        run_material};
}

} // namespace heddle::cli
