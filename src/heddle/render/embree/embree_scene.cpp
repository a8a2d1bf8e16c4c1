#include <heddle/render/embree/embree_scene.h>

#include <heddle/render/embree/object_scene.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace heddle {
namespace {

/// Largest error of a hit, relative to its coordinates and its distance: some rounding errors in
/// single precision (6e-8), and the error of Embree's search along a curve.
constexpr float kOffPosition = 2e-6f;
constexpr float kOffDistance = 2e-7f;

/// One instance of an object.
struct Placed {
    const ObjectScene* object = nullptr;
    const TracedObject* traced = nullptr;
    Affine to_world;
    Affine to_object;

    [[nodiscard]] Vec3f direction(Vec3f d) const {
        return to_float(to_world.direction(to_double(d)));
    }
    /// Transforms a normal by the transpose of the inverse; the result has any length.
    [[nodiscard]] Vec3f normal(Vec3f n) const {
        const Vec3d d = to_double(n);
        return to_float({dot(to_object.x, d), dot(to_object.y, d), dot(to_object.z, d)});
    }
};

void check_object(const TracedObject& object, std::size_t materials) {
    if (object.geometry == nullptr || object.instances.empty()) {
        throw Error(ErrorCode::InvalidArgument, "a traced object has no geometry or no instance",
                    "give it one of each, or leave it out");
    }
    const std::string& name = object.geometry->name;
    if (object.materials.size() < object.geometry->materials.size()) {
        throw Error(ErrorCode::InvalidArgument,
                    str("'", name, "' has ", object.geometry->materials.size(), " materials, ",
                        object.materials.size(), " are mapped to the scene's"),
                    "map each of them");
    }
    for (const std::uint32_t m : object.materials) {
        if (m < materials) continue;
        throw Error(ErrorCode::InvalidArgument,
                    str("'", name, "' names scatter material ", m, " of ", materials),
                    "name one of the scene's");
    }
    for (const Affine& a : object.instances) {
        const double volume = a.determinant();
        if (std::isfinite(volume) && volume != 0.0 && std::isfinite(dot(a.offset, a.offset))) {
            continue;
        }
        throw Error(ErrorCode::InvalidArgument,
                    str("an instance of '", name, "' has determinant ", volume),
                    "give it a finite transform that keeps a volume");
    }
}

RTCRay local_ray(const Ray& ray, Vec3d origin, float t_max) {
    RTCRay r{};
    r.org_x = static_cast<float>(origin.x);
    r.org_y = static_cast<float>(origin.y);
    r.org_z = static_cast<float>(origin.z);
    r.dir_x = ray.direction.x;
    r.dir_y = ray.direction.y;
    r.dir_z = ray.direction.z;
    r.tfar = t_max;
    r.mask = ~0u;
    return r;
}

/// Makes a diffuse Surface of a fiber that is traced as a round curve, or of microflakes.
void make_diffuse(ScatterMaterial& m) {
    m.model = ScatterModel::Surface;
    m.metalness = 0.0f;
    m.specular = 0.0f;
    m.roughness = 1.0f;
    m.anisotropy = 0.0f;
}

Vec3f across(Vec3f v, Vec3f unit) {
    return normalize(v - unit * dot(v, unit), any_perpendicular(unit));
}

/// Returns the shading normal on the ray's side, bent so that it faces the ray.
Vec3f towards_viewer(Vec3f shading, Vec3f geometric, Vec3f viewer) {
    if (dot(shading, geometric) < 0.0f) shading = shading * -1.0f;
    const float seen = dot(shading, viewer);
    constexpr float kMin = 1e-3f;
    if (seen >= kMin) return shading;
    return normalize(shading + viewer * (kMin - seen), geometric);
}

class TracedScene final : public SurfaceScene {
public:
    TracedScene(std::span<const TracedObject> objects,
                std::vector<ScatterMaterial> materials,
                Progress& progress,
                const EmbreeOptions& options)
        : materials_(std::move(materials)),
          traced_(objects.begin(), objects.end()),
          device_(options.memory_bytes),
          top_(device_) {
        for (const TracedObject& traced : traced_) check_object(traced, materials_.size());
        for (const TracedObject& traced : traced_) {
            const ObjectScene& object = object_of(traced.geometry, options, progress);
            for (const Affine& a : traced.instances) {
                placed_.push_back({&object, &traced, a, inverse(a)});
                attach(placed_.back());
            }
        }
        top_.commit(device_, progress);
        rtcGetSceneBounds(top_.get(), &bounds_);
    }

