#include <heddle/render/volume/volume_instance.h>

#include <heddle/render/volume/clip.h>
#include <heddle/render/volume/transport_law.h>
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

/// Rotates S by `turn`.
SggxMatrix rotate(const SggxMatrix& S, const Affine& turn) {
    const SymmetricEigen e = decompose(S);
    SymmetricEigen out = e;
    for (int i = 0; i < 3; ++i) out.axis[i] = normalize(turn.direction(e.axis[i]), e.axis[i]);
    return compose(out);
}

bool is_identity(const Affine& a) {
    return a.x == Affine{}.x && a.y == Affine{}.y && a.z == Affine{}.z;
}

/// A lobe that stopped a ray, and a direction drawn from it.
struct DrawnLobe {
    std::size_t lobe;
    bool fiber;   ///< `axis` is a tangent; else a normal on either side
    SggxMatrix S; ///< unpacked
    Vec3f axis;
};

/// Draws a lobe with probability proportional to its weight.
/// @param whole  sum of the weights in the range
/// @return       number of the lobe
std::size_t draw_lobe_number(const TraversalLevel& level,
                             TraversalLevel::LobeRange range,
                             int whole,
                             StreamRandom& random) {
    int at = static_cast<int>(random.uniform() * static_cast<float>(whole));
    std::size_t lobe = range.first;
    while (lobe + 1 < range.first + range.count && at >= level.lobe(lobe).weight) {
        at -= level.lobe(lobe++).weight;
    }
    return lobe;
}

/// Draws a lobe and a direction from it, by their areas projected along `from`, with rejection
/// sampling.
DrawnLobe draw_lobe(const TraversalLevel& level,
                    TraversalLevel::LobeRange range,
                    Vec3f from,
                    StreamRandom& random) {
    constexpr int kTries = 64; // for a needle seen end on; the last try is accepted
    int whole = 0;
    for (std::size_t i = 0; i < range.count; ++i) whole += level.lobe(range.first + i).weight;
    DrawnLobe drawn{std::numeric_limits<std::size_t>::max(), false, {}, {}};
    SggxFactor A{};
    for (int i = 0; i < kTries; ++i) {
        const std::size_t lobe = draw_lobe_number(level, range, whole, random);
        if (lobe != drawn.lobe) {
            drawn.lobe = lobe;
            drawn.S = unpack(level.lobe(lobe).sggx);
            A = factor(drawn.S);
            drawn.fiber =
                level.info().materials[level.lobe(lobe).material].kind == MaterialKind::Fiber;
        }
        drawn.axis = sample_ndf(A, random);
        const float c = dot(drawn.axis, from);
        const float seen = drawn.fiber ? std::sqrt(std::max(0.0f, 1.0f - c * c)) : std::fabs(c);
        if (random.uniform() < seen) break;
    }
    return drawn;
}

/// Multiplies a material by the means of its maps.
void apply_maps(const LobeMaps& maps, ScatterMaterial& material) {
    constexpr float kUnit = 1.0f / 255.0f;
    for (int a = 0; a < 3; ++a) {
        material.albedo[a] *= kUnit * static_cast<float>(maps.albedo[static_cast<std::size_t>(a)]);
    }
    material.roughness *= kUnit * static_cast<float>(maps.roughness);
    material.metalness *= kUnit * static_cast<float>(maps.metalness);
    material.anisotropy *= kUnit * static_cast<float>(maps.anisotropy);
}

/// Draws the direction of anisotropy perpendicular to `axis`; any direction if there is no lobe.
/// @param lobe  distribution of the tangents; may be null
Vec3f draw_tangent(const PackedSggx* lobe, Vec3f axis, StreamRandom& random) {
    const Vec3f any = any_perpendicular(axis);
    if (lobe == nullptr || !is_positive_definite(*lobe)) return any;
    const Vec3f t = sample_ndf(factor(unpack(*lobe)), random);
    return normalize(t - axis * dot(t, axis), any);
}

