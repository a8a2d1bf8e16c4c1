#include <heddle/render/volume.h>

#include <heddle/render/clip.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/sggx/sample.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heddle {
namespace {

Vec3d scale(Vec3i index, Vec3d h) {
    return Vec3d{static_cast<double>(index.x), static_cast<double>(index.y),
                 static_cast<double>(index.z)} *
           h;
}

/// S of R x, for x of S.
SggxMatrix rotate(const SggxMatrix& S, const Affine& turn) {
    const SymmetricEigen e = decompose(S);
    SymmetricEigen out = e;
    for (int i = 0; i < 3; ++i) out.axis[i] = normalize(turn.direction(e.axis[i]), e.axis[i]);
    return compose(out);
}

bool is_identity(const Affine& a) {
    return a.x == Affine{}.x && a.y == Affine{}.y && a.z == Affine{}.z;
}

} // namespace

Volume::Volume(VolumePyramid pyramid, const Affine& to_world, std::vector<std::uint32_t> materials)
    : pyramid_(std::move(pyramid)),
      to_world_(to_world),
      to_object_(inverse(to_world)),
      rotated_(!is_identity(to_world)),
      scale_(static_cast<float>(std::cbrt(std::fabs(to_world.determinant())))),
      materials_(std::move(materials)) {
    bool finest = true;
    for (const auto& level : pyramid_) {
        Bounds& box = level_bounds_.emplace_back();
        if (!level || level->lo() == level->hi()) continue;
        const Vec3d h = level->info().lattice.voxel_size;
        box = {scale(level->lo(), h), scale(level->hi(), h)};
        object_bounds_.grow(box);
        if (!finest) continue;
        finest = false;
        for (int c = 0; c < 8; ++c) {
            world_bounds_.grow(to_world_.point({(c & 1) != 0 ? box.hi.x : box.lo.x,
                                                (c & 2) != 0 ? box.hi.y : box.lo.y,
                                                (c & 4) != 0 ? box.hi.z : box.lo.z}));
        }
        for (int a = 0; a < 3; ++a) {
            Vec3d edge{};
            edge[a] = std::ldexp(h[a], -level->info().level);
            voxel_size_ = std::max(voxel_size_, length(to_world_.direction(edge)));
        }
    }
}

int Volume::usable_level(int level) const {
    const int last = static_cast<int>(pyramid_.size()) - 1;
    const int wanted = std::clamp(level, 0, last);
    for (int away = 0; away <= last; ++away) { // a coarser one before a finer one
        for (const int l : {wanted + away, wanted - away}) {
            if (l >= 0 && l <= last && pyramid_[static_cast<std::size_t>(l)]) return l;
        }
    }
    return 0;
}

template <typename Note>
void Volume::walk(const Ray& ray,
                  const LevelChoice& choice,
                  TransportWalker& walker,
                  const Note& note) const {
    if (object_bounds_.empty()) return; // no ray would ever leave it
    const Vec3d origin = to_object_.point(ray.origin);
    const Vec3d direction = to_object_.direction(to_double(ray.direction));
    const RayRange range = clip(origin, direction, ray.clear, ray.t_max, object_bounds_);
    for (float t = range.t0; t < range.t1 && !walker.stopped();) {
        // the level holds until the footprint asks for the next
        float end = range.t1;
        int wanted = choice.forced;
        if (wanted < 0) {
            const float width = std::max(ray.width_at(t), 1e-30f);
            const float shift = choice.offset + choice.draw;
            const float fine = std::log2(width / static_cast<float>(voxel_size_)) + shift;
            wanted = static_cast<int>(std::clamp(std::floor(fine), 0.0f, 62.0f));
            const auto until = [&](int level) { // t at which the ray is too wide for it
                const float next = static_cast<float>(voxel_size_) *
                                   std::exp2(static_cast<float>(level) + 1.0f - shift);
                return (next - ray.width) / ray.spread;
            };
            if (ray.spread > 0.0f) {
                if (until(wanted) <= t * 1.00001f) ++wanted; // rounding: the last one's end
                end = std::min(end, std::max(until(wanted), t * 1.00001f));
            }
        }
        const int number = usable_level(wanted);
        const VolumeLevel& level = *pyramid_[static_cast<std::size_t>(number)];
        const Vec3d h = level.info().lattice.voxel_size;
        const Vec3d per{1.0 / h.x, 1.0 / h.y, 1.0 / h.z};
        const VoxelRay voxel_ray{origin * per, direction * per};
        walker.enter(level, voxel_ray);
        const RayRange inside =
            clip(origin, direction, t, end, level_bounds_[static_cast<std::size_t>(number)]);
        walk_voxels(level, voxel_ray, inside.t0, inside.t1, [&](const VoxelStep& step) {
            if (walker.pass(level, step)) return true;
            note(number, step);
            return false;
        });
        t = end;
    }
}