    [[nodiscard]] bool intersect(const Ray& ray, TracedHit& hit) const override;
    [[nodiscard]] bool occluded(const Ray& ray) const override;
    [[nodiscard]] Bounds bounds() const override;
    [[nodiscard]] std::int64_t byte_count() const override { return device_.byte_count(); }

private:
    const ObjectScene& object_of(const std::shared_ptr<const Geometry>& geometry,
                                 const EmbreeOptions& options,
                                 Progress& progress);
    void attach(const Placed& placed);
    [[nodiscard]] bool enter(const Ray& ray, double& t) const;
    void fill(const Ray& ray, const RTCHit& found, TracedHit& hit) const;
    static void fill_curve(Vec3f tangent, TracedHit& hit);
    static void
    fill_surface(const MeshSample& sample, const Placed& placed, Vec3f viewer, TracedHit& hit);

    std::vector<ScatterMaterial> materials_;
    std::vector<TracedObject> traced_;
    EmbreeDevice device_;
    std::deque<ObjectScene> objects_;
    std::vector<Placed> placed_;
    EmbreeScene top_;
    RTCBounds bounds_{};
};

Bounds TracedScene::bounds() const {
    Bounds out;
    if (bounds_.lower_x > bounds_.upper_x) return out;
    out.grow(Vec3d{bounds_.lower_x, bounds_.lower_y, bounds_.lower_z});
    out.grow(Vec3d{bounds_.upper_x, bounds_.upper_y, bounds_.upper_z});
    return out;
}

// Geometry that several objects share is built once.
const ObjectScene& TracedScene::object_of(const std::shared_ptr<const Geometry>& geometry,
                                          const EmbreeOptions& options,
                                          Progress& progress) {
    for (const ObjectScene& object : objects_) {
        if (&object.geometry() == geometry.get()) return object;
    }
    return objects_.emplace_back(device_, geometry, options, progress);
}

void TracedScene::attach(const Placed& placed) {
    const RTCGeometry instance = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, placed.object->scene());
    float m[12];
    const Vec3d columns[4] = {placed.to_world.x, placed.to_world.y, placed.to_world.z,
                              placed.to_world.offset};
    for (int c = 0; c < 4; ++c) {
        for (int a = 0; a < 3; ++a) m[3 * c + a] = static_cast<float>(columns[c][a]);
    }
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, m);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(top_.get(), instance, static_cast<unsigned>(placed_.size() - 1));
    rtcReleaseGeometry(instance);
}

// Finds where the ray enters the scene's box. Embree's ray starts there, so that single precision
// is enough for fibers that are seen from far away.
bool TracedScene::enter(const Ray& ray, double& t) const {
    const double lo[3] = {bounds_.lower_x, bounds_.lower_y, bounds_.lower_z};
    const double hi[3] = {bounds_.upper_x, bounds_.upper_y, bounds_.upper_z};
    double begin = 0.0;
    auto end = static_cast<double>(ray.t_max);
    for (int a = 0; a < 3; ++a) {
        const double inv =
            1.0 / static_cast<double>(ray.direction[a]); // 1 / 0 is infinite, as required
        const double t0 = (lo[a] - ray.origin[a]) * inv;
        const double t1 = (hi[a] - ray.origin[a]) * inv;
        begin = std::max(begin, std::min(t0, t1)); // if NaN (on a face), the other argument is kept
        end = std::min(end, std::max(t0, t1));
    }
    if (!(begin <= end)) return false;
    t = begin > 0.0 ? begin * (1.0 - 1e-6) : 0.0; // the hit may lie on the face of the box
    return true;
}