bool is_microflake(const ScatterMaterial& material) {
    return material.model == ScatterModel::MicroflakeSpecular ||
           material.model == ScatterModel::MicroflakeDiffuse;
}

/// Replaces the tangents of fibers by the normals around them, and draws one of these.
void draw_flake(Vec3f from, StreamRandom& random, Scatterer& out) {
    out.lobe = fit_sggx(moment_of_normals(second_moment_of(out.lobe)));
    out.axis = sample_vndf(factor(out.lobe), from, random);
    out.tangent = any_perpendicular(out.axis);
}

/// The level for the width of a ray at one point, and where that changes.
struct WantedLevel {
    int level;
    float end; ///< t at which the next level may begin
};

/// @param voxel_size  of the finest level
/// @param t, end      the level is found at t, and is needed until `end` at most
WantedLevel
find_wanted(const Ray& ray, const LevelChoice& choice, float voxel_size, float t, float end) {
    if (choice.forced >= 0) return {choice.forced, end};
    const float width = std::max(ray.width_at(t), 1e-30f);
    const float shift = choice.offset + choice.draw;
    const float fine = std::log2(width / voxel_size) + shift;
    int wanted = static_cast<int>(std::clamp(std::floor(fine), 0.0f, 62.0f));
    if (!(ray.spread > 0.0f)) return {wanted, end};
    const auto until = [&](int level) { // t at which the ray becomes too wide for `level`
        const float next = voxel_size * std::exp2(static_cast<float>(level) + 1.0f - shift);
        return (next - ray.width) / ray.spread;
    };
    if (until(wanted) <= t * 1.00001f) ++wanted; // t is the end of the last level, rounded
    return {wanted, std::min(end, std::max(until(wanted), t * 1.00001f))};
}

} // namespace

VolumeInstance::VolumeInstance(TraversalLevels pyramid,
                               const Affine& to_world,
                               std::vector<std::uint32_t> materials)
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

int VolumeInstance::usable_level(int level) const {
    const int last = static_cast<int>(pyramid_.size()) - 1;
    const int wanted = std::clamp(level, 0, last);
    for (int away = 0; away <= last; ++away) { // the coarser of two first
        for (const int l : {wanted + away, wanted - away}) {
            if (l >= 0 && l <= last && pyramid_[static_cast<std::size_t>(l)]) return l;
        }
    }
    return 0;
}

LastSheet VolumeInstance::start_sheet(const Ray& ray, Vec3d direction) const {
    const TraversalLevel& level = *pyramid_[static_cast<std::size_t>(ray.from_sheet.level)];
    const Vec3f edges = to_float(level.info().lattice.voxel_size);
    const detail::PlacedSheet sheet =
        detail::place_sheet(level.sheet(ray.from_sheet.voxel), edges, ray.sheet);
    const float slope = dot(sheet.normal, to_float(direction));
    return {sheet.normal, 0.0f, slope, 0.0f, sheet.thickness, ray.from_sheet.side};
}

template <typename Note>
void VolumeInstance::walk(const Ray& ray,
                          Transport transport,
                          const LevelChoice& choice,
                          RayPassage& passage,
                          const Note& note) const {
    if (object_bounds_.empty()) return; // the object has no voxels
    const Vec3d origin = to_object_.point(ray.origin);
    const Vec3d direction = to_object_.direction(to_double(ray.direction));
    const RayRange range = clip(origin, direction, ray.clear, ray.t_max, object_bounds_);
    const bool starts = ray.from_sheet.volume == this;
    if (starts) passage.last_sheet() = start_sheet(ray, direction);
    for (float t = range.t0; t < range.t1 && !passage.stopped();) {
        const WantedLevel wanted =
            find_wanted(ray, choice, static_cast<float>(voxel_size_), t, range.t1);
        const int number = usable_level(wanted.level);
        const TraversalLevel& level = *pyramid_[static_cast<std::size_t>(number)];
        const Vec3d h = level.info().lattice.voxel_size;
        const Vec3d per{1.0 / h.x, 1.0 / h.y, 1.0 / h.z};
        const VoxelRay voxel_ray{origin * per, direction * per};
        const RayRange inside =
            clip(origin, direction, t, wanted.end, level_bounds_[static_cast<std::size_t>(number)]);
        const std::int64_t start =
            starts && number == ray.from_sheet.level ? ray.from_sheet.voxel : -1;
        const LawArguments from{ray.from_fiber, ray.sheet, start, scale_};
        with_law(transport, level, voxel_ray, from, passage, [&](auto law) {
            traverse_voxels(level, voxel_ray, inside.t0, inside.t1, [&](const VoxelStep& step) {
                if (law.pass(step)) return true;
                note(number, step);
                return false;
            });
        });
        t = wanted.end;
    }
}

