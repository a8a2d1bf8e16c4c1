#include <heddle/render/path.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace heddle {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float largest(Vec3f c) {
    return std::max({c.x, c.y, c.z});
}

/// Weight of a technique of density p beside one of density q.      [Veach 1997, power heuristic]
float power_share(float p, float q) {
    if (!(p > 0.0f)) return 0.0f;
    const float r = q / p;
    return 1.0f / (1.0f + r * r);
}

/// The next scattering event of a path.
struct Event {
    float t = kInfinity;
    Scatterer scatterer;
    std::uint32_t material = 0;
    float level = 0.0f;
    Vec3f normal{}; ///< geometric; zero in a volume
    float offset = 0.0f;
    bool fiber = false; ///< in a volume, as VolumeScatter
    float radius = 0.0f;
    float edge = 0.0f;
    SheetStart sheet{}; ///< in a volume: the sheet that was met
};

class PathTracer {
public:
    PathTracer(const PathScene& scene, const PathOptions& options, PathSampler& sampler)
        : scene_(scene), options_(options), sampler_(sampler) {
        choice_ = {options.level, options.level_offset, sampler.stream().uniform()};
        sheet_ = to_unit_float(hash64(std::bit_cast<std::uint32_t>(choice_.draw), 0));
    }

    PathSample trace(Ray ray) {
        PathSample out;
        ray.sheet = sheet_;
        if (options_.with_transmittance) out.transmittance = transmittance(ray);
        Vec3f throughput{1, 1, 1};
        float scatter_pdf = 0.0f; // of the ray's direction; 0: from the camera
        for (int depth = 0;; ++depth) {
            Event event;
            const bool scatters = next_event(ray, event);
            if (LightHit hit; meets_light(ray, event.t, scatters, hit)) {
                const float share = depth == 0 ? 1.0f : power_share(scatter_pdf, hit.pdf);
                out.radiance = out.radiance + throughput * hit.radiance * share;
                if (hit.t < event.t || !scatters) break;
            }
            if (!scatters) break;
            if (depth == 0) note_first(event, out.first);
            if (depth >= options_.max_depth) break;
            const Vec3d at = ray.at(static_cast<double>(event.t));
            const float width = ray.width_at(event.t);
            const Vec3f wi = ray.direction * -1.0f;
            out.radiance = out.radiance + throughput * direct_light(event, at, wi, width);
            const ScatterSample next = sample(event.scatterer, wi, sampler_.three());
            if (!(next.pdf > 0.0f)) break;
            throughput = throughput * next.weight;
            if (!survives(throughput, depth)) break;
            scatter_pdf = next.pdf;
            ray =
                leave(event, at, wi, next.direction, width, spread_of(next.roughness, ray.spread));
        }
        return out;
    }

private:
    /// Footprints of diffusely scattered rays widen by this per unit of distance: a tenth of a
    /// hemisphere's width, so that rays still meet fine voxels nearby.
    static constexpr float kDiffuseSpread = 0.2f;
    [[nodiscard]] static float spread_of(float roughness, float spread) {
        return std::max(spread, kDiffuseSpread * roughness);
    }

    [[nodiscard]] bool next_event(const Ray& ray, Event& event) {
        bool found = false;
        Ray open = ray;
        if (TracedHit hit; scene_.surfaces && scene_.surfaces->intersect(ray, hit)) {
            event = {hit.t, hit.scatterer, hit.material, 0.0f, hit.normal, hit.offset, false, 0.0f};
            open.t_max = hit.t;
            found = true;
        }
        const VolumeInstance* stopped_in = nullptr;
        VolumeHit nearest;
        for (const VolumeInstance& volume : scene_.volumes) {
            VolumeHit hit;
            if (!volume.sample_flight(open, options_.transport, choice_, sampler_.stream(), hit))
                continue;
            open.t_max = hit.t;
            nearest = hit;
            stopped_in = &volume;
        }
        const FlakeMedium* stopped_by = nullptr;
        FlakeHit flake;
        for (const FlakeMedium& medium : scene_.flakes) {
            if (!medium.sample_flight(open, sampler_.stream(), flake)) continue;
            open.t_max = flake.t;
            stopped_by = &medium;
        }
        if (stopped_by != nullptr) {
            event = {flake.t, stopped_by->scatterer(flake, ray.direction * -1.0f),
                     stopped_by->material()};
            return true;
        }
        if (stopped_in == nullptr) return found;
        event.t = nearest.t;
        const VolumeScatter drawn = stopped_in->scatter(nearest, ray.direction * -1.0f,
                                                        scene_.materials, sampler_.stream());
        event.scatterer = drawn.scatterer;
        event.material = drawn.material;
        event.fiber = drawn.fiber;
        event.radius = drawn.radius;
        event.edge = drawn.edge;
        event.level = static_cast<float>(nearest.level);
        event.normal = {};
        event.offset = 0.0f;
        if (nearest.side != 0) {
            event.sheet = {stopped_in, nearest.level, nearest.voxel, nearest.side};
        }
        return true;
    }

