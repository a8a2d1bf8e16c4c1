#include <heddle/scene/scene_parts.h>

#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/yarn/yarn_file.h>

#include <algorithm>

namespace heddle::scene_form {
namespace {

constexpr std::int64_t kMaxCount = 1'000'000'000;

std::vector<std::string_view> kind_names() {
    std::vector<std::string_view> names;
    for (int i = 0; i <= static_cast<int>(GenerateKind::Grass); ++i) {
        names.push_back(to_string(static_cast<GenerateKind>(i)));
    }
    return names;
}

void read_generate(TableReader& parent, SceneObject& object) {
    Problems& problems = parent.problems();
    const toml::table* table = parent.table("generate");
    if (table == nullptr) return;
    TableReader reader(*table, parent.location_of("generate"), "'generate'", problems);
    GenerateOptions options;
    reader.require("kind", "write 'kind = \"knit\"', or another that heddle generate makes");
    if (const auto kind = reader.choose("kind", kind_names())) {
        options.kind = static_cast<GenerateKind>(*kind);
    }
    if (const auto shape = reader.choose("shape", {"flat", "folded", "hanging"})) {
        options.shape = static_cast<GenerateShape>(*shape);
    }
    reader.integer("nx", options.nx, 1, kMaxCount);
    reader.integer("ny", options.ny, 1, kMaxCount);
    std::int64_t seed = 1;
    reader.integer("seed", seed, 0, std::numeric_limits<std::int64_t>::max());
    options.seed = static_cast<std::uint64_t>(seed);
    reader.number("radius", options.radius, kPositive);
    reader.number("spacing", options.spacing, kPositive);
    reader.finish();
    try {
        object.generate = resolve(options);
    } catch (const Error& e) {
        problems.add(reader.location(), e.what());
    }
}

/// Reads the name of a preset or the path of a file.
void read_yarn_name(TableReader& reader, SceneObject& object) {
    std::string yarn;
    reader.text("yarn", yarn);
    if (yarn.empty()) return;
    const std::string suffix = suffix_of(yarn);
    if (suffix == ".toml" || suffix == ".txt" || yarn.find('/') != std::string::npos) {
        reader.path("yarn", object.yarn, {".toml", ".txt"});
        return;
    }
    const std::vector<std::string> presets = list_presets();
    if (std::find(presets.begin(), presets.end(), yarn) == presets.end()) {
        const std::string_view near = nearest_name(yarn, presets);
        std::string known;
        for (const std::string& name : presets) known += str(known.empty() ? "" : ", ", name);
        reader.problem("yarn", str("no yarn preset '", yarn, "'"),
                       str(near.empty() ? "" : str("did you mean '", near, "'? "), "known: ", known,
                           ", or a .toml or .txt file"));
    }
    object.yarn = yarn;
}

void read_sources(TableReader& reader, SceneObject& object) {
    reader.path("volume", object.volume, {".vdb"});
    reader.path("geometry", object.geometry,
                {".bcc", ".hair", ".data", ".pyp", ".obj", ".ply", ".gltf", ".glb"});
    read_generate(reader, object);
    const bool explicit_too = reader.has("geometry") || reader.has("generate");
    if (!reader.has("volume") && !explicit_too) {
        reader.problem("", "the object has neither volume nor geometry nor generate",
                       "give it one of them");
    }
    if (reader.has("geometry") && reader.has("generate")) {
        reader.problem("generate", "the object has both geometry and generate", "keep one of them");
    }
    read_yarn_name(reader, object);
    reader.number("yarn_radius", object.yarn_radius, kPositive);
    reader.integer("fibers", object.fibers, 1, 1'000'000);
    reader.number("fiber_radius", object.fiber_radius, kPositive);
    for (const char* key : {"yarn", "yarn_radius", "fibers", "fiber_radius"}) {
        if (reader.has(key) && !explicit_too) {
            reader.problem(key, str("'", key, "' is of no use without geometry"),
                           "a volume has its yarns in it; give geometry or generate, or drop it");
        }
    }
    if (reader.has("fibers") && !reader.has("yarn")) {
        reader.problem("fibers", "'fibers' is of no use without 'yarn'", "name a yarn, or drop it");
    }
}

void read_materials(TableReader& parent, SceneObject& object, std::vector<MaterialUse>& uses) {
    const toml::table* table = parent.table("materials");
    if (table == nullptr) return;
    TableReader reader(*table, parent.location_of("materials"), "'materials'", parent.problems());
    for (const auto& [key, node] : *table) {
        std::string name;
        reader.text(key.str(), name);
        if (name.empty()) continue;
        uses.push_back({reader.location_of(key.str()), name});
        object.materials[std::string(key.str())] = name;
    }
}

void read_instances(TableReader& reader, SceneObject& object) {
    const Affine own = read_transform(reader);
    for (const toml::table* table : reader.tables("instance")) {
        TableReader instance(*table, location_of(*table, reader.location().path), "an instance",
                             reader.problems());
        object.instances.push_back(read_transform(instance));
        instance.finish();
    }
    if (!reader.has("instance")) {
        object.instances.assign(1, own);
        return;
    }
    for (const char* key : {"matrix", "translate", "rotate", "scale"}) {
        if (reader.has(key)) {
            reader.problem(key, str("'", key, "' stands beside instances, which have their own"),
                           "move it into them");
        }
    }
    if (object.instances.empty()) {
        reader.problem("instance", "'instance' holds no table",
                       "drop it for one instance in location");
    }
}

} // namespace

SceneObject
read_object(TableReader& reader, const std::string& name, std::vector<MaterialUse>& uses) {
    SceneObject object;
    object.name = name;
    read_sources(reader, object);
    read_materials(reader, object, uses);
    read_instances(reader, object);
    reader.finish();
    return object;
}

} // namespace heddle::scene_form