bool VolumeInstance::sample_flight(const Ray& ray,
                                   Transport transport,
                                   const LevelChoice& choice,
                                   StreamRandom& random,
                                   VolumeHit& hit) const {
    RayPassage passage(true, random);
    walk(ray, transport, choice, passage, [&](int level, const VoxelStep& step) {
        hit = {passage.t(), level, &step.leaf, step.voxel, passage.side()};
    });
    return passage.stopped();
}

float VolumeInstance::transmittance(const Ray& ray,
                                    Transport transport,
                                    const LevelChoice& choice,
                                    StreamRandom& random) const {
    RayPassage passage(false, random);
    walk(ray, transport, choice, passage, [](int, const VoxelStep&) {});
    return passage.transmittance();
}

VolumeScatter VolumeInstance::scatter(const VolumeHit& hit,
                                      Vec3f wi,
                                      std::span<const ScatterMaterial> materials,
                                      StreamRandom& random) const {
    const TraversalLevel& level = *pyramid_[static_cast<std::size_t>(hit.level)];
    const Vec3f from = rotated_ ? to_float(normalize(to_object_.direction(to_double(wi)))) : wi;
    const DrawnLobe lobe = draw_lobe(level, level.lobes_of(*hit.leaf, hit.voxel), from, random);
    const std::uint32_t material = level.lobe(lobe.lobe).material;

    VolumeScatter drawn;
    drawn.material = materials_[material];
    drawn.fiber = lobe.fiber;
    if (drawn.fiber) drawn.radius = level.info().materials[material].fiber_radius * scale_;
    drawn.edge = static_cast<float>(std::ldexp(voxel_size_, hit.level));
    Scatterer& out = drawn.scatterer;
    out.material = materials[drawn.material];
    if (const LobeMaps* maps = level.maps(lobe.lobe)) apply_maps(*maps, out.material);
    out.lobe = lobe.S;
    const bool behind = !lobe.fiber && dot(lobe.axis, from) < 0.0f; // normals are on either side
    out.axis = behind ? lobe.axis * -1.0f : lobe.axis;
    out.tangent = draw_tangent(level.tangent(lobe.lobe), out.axis, random);
    const bool flakes = is_microflake(out.material);
    if (flakes && lobe.fiber) draw_flake(from, random, out);
    if (rotated_) turn_to_world(!lobe.fiber || flakes, out);
    return drawn;
}

void VolumeInstance::turn_to_world(bool normal, Scatterer& out) const {
    const auto turn = [&](Vec3f d, bool as_normal) {
        const Vec3d v = to_double(d);
        const Vec3d w =
            as_normal ? Vec3d{dot(to_object_.x, v), dot(to_object_.y, v), dot(to_object_.z, v)}
                      : to_world_.direction(v);
        return to_float(normalize(w));
    };
    out.axis = turn(out.axis, normal);
    const Vec3f tangent = turn(out.tangent, false);
    out.tangent =
        normalize(tangent - out.axis * dot(tangent, out.axis), any_perpendicular(out.axis));
    if (is_microflake(out.material)) out.lobe = rotate(out.lobe, to_world_);
}

} // namespace heddle
