#include <heddle/scene/scene.h>

#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/file/toml_text.h>
#include <heddle/scene/scene_parts.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace heddle {
namespace {

using scene_form::MaterialUse;
using scene_form::TableReader;

/// Scenes are written by people or scripts; a larger file is of another kind.
constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20;
constexpr std::size_t kMaxDepth = 32;

/// A scene, while its files are read.
class SceneDraft {
public:
    /// Reads the main file; if it is missing, that Error is thrown at once.
    void read_main(const std::string& path) { read_text(path, read_whole_file(path, kMaxBytes)); }
    [[nodiscard]] Scene finish();

private:
    void read_text(const std::string& path, const std::string& text);
    void read_tables(TableReader& file);
    void include(const std::string& path, const FileLocation& location);
    void read_materials(TableReader& file);
    void read_objects(TableReader& file);
    bool define(const std::string& what, const FileLocation& location);

    Scene scene_;
    Problems problems_;
    std::map<std::string, FileLocation> defined_; ///< "material 'cotton'": where it is defined
    std::vector<MaterialUse> uses_;
    std::vector<std::string> open_; ///< files that are being read, canonical paths
    std::set<std::string> read_;    ///< files that were read, which a second include skips
};

std::string canonical(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(path, ignored).string();
}

/// Returns false and adds a problem if the same thing was defined before.
bool SceneDraft::define(const std::string& what, const FileLocation& location) {
    const auto [at, fresh] = defined_.emplace(what, location);
    if (!fresh) {
        problems_.add(location, str(what, " is defined at ", to_string(at->second), " already"),
                      "drop or rename one of them");
    }
    return fresh;
}

void SceneDraft::include(const std::string& path, const FileLocation& location) {
    const std::string id = canonical(path);
    if (std::find(open_.begin(), open_.end(), id) != open_.end()) {
        problems_.add(location, str("'", path, "' includes itself, directly or by others"),
                      "break the cycle");
        return;
    }
    if (open_.size() >= kMaxDepth) {
        problems_.add(location, str("files are included ", kMaxDepth, " deep"), "nest them less");
        return;
    }
    if (read_.count(id) > 0) return;
    std::string text;
    try {
        text = read_whole_file(path, kMaxBytes);
    } catch (const Error& e) {
        problems_.add(location, str("cannot include: ", e.what()));
        return;
    }
    read_text(path, text);
}

void SceneDraft::read_text(const std::string& path, const std::string& text) {
    const auto table = parse_toml(text, path, problems_);
    if (!table) return;
    const std::string id = canonical(path);
    open_.push_back(id);
    TableReader file(*table, {path, 0}, "a scene file", problems_);
    read_tables(file);
    open_.pop_back();
    read_.insert(id);
}

void SceneDraft::read_tables(TableReader& file) {
    const std::string& path = file.location().path;
    for (const std::string& name : file.texts("include")) {
        include(scene_form::resolve_path(name, path), file.location_of("include"));
    }
    const auto section = [&](const char* key, const auto& read) {
        const toml::table* table = file.table(key);
        if (table == nullptr || !define(str("[", key, "]"), file.location_of(key))) return;
        TableReader reader(*table, file.location_of(key), str("[", key, "]"), problems_);
        read(reader);
    };
    section("camera", [&](TableReader& r) { scene_.camera = scene_form::read_camera(r); });
    section("film", [&](TableReader& r) { scene_form::read_film(r, scene_); });
    section("integrator",
            [&](TableReader& r) { scene_.integrator = scene_form::read_integrator(r); });
    for (const toml::table* table : file.tables("light")) {
        TableReader reader(*table, scene_form::location_of(*table, path), "a light", problems_);
        scene_.lights.push_back(scene_form::read_light(reader));
    }
    read_materials(file);
    read_objects(file);
    file.finish();
}

void SceneDraft::read_materials(TableReader& file) {
    const toml::table* all = file.table("material");
    if (all == nullptr) return;
    TableReader group(*all, file.location_of("material"), "[material]", problems_);
    for (const auto& [key, node] : *all) {
        const std::string name(key.str());
        const toml::table* table = group.table(name);
        if (table == nullptr) continue;
        const FileLocation location = group.location_of(name);
        TableReader reader(*table, location, str("material '", name, "'"), problems_);
        const ScatterMaterial material = scene_form::read_material(reader);
        if (define(str("material '", name, "'"), location)) scene_.materials[name] = material;
    }
}

void SceneDraft::read_objects(TableReader& file) {
    const toml::table* all = file.table("object");
    if (all == nullptr) return;
    TableReader group(*all, file.location_of("object"), "[object]", problems_);
    for (const auto& [key, node] : *all) {
        const std::string name(key.str());
        const toml::table* table = group.table(name);
        if (table == nullptr) continue;
        const FileLocation location = group.location_of(name);
        TableReader reader(*table, location, str("object '", name, "'"), problems_);
        SceneObject object = scene_form::read_object(reader, name, uses_);
        if (define(str("object '", name, "'"), location))
            scene_.objects.push_back(std::move(object));
    }
}

Scene SceneDraft::finish() {
    std::vector<std::string> names;
    for (const auto& [what, location] : defined_) {
        if (what.rfind("material '", 0) == 0) names.push_back(what.substr(10, what.size() - 11));
    }
    for (const MaterialUse& use : uses_) {
        if (std::find(names.begin(), names.end(), use.name) != names.end()) continue;
        const std::string_view near = nearest_name(use.name, names);
        problems_.add(use.location, str("no material '", use.name, "' in the scene"),
                      near.empty() ? str("add [material.", use.name, "]")
                                   : str("did you mean '", near, "'?"));
    }
    problems_.throw_if_any();
    return std::move(scene_);
}

} // namespace

Scene read_scene(const std::string& path) {
    SceneDraft draft;
    draft.read_main(path);
    return draft.finish();
}

} // namespace heddle