    /// An area light in front of the event, or the background behind everything.
    [[nodiscard]] bool meets_light(const Ray& ray, float t, bool scatters, LightHit& hit) const {
        Ray until = ray;
        until.t_max = std::min(ray.t_max, t);
        if (scene_.lights.intersect(until, hit)) return true;
        if (scatters) return false;
        hit = scene_.lights.background(ray.direction);
        return largest(hit.radiance) > 0.0f;
    }

    /// Returns Ray::clear of a ray that starts on a surface in a volume, which prevents
    /// self-shadowing: voxels do not know where in them the surface is.
    [[nodiscard]] static float clear_of(const Event& event, Vec3f direction) {
        constexpr float kMinCosine = 0.25f;
        if (event.fiber) return 0.0f;
        if (event.sheet.volume != nullptr) return 0.0f; // rays know where it is
        const float cosine = std::fabs(dot(direction, event.scatterer.axis));
        return event.edge / std::max(cosine, kMinCosine);
    }

    [[nodiscard]] static FiberStart start_of(const Event& event, Vec3f wi, Vec3f direction) {
        if (!event.fiber) return {};
        return {event.radius, dot(wi, direction), event.t};
    }

    /// Returns a ray that starts at an event, offset from its surface.
    [[nodiscard]] Ray leave(
        const Event& event, Vec3d at, Vec3f wi, Vec3f direction, float width, float spread) const {
        SheetStart start = event.sheet;
        if (dot(direction, event.scatterer.axis) < 0.0f) start.side = -start.side;
        const float side = dot(direction, event.normal) < 0.0f ? -event.offset : event.offset;
        return {at + to_double(event.normal * side),
                direction,
                kInfinity,
                width,
                spread,
                clear_of(event, direction),
                start_of(event, wi, direction),
                sheet_,
                start};
    }

    [[nodiscard]] Vec3f direct_light(const Event& event, Vec3d at, Vec3f wi, float width) {
        const LightSample light = scene_.lights.sample(at, sampler_.three());
        if (!(largest(light.radiance) > 0.0f)) return {};
        const ScatterValue phase = evaluate_with_pdf(event.scatterer, wi, light.direction);
        const Vec3f scattered = phase.value * light.radiance;
        if (!(largest(scattered) > 0.0f)) return {};
        const float share = light.pdf > 0.0f ? power_share(light.pdf, phase.pdf) : 1.0f;
        Ray shadow = leave(event, at, wi, light.direction, width, spread_of(1.0f, 0.0f));
        shadow.t_max = light.distance < kInfinity ? light.distance * 0.9999f : kInfinity;
        LightHit nearer; // area lights end paths that hit them, so they occlude other lights too
        if (scene_.lights.intersect(shadow, nearer)) return {};
        return scattered * (share * transmittance(shadow));
    }

    [[nodiscard]] float transmittance(const Ray& ray) {
        if (scene_.surfaces && scene_.surfaces->occluded(ray)) return 0.0f;
        float passes = 1.0f;
        for (const VolumeInstance& volume : scene_.volumes) {
            passes *= volume.transmittance(ray, options_.transport, choice_, sampler_.stream());
            if (passes == 0.0f) break;
        }
        for (const FlakeMedium& medium : scene_.flakes) {
            if (passes == 0.0f) break;
            passes *= medium.transmittance(ray, sampler_.stream());
        }
        return passes;
    }

    [[nodiscard]] bool survives(Vec3f& throughput, int depth) {
        const float most = largest(throughput);
        if (!(most > 0.0f) || !std::isfinite(most)) return false;
        if (depth + 1 < options_.roulette_depth) return true;
        const float keep = std::min(0.95f, most);
        if (sampler_.stream().uniform() >= keep) return false;
        throughput = throughput * (1.0f / keep);
        return true;
    }

    static void note_first(const Event& event, FirstHit& first) {
        first = {true,        event.t,       event.scatterer.axis, event.scatterer.material.albedo,
                 event.level, event.material};
    }

    const PathScene& scene_;
    const PathOptions& options_;
    PathSampler& sampler_;
    LevelChoice choice_;
    float sheet_ = 0.5f; ///< Ray::sheet of all rays
};

} // namespace

PathSample
trace_path(const PathScene& scene, const PathOptions& options, Ray ray, PathSampler& sampler) {
    return PathTracer(scene, options, sampler).trace(ray);
}

} // namespace heddle
