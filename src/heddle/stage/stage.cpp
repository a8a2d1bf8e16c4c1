#include <heddle/stage/stage.h>

#include <heddle/base/error.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/render/embree/embree_scene.h>
#include <heddle/scatter/scatter_material.h>
#include <heddle/scene/load_object.h>
#include <heddle/stage/load_lights.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace heddle {
namespace {

bool is_traced(const SceneObject& object, const StageOptions& options) {
    const bool explicit_too = !object.geometry.empty() || object.generate.has_value();
    return object.volume.empty() || (options.geometry && explicit_too);
}

/// Returns the largest factor by which a transform changes a length.
double scale_of(const Affine& a) {
    return std::max({length(a.x), length(a.y), length(a.z)});
}

/// Returns the distance from a point to a box.
double distance_to(const Bounds& box, Vec3d p) {
    Vec3d away{};
    for (int a = 0; a < 3; ++a) away[a] = std::max({box.lo[a] - p[a], p[a] - box.hi[a], 0.0});
    return length(away);
}

/// @throws Error  BadFile: no voxels, or the level that the scene forces does not exist
std::vector<VoxelLevelInfo> read_levels_of(const SceneObject& object, const Scene& scene) {
    std::vector<VoxelLevelInfo> infos = read_infos(object.volume);
    const int count = static_cast<int>(infos.size());
    if (scene.integrator.level >= count) {
        throw Error(ErrorCode::BadFile,
                    str("has no level ", scene.integrator.level, " (levels 0 to ", count - 1, ")"),
                    "give a level that it has", {.path = object.volume});
    }
    if (infos.front().voxel_count == 0) {
        throw Error(ErrorCode::BadFile, "has no voxels", "take the object out of the scene",
                    {.path = object.volume});
    }
    return infos;
}

/// Notes that a volume does not say where in its voxels matter is, so that `product` is used.
void note_what_is_missing(const SceneObject& object,
                          const VoxelLevelInfo& info,
                          Progress& progress) {
    const auto is_surface = [](const Material& m) { return m.kind == MaterialKind::Surface; };
    const bool surfaces = std::any_of(info.materials.begin(), info.materials.end(), is_surface);
    const bool known = surfaces ? info.fields.slabs : info.fields.occupancy;
    if (known) return;
    progress.note(str(object.volume, ": does not store ",
                      surfaces ? "the slabs of its surfaces" : "the occupancy of its voxels",
                      ", so --transport product is used; voxelize it again for a better picture"));
}

} // namespace

Stage::Stage(const Scene& scene, const StageOptions& options, Progress& progress)
    : width_(scene.width),
      height_(scene.height),
      level_(scene.integrator.level),
      level_offset_(options.level_offset) {
    for (const SceneObject& object : scene.objects) {
        if (is_traced(object, options)) continue;
        options.flakes ? add_flakes(object, scene) : open_volume(object, scene, progress);
    }
    trace_geometry(scene, options, progress);
    for (OpenVolume& volume : open_) read_level(volume);
    rebuild_volumes();
    if (scene.camera) { // it gives the levels that are needed; else the levels' bounds place it
        place_camera(scene);
        choose_levels();
    }
    while (read_next(options.coarse_voxels)) progress.check();
    if (!scene.camera) {
        place_camera(scene);
        choose_levels();
    }
    const Bounds box = bounds();
    scene_.lights = LightSet(load_lights(scene, parameters_.up), 0.5 * length(box.size()));
}

void Stage::read_level(OpenVolume& volume) {
    std::unique_ptr<MemoryLevel> level = read_vdb(volume.path, volume.next);
    auto made = std::make_shared<TraversalLevel>(*level, volume.parents.get());
    volume.parents.reset();
    if (made->has_cells() && volume.next > 0) volume.parents = std::move(level);
    volume.levels[static_cast<std::size_t>(volume.next--)] = std::move(made);
}

void Stage::open_volume(const SceneObject& object, const Scene& scene, Progress& progress) {
    const std::vector<VoxelLevelInfo> infos = read_levels_of(object, scene);
    if (transport_from(scene.integrator.transport) == Transport::Automatic) {
        note_what_is_missing(object, infos.front(), progress);
    }
    OpenVolume volume;
    volume.path = object.volume;
    volume.levels.resize(infos.size());
    for (const VoxelLevelInfo& info : infos) volume.voxels.push_back(info.voxel_count);
    const Vec3d h = infos.front().lattice.voxel_size;
    volume.voxel_size = std::max({h.x, h.y, h.z});
    volume.instances = object.instances;
    for (const Material& material : infos.front().materials) {
        volume.materials.push_back(material_of(scene, object, material));
    }
    volume.next = static_cast<int>(infos.size()) - 1;
    open_.push_back(std::move(volume));
}

void Stage::add_flakes(const SceneObject& object, const Scene& scene) {
    const std::vector<VoxelLevelInfo> infos = read_levels_of(object, scene);
    if (infos.front().voxel_count == 0) return;
    std::vector<std::uint32_t> materials;
    std::vector<Vec3f> albedo;
    for (const Material& material : infos.front().materials) {
        materials.push_back(material_of(scene, object, material));
        albedo.push_back(scene_.materials[materials.back()].albedo);
    }
    std::unique_ptr<MemoryLevel> level =
        read_vdb(object.volume, std::max(scene.integrator.level, 0));
    auto field = std::make_unique<FlakeField>(*level, albedo);
    level.reset();
    const auto grid = std::make_shared<const FlakeGrid>(*field);
    field.reset();
    flake_bytes_ += grid->byte_count();
    for (const Affine& instance : object.instances) {
        scene_.flakes.emplace_back(grid, instance, materials.front());
    }
}

