#include <heddle/render/embree/object_scene.h>

#include <heddle/base/random.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace heddle {
namespace {

/// Bytes per cubic of a fiber: control points and index 52, tree 47 to 54 (measured on
/// flame_ribbing_pattern.bcc with 30 to 150 fibers), and a tenth for flyaway hairs. Embree frees
/// its builder's lists before the tree is complete, so the final size is also the peak.
constexpr std::int64_t kBytesPerSegment = 118;

/// Returns a length of the order of the geometry. The scales of yarns are kept in this unit in
/// single precision, so the last bits of a picture depend on it.
double unit_of(const Geometry& geometry) {
    Bounds box;
    for (const CurveSet& set : geometry.curves) {
        for (const Vec3f p : set.points) box.grow(to_double(p));
    }
    const Vec3d size = box.size();
    return 1.0 + std::max({size.x, size.y, size.z});
}

RTCGeometryType type_of(RoundBasis basis) {
    switch (basis) {
    case RoundBasis::Linear: return RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE;
    case RoundBasis::CatmullRom: return RTC_GEOMETRY_TYPE_ROUND_CATMULL_ROM_CURVE;
    case RoundBasis::CubicBSpline: return RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE;
    case RoundBasis::Bezier: return RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE;
    }
    return RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE;
}

template <typename T>
void share(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& v) {
    rtcSetSharedGeometryBuffer(geometry, type, 0, format, v.data(), 0, sizeof(T), v.size());
}

} // namespace

ObjectScene::ObjectScene(EmbreeDevice& device,
                         std::shared_ptr<const Geometry> geometry,
                         const EmbreeOptions& options,
                         Progress& progress)
    : device_(device),
      geometry_(std::move(geometry)),
      options_(options),
      surfaces_(*geometry_),
      scene_(device) {
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_COMPACT);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_MEDIUM);
    device_.own(surfaces_.byte_count());
    for (std::uint32_t m = 0; m < geometry_->meshes.size(); ++m) attach_mesh(m);
    add_curves(progress);
    std::int64_t primitives = 0;
    for (const Part& part : parts_) {
        primitives +=
            static_cast<std::int64_t>(part.curve ? part.curves.segments.size()
                                                 : geometry_->meshes[part.mesh].triangles.size());
    }
    progress.begin("tree", "primitives", primitives);
    scene_.commit(device_, progress);
    progress.advance(primitives);
}

void ObjectScene::add_curves(Progress& progress) {
    if (geometry_->curves.empty()) return;
    for (const CurveSet& set : geometry_->curves) {
        if (set.material < geometry_->materials.size()) continue;
        throw Error(ErrorCode::InvalidArgument,
                    str("a set of curves names material ", set.material, " of ",
                        geometry_->materials.size()),
                    "give every set a material of the geometry");
    }
    constexpr double kWholeSpans = std::numeric_limits<double>::infinity();
    const FiberSource source(*geometry_, kWholeSpans, options_.seed);
    const double unit = unit_of(*geometry_);
    std::uint64_t first_span = 0;
    for (std::uint32_t s = 0; s < geometry_->curves.size(); ++s) {
        const CurveSet& set = geometry_->curves[s];
        const YarnType* yarn = geometry_->yarn_of(set);
        if (yarn == nullptr || yarn->model == YarnModel::Solid) {
            attach_curves(plain_curves(*geometry_, set));
        } else {
            add_yarns(source, {s, first_span, unit}, progress);
        }
        for (std::size_t c = 0; c < set.curve_count(); ++c) first_span += set.span_count(c);
    }
}

void ObjectScene::add_yarns(const FiberSource& source, YarnSet yarns, Progress& progress) {
    int cubics = choose_cubics(source, yarns, options_.tolerance);
    const std::int64_t left = options_.memory_bytes - device_.byte_count();
    const auto needed = [&] {
        return static_cast<std::int64_t>(count_yarn_segments(source, yarns, cubics)) *
               kBytesPerSegment;
    };
    while (cubics > 1 && needed() > left) --cubics;
    if (needed() > left) {
        throw Error(ErrorCode::OutOfMemory,
                    str("the fibers of '", geometry_->name, "' take ", needed(), " bytes (limit ",
                        left, ")"),
                    "allow more memory, use fewer fibers a yarn, or render the volume");
    }
    attach_curves(yarn_curves(source, yarns, cubics, progress));
    attach_curves(yarn_hairs(source, yarns, progress));
}