bool TracedScene::intersect(const Ray& ray, TracedHit& hit) const {
    double begin = 0.0;
    if (!enter(ray, begin)) return false;
    const auto left = static_cast<float>(static_cast<double>(ray.t_max) - begin);
    RTCRayHit r{local_ray(ray, ray.at(begin), left), {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(top_.get(), &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit.t = static_cast<float>(begin + static_cast<double>(r.ray.tfar));
    fill(ray, r.hit, hit);
    return true;
}

bool TracedScene::occluded(const Ray& ray) const {
    double begin = 0.0;
    if (!enter(ray, begin)) return false;
    RTCRay r =
        local_ray(ray, ray.at(begin), static_cast<float>(static_cast<double>(ray.t_max) - begin));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(top_.get(), &context, &r);
    return r.tfar < 0.0f;
}

void TracedScene::fill(const Ray& ray, const RTCHit& found, TracedHit& hit) const {
    const Placed& placed = placed_[found.instID[0]];
    const ObjectSample sample =
        placed.object->sample({found.geomID, found.primID, found.u, found.v});
    const Vec3f viewer = ray.direction * -1.0f;
    hit.object = found.instID[0];
    hit.material = placed.traced->materials[sample.material];
    hit.scatterer.material = materials_[hit.material];
    hit.scatterer.lobe = {};
    ScatterMaterial& m = hit.scatterer.material;
    m.albedo = m.albedo * sample.surface.albedo;
    hit.normal = normalize(placed.normal({found.Ng_x, found.Ng_y, found.Ng_z}), viewer);
    if (dot(hit.normal, viewer) < 0.0f) hit.normal = hit.normal * -1.0f;
    const Vec3d p = ray.at(static_cast<double>(hit.t));
    const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    hit.offset = kOffPosition * static_cast<float>(size) + kOffDistance * hit.t;
    if (sample.curve) {
        fill_curve(normalize(placed.direction(sample.surface.tangent)), hit);
    } else {
        fill_surface(sample.surface, placed, viewer, hit);
    }
}

void TracedScene::fill_curve(Vec3f tangent, TracedHit& hit) {
    Scatterer& s = hit.scatterer;
    if (s.material.model == ScatterModel::LobeFiber || s.material.model == ScatterModel::Hair) {
        s.axis = tangent;
        s.tangent = across(hit.normal, tangent);
        return;
    }
    if (s.material.model != ScatterModel::Surface) make_diffuse(s.material);
    s.axis = hit.normal;
    s.tangent = across(tangent, s.axis);
}

void TracedScene::fill_surface(const MeshSample& sample,
                               const Placed& placed,
                               Vec3f viewer,
                               TracedHit& hit) {
    Scatterer& s = hit.scatterer;
    if (s.material.model != ScatterModel::Surface) make_diffuse(s.material);
    s.material.roughness *= sample.roughness;
    s.material.metalness *= sample.metalness;
    s.material.anisotropy *= sample.anisotropy;
    const Vec3f shading = normalize(placed.normal(sample.normal), hit.normal);
    s.axis = towards_viewer(shading, hit.normal, viewer);
    s.tangent = across(placed.direction(sample.tangent), s.axis);
}

} // namespace

std::unique_ptr<SurfaceScene> build_embree_scene(std::span<const TracedObject> objects,
                                                 std::vector<ScatterMaterial> materials,
                                                 Progress& progress,
                                                 const EmbreeOptions& options) {
    return std::make_unique<TracedScene>(objects, std::move(materials), progress, options);
}

} // namespace heddle