std::uint32_t
Stage::material_of(const Scene& scene, const SceneObject& object, const Material& material) {
    std::string name = object.name + "/" + material.name;
    ScatterMaterial scatter = scatter_material_of(material);
    bool shared = false; // two materials of an object may have one name
    for (const std::string& key : {material.name, std::string("*")}) {
        const auto named = object.materials.find(key);
        if (named == object.materials.end()) continue;
        name = named->second;
        scatter = scene.materials.at(name);
        shared = true;
        break;
    }
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (shared && at != names_.end()) return static_cast<std::uint32_t>(at - names_.begin());
    names_.push_back(name);
    scene_.materials.push_back(scatter);
    return static_cast<std::uint32_t>(names_.size() - 1);
}

void Stage::trace_geometry(const Scene& scene, const StageOptions& options, Progress& progress) {
    std::vector<TracedObject> traced;
    for (const SceneObject& object : scene.objects) {
        if (!is_traced(object, options)) continue;
        auto geometry = std::make_shared<Geometry>(load_object_geometry(object));
        TracedObject out;
        out.instances = object.instances;
        for (const Material& material : geometry->materials) {
            out.materials.push_back(material_of(scene, object, material));
        }
        out.geometry = std::move(geometry);
        traced.push_back(std::move(out));
    }
    if (traced.empty()) return;
    auto surfaces = build_embree_scene(traced, scene_.materials, progress);
    surface_bounds_ = surfaces->bounds();
    scene_.surfaces = std::move(surfaces);
}

void Stage::rebuild_volumes() {
    scene_.volumes.clear();
    for (const OpenVolume& volume : open_) {
        for (const Affine& instance : volume.instances) {
            scene_.volumes.emplace_back(volume.levels, instance, volume.materials);
        }
    }
}

Bounds Stage::bounds() const {
    Bounds box = surface_bounds_;
    for (const VolumeInstance& volume : scene_.volumes) {
        if (!volume.bounds().empty()) box.grow(volume.bounds());
    }
    for (const FlakeMedium& medium : scene_.flakes) box.grow(medium.bounds());
    return box;
}

void Stage::place_camera(const Scene& scene) {
    if (scene.camera) {
        const SceneCamera& from = *scene.camera;
        parameters_.orthographic = from.kind == SceneCamera::Kind::Orthographic;
        parameters_.eye = from.eye;
        parameters_.target = from.target;
        parameters_.up = from.up;
        parameters_.view_angle = from.view_angle_deg * std::numbers::pi / 180.0;
        parameters_.view_height = from.view_height;
        parameters_.lens_radius = from.lens_radius;
        parameters_.focus_distance = from.focus_distance;
    } else { // three-quarter view from above; flat objects are seen from the front
        const Vec3d size = bounds().size();
        Vec3d from{0.5, 0.35, 1.0};
        if (size.z < 0.5 * std::min(size.x, size.y)) from = {0.25, -0.8, 1.0};
        if (size.y < 0.5 * std::min(size.x, size.z)) from = {0.25, 1.0, 0.8};
        parameters_ = frame(bounds(), from, {0, 1, 0}, static_cast<double>(width_) / height_);
    }
    camera_ = std::make_unique<Camera>(parameters_, width_, height_);
}

/// Finds the finest level that rays need: that of the narrowest footprint on the object's box. This
/// is of a ray through a corner of the picture, which widens least, at the distance of the box.
/// Scattered rays are wider than the rays from which they come.
void Stage::choose_levels() {
    const Ray corner = camera_->ray(0.0f, 0.0f, {0.0f, 0.0f});
    std::size_t at = 0;
    for (OpenVolume& volume : open_) {
        const int last = static_cast<int>(volume.levels.size()) - 1;
        volume.finest_wanted = last;
        for (const Affine& instance : volume.instances) {
            const double away =
                std::max(0.0, distance_to(scene_.volumes[at++].bounds(), parameters_.eye) -
                                  parameters_.lens_radius);
            const double width =
                static_cast<double>(corner.width) + static_cast<double>(corner.spread) * away;
            const double level = std::log2(width / (volume.voxel_size * scale_of(instance))) +
                                 static_cast<double>(level_offset_); // -inf: inside the box
            const double needed = std::clamp(std::floor(level), 0.0, static_cast<double>(last));
            volume.finest_wanted = std::min(volume.finest_wanted, static_cast<int>(needed));
        }
        if (level_ >= 0) volume.finest_wanted = level_;
    }
}

bool Stage::read_next(std::int64_t most_voxels) {
    OpenVolume* coarsest = nullptr;
    for (OpenVolume& v : open_) {
        if (v.next < v.finest_wanted || v.voxels[static_cast<std::size_t>(v.next)] > most_voxels)
            continue;
        if (coarsest == nullptr || v.next > coarsest->next) coarsest = &v;
    }
    if (coarsest == nullptr) return false;
    read_level(*coarsest);
    rebuild_volumes();
    if (camera_) choose_levels(); // the box of a finer level is tighter and may be farther away
    return true;
}

std::int64_t Stage::byte_count() const {
    std::int64_t sum = flake_bytes_ + (scene_.surfaces ? scene_.surfaces->byte_count() : 0);
    for (const OpenVolume& volume : open_) {
        for (const auto& level : volume.levels) sum += level ? level->byte_count() : 0;
    }
    return sum;
}

} // namespace heddle