bool Volume::sample_flight(const Ray& ray,
                           Transport transport,
                           const LevelChoice& choice,
                           StreamRandom& random,
                           VolumeHit& hit) const {
    TransportWalker walker(transport, true, ray.bulk, random);
    walk(ray, choice, walker, [&](int level, const VoxelStep& step) {
        hit = {walker.t(), level, &step.leaf, step.voxel};
    });
    return walker.stopped();
}

float Volume::transmittance(const Ray& ray,
                            Transport transport,
                            const LevelChoice& choice,
                            StreamRandom& random) const {
    TransportWalker walker(transport, false, ray.bulk, random);
    walk(ray, choice, walker, [](int, const VoxelStep&) {});
    return walker.transmittance();
}

VolumeScatter Volume::scatter(const VolumeHit& hit,
                              Vec3f wi,
                              std::span<const ScatterMaterial> materials,
                              StreamRandom& random) const {
    const VolumeLevel& level = *pyramid_[static_cast<std::size_t>(hit.level)];
    const VolumeLevel::LobeRange range = level.lobes_of(*hit.leaf, hit.voxel);
    const Vec3f from = rotated_ ? to_float(normalize(to_object_.direction(to_double(wi)))) : wi;
    int whole = 0;
    for (std::size_t i = 0; i < range.count; ++i) whole += level.lobe(range.first + i).weight;

    constexpr int kTries = 64; // a needle seen end on: the last is kept
    std::size_t chosen = range.first;
    SggxMatrix S{};
    SggxFactor A{};
    std::size_t factored = std::numeric_limits<std::size_t>::max();
    Vec3f axis{};
    bool fiber = false;
    for (int i = 0; i < kTries; ++i) {
        int at = static_cast<int>(random.uniform() * static_cast<float>(whole));
        chosen = range.first;
        while (chosen + 1 < range.first + range.count && at >= level.lobe(chosen).weight) {
            at -= level.lobe(chosen++).weight;
        }
        if (chosen != factored) {
            S = unpack(level.lobe(chosen).sggx);
            A = factor(S);
            factored = chosen;
            fiber = level.info().materials[level.lobe(chosen).material].kind == MaterialKind::Fiber;
        }
        axis = sample_ndf(A, random);
        const float c = dot(axis, from);
        const float seen = fiber ? std::sqrt(std::max(0.0f, 1.0f - c * c)) : std::fabs(c);
        if (random.uniform() < seen) break;
    }

    VolumeScatter drawn;
    drawn.material = materials_[level.lobe(chosen).material];
    drawn.fiber = fiber;
    if (fiber) {
        drawn.radius = level.info().materials[level.lobe(chosen).material].fiber_radius * scale_;
    }
    drawn.edge = static_cast<float>(std::ldexp(voxel_size_, hit.level));
    Scatterer& out = drawn.scatterer;
    out.material = materials[drawn.material];
    if (const LobeMaps* maps = level.maps(chosen)) {
        constexpr float kUnit = 1.0f / 255.0f;
        for (int a = 0; a < 3; ++a) {
            out.material.albedo[a] *=
                kUnit * static_cast<float>(maps->albedo[static_cast<std::size_t>(a)]);
        }
        out.material.roughness *= kUnit * static_cast<float>(maps->roughness);
        out.material.metalness *= kUnit * static_cast<float>(maps->metalness);
        out.material.anisotropy *= kUnit * static_cast<float>(maps->anisotropy);
    }
    if (!fiber && dot(axis, from) < 0.0f) axis = axis * -1.0f;
    Vec3f tangent = any_perpendicular(axis);
    if (const PackedSggx* lobe = level.tangent(chosen);
        lobe != nullptr && is_positive_definite(*lobe)) {
        const Vec3f t = sample_ndf(factor(unpack(*lobe)), random);
        tangent = normalize(t - axis * dot(t, axis), tangent);
    }
    const bool flakes = out.material.model == ScatterModel::MicroflakeSpecular ||
                        out.material.model == ScatterModel::MicroflakeDiffuse;
    if (flakes && fiber) { // flakes lie around the fiber
        S = fit_sggx(moment_of_normals(second_moment_of(S)));
        axis = sample_vndf(factor(S), from, random);
        tangent = any_perpendicular(axis);
    }
    if (rotated_) {
        const bool normal = !fiber || flakes;
        const auto turn = [&](Vec3f d, bool as_normal) {
            const Vec3d v = to_double(d);
            const Vec3d w =
                as_normal ? Vec3d{dot(to_object_.x, v), dot(to_object_.y, v), dot(to_object_.z, v)}
                          : to_world_.direction(v);
            return to_float(normalize(w));
        };
        axis = turn(axis, normal);
        tangent = turn(tangent, false);
        tangent = normalize(tangent - axis * dot(tangent, axis), any_perpendicular(axis));
        if (flakes) S = rotate(S, to_world_);
    }
    out.axis = axis;
    out.tangent = tangent;
    out.lobe = S;
    return drawn;
}

} // namespace heddle
