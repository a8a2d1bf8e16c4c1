#include <heddle/stage/scene_hash.h>

#include <heddle/base/random.h>

#include <bit>
#include <filesystem>
#include <initializer_list>
#include <system_error>

namespace heddle {
namespace {

class Hash {
public:
    [[nodiscard]] std::uint64_t value() const { return value_; }

    void number(double x) { value_ = hash64(value_, std::bit_cast<std::uint64_t>(x)); }
    void numbers(std::initializer_list<float> all) {
        for (const float x : all) number(static_cast<double>(x));
    }
    void whole(std::int64_t x) { value_ = hash64(value_, static_cast<std::uint64_t>(x)); }
    void color(Vec3f v) { numbers({v.x, v.y, v.z}); }
    void vector(Vec3d v) {
        for (int a = 0; a < 3; ++a) number(v[a]);
    }
    void text(const std::string& s) {
        whole(static_cast<std::int64_t>(s.size()));
        for (const char c : s) value_ = hash64(value_, static_cast<unsigned char>(c));
    }
    /// Adds a path with the size and time of its file; without a file (a preset), the text alone.
    void file(const std::string& path) {
        text(path);
        std::error_code error;
        const auto size = std::filesystem::file_size(path, error);
        if (path.empty() || error) return;
        whole(static_cast<std::int64_t>(size));
        const auto time = std::filesystem::last_write_time(path, error);
        if (!error) whole(static_cast<std::int64_t>(time.time_since_epoch().count()));
    }

private:
    std::uint64_t value_ = 1;
};

void add(Hash& h, const GenerateOptions& g) {
    for (const std::int64_t x :
         {static_cast<std::int64_t>(g.kind), static_cast<std::int64_t>(g.shape),
          static_cast<std::int64_t>(g.nx), static_cast<std::int64_t>(g.ny),
          static_cast<std::int64_t>(g.seed)}) {
        h.whole(x);
    }
    h.number(static_cast<double>(g.radius));
    h.number(static_cast<double>(g.spacing));
}

void add(Hash& h, const SceneObject& object) {
    h.text(object.name);
    h.file(object.volume);
    h.file(object.geometry);
    h.file(object.yarn);
    h.whole(object.generate.has_value() ? 1 : 0);
    if (object.generate) add(h, *object.generate);
    h.number(object.yarn_radius);
    h.number(object.fiber_radius);
    h.whole(object.fibers);
    for (const Affine& a : object.instances) {
        for (const Vec3d v : {a.x, a.y, a.z, a.offset}) h.vector(v);
    }
    for (const auto& [from, to] : object.materials) {
        h.text(from);
        h.text(to);
    }
}

void add(Hash& h, const ScatterMaterial& m) {
    h.whole(static_cast<std::int64_t>(m.model));
    for (const Vec3f c : {m.albedo, m.color_r, m.color_tt, m.absorption}) h.color(c);
    h.numbers({m.roughness, m.metalness, m.anisotropy, m.specular, m.width_r, m.width_tt,
               m.azimuth_tt, m.width_m, m.width_n, m.eta, m.tilt});
}

void add(Hash& h, const SceneLight& light) {
    h.whole(static_cast<std::int64_t>(light.kind));
    h.color(light.color);
    h.file(light.image);
    h.number(light.turn_deg);
    for (const Vec3d v : {light.direction, light.position, light.edge_u, light.edge_v}) h.vector(v);
}

void add(Hash& h, const SceneCamera& camera) {
    h.whole(static_cast<std::int64_t>(camera.kind));
    for (const Vec3d v : {camera.eye, camera.target, camera.up}) h.vector(v);
    for (const double x :
         {camera.view_angle_deg, camera.view_height, camera.lens_radius, camera.focus_distance}) {
        h.number(x);
    }
}

} // namespace

std::uint64_t hash_of_scene(const Scene& scene, const PathOptions& options, bool geometry) {
    Hash h;
    for (const SceneObject& object : scene.objects) add(h, object);
    for (const auto& [name, material] : scene.materials) {
        h.text(name);
        add(h, material);
    }
    for (const SceneLight& light : scene.lights) add(h, light);
    if (scene.camera) add(h, *scene.camera);
    for (const std::int64_t x :
         {static_cast<std::int64_t>(scene.integrator.seed),
          static_cast<std::int64_t>(options.max_depth),
          static_cast<std::int64_t>(options.roulette_depth),
          static_cast<std::int64_t>(options.level), static_cast<std::int64_t>(options.transport),
          static_cast<std::int64_t>(options.with_transmittance),
          static_cast<std::int64_t>(geometry)}) {
        h.whole(x);
    }
    h.number(static_cast<double>(options.level_offset));
    return h.value();
}

} // namespace heddle