void ObjectScene::attach_curves(RoundCurves curves) {
    if (curves.segments.empty()) return;
    parts_.push_back({.object = this, .curve = true, .curves = std::move(curves)});
    Part& part = parts_.back();
    device_.own(part.curves.byte_count());
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), type_of(part.curves.basis));
    share(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, part.curves.points);
    share(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, part.curves.segments);
    if (!part.curves.flags.empty()) {
        share(geometry, RTC_BUFFER_TYPE_FLAGS, RTC_FORMAT_UCHAR, part.curves.flags);
    }
    rtcSetGeometryUserData(geometry, &part);
    rtcSetGeometryIntersectFilterFunction(geometry, &ObjectScene::filter_back);
    rtcSetGeometryOccludedFilterFunction(geometry, &ObjectScene::filter_back);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, static_cast<unsigned>(parts_.size() - 1));
    rtcReleaseGeometry(geometry);
}

void ObjectScene::attach_mesh(std::uint32_t m) {
    const Mesh& mesh = geometry_->meshes[m];
    if (mesh.triangles.empty()) return;
    parts_.push_back({.object = this, .mesh = m, .curve = false, .curves = {}});
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree copies these: it reads 16 bytes per vertex, but our last vertex ends after 12
    void* const positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vec3f), mesh.positions.size());
    if (positions != nullptr) {
        std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Vec3f*>(positions));
    }
    share(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    rtcSetGeometryUserData(geometry, &parts_.back());
    if (surfaces_.has_alpha(m)) {
        rtcSetGeometryIntersectFilterFunction(geometry, &ObjectScene::filter_alpha);
        rtcSetGeometryOccludedFilterFunction(geometry, &ObjectScene::filter_alpha);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, static_cast<unsigned>(parts_.size() - 1));
    rtcReleaseGeometry(geometry);
}

// Ignores back faces of round curves, so that a ray that starts inside a curve leaves it.
void ObjectScene::filter_back(const RTCFilterFunctionNArguments* a) {
    for (unsigned i = 0; i < a->N; ++i) {
        const Vec3f direction{RTCRayN_dir_x(a->ray, a->N, i), RTCRayN_dir_y(a->ray, a->N, i),
                              RTCRayN_dir_z(a->ray, a->N, i)};
        const Vec3f normal{RTCHitN_Ng_x(a->hit, a->N, i), RTCHitN_Ng_y(a->hit, a->N, i),
                           RTCHitN_Ng_z(a->hit, a->N, i)};
        if (dot(direction, normal) > 0.0f) a->valid[i] = 0;
    }
}

void ObjectScene::filter_alpha(const RTCFilterFunctionNArguments* a) {
    const Part& part = *static_cast<const Part*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
        const ObjectPoint at{RTCHitN_geomID(a->hit, a->N, i), RTCHitN_primID(a->hit, a->N, i),
                             RTCHitN_u(a->hit, a->N, i), RTCHitN_v(a->hit, a->N, i)};
        if (!covers(part, at)) a->valid[i] = 0;
    }
}

bool ObjectScene::covers(const Part& part, const ObjectPoint& at) {
    const float alpha = part.object->surfaces_.alpha(part.mesh, {at.primitive, at.u, at.v});
    if (alpha >= 1.0f) return true;
    if (alpha <= 0.0f) return false;
    const auto word = [](std::uint32_t high, std::uint32_t low) {
        return std::uint64_t{high} << 32 | low;
    };
    const std::uint64_t hash =
        hash64(part.object->options_.seed, word(at.geometry, at.primitive),
               word(std::bit_cast<std::uint32_t>(at.u), std::bit_cast<std::uint32_t>(at.v)));
    return alpha > to_unit_float(hash);
}

ObjectSample ObjectScene::sample(const ObjectPoint& at) const {
    const Part& part = parts_[at.geometry];
    ObjectSample s;
    s.curve = part.curve;
    if (!part.curve) {
        s.material = geometry_->meshes[part.mesh].material;
        s.surface = surfaces_.sample(part.mesh, {at.primitive, at.u, at.v});
        return s;
    }
    s.material = part.curves.material;
    s.surface.tangent = part.curves.derivative(at.primitive, at.u);
    s.surface.albedo = part.curves.color(at.primitive);
    return s;
}

} // namespace heddle
