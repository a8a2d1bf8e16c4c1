#pragma once

#include <heddle/render/camera.h>
#include <heddle/render/flake_grid.h>
#include <heddle/render/light.h>
#include <heddle/render/path_sampler.h>
#include <heddle/render/surface_scene.h>
#include <heddle/render/volume/transport.h>
#include <heddle/render/volume/volume_instance.h>
#include <heddle/scatter/scatterer.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace heddle {

/// All that light paths traverse, in world space. Does not change while a picture is rendered.
struct PathScene {
    std::vector<VolumeInstance> volumes;
    std::vector<FlakeMedium> flakes;              ///< beside the volumes
    std::shared_ptr<const SurfaceScene> surfaces; ///< may be null
    std::vector<ScatterMaterial> materials;
    LightSet lights{{}, 1.0};
};

/// How light paths are traced.
struct PathOptions {
    int max_depth = 64;        ///< most scattering events; 0: only unscattered light
    int roulette_depth = 5;    ///< events before Russian roulette
    int level = -1;            ///< of detail for all rays; -1: by the footprint of each ray
    float level_offset = 0.0f; ///< added to the level that the footprint gives
    Transport transport = Transport::Automatic;
    bool with_transmittance = true; ///< computes PathSample::transmittance
};

/// The first scatterer of a camera ray.
struct FirstHit {
    bool any = false;
    float depth = 0.0f; ///< scene units
    Vec3f axis{};       ///< tangent or normal
    Vec3f albedo{};
    float level = 0.0f;         ///< of detail; 0 for surfaces
    std::uint32_t material = 0; ///< index into PathScene::materials
};

/// The result of one path.
struct PathSample {
    Vec3f radiance{};
    float transmittance = 1.0f; ///< of the whole camera ray, through all objects
    FirstHit first;
};

/// Traces a path from the camera: next-event estimation and scattering, combined by the power
/// heuristic [Veach 1997]; Russian roulette by throughput.
[[nodiscard]] PathSample
trace_path(const PathScene& scene, const PathOptions& options, Ray ray, PathSampler& sampler);

} // namespace heddle
