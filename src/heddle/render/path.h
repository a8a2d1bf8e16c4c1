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

/// All that paths run through, in the world. Never changes while a picture is made.
struct PathScene {
    std::vector<VolumeInstance> volumes;
    std::vector<FlakeMedium> flakes;              ///< beside the volumes
    std::shared_ptr<const SurfaceScene> surfaces; ///< may be null
    std::vector<ScatterMaterial> materials;
    LightSet lights{{}, 1.0};
};

struct PathOptions {
    int max_depth = 64;        ///< scattering events; 0: light that nothing scattered
    int roulette_depth = 5;    ///< events before Russian roulette
    int level = -1;            ///< of detail everywhere; -1: by footprint
    float level_offset = 0.0f; ///< added to the level that a footprint asks for
    Transport transport = Transport::Automatic;
    bool with_transmittance = true; ///< of volumes, exact along each camera ray
};

/// What a camera ray met first.
struct FirstHit {
    bool any = false;
    float depth = 0.0f; ///< scene units
    Vec3f axis{};       ///< tangent or normal
    Vec3f albedo{};
    float level = 0.0f;         ///< of detail; 0 for surfaces
    std::uint32_t material = 0; ///< of PathScene::materials
};

/// One path.
struct PathSample {
    Vec3f radiance{};
    float transmittance = 1.0f; ///< of the camera ray, through everything
    FirstHit first;
};

/// Follows light backwards from a camera ray: next-event estimation and scattering, weighed against
/// each other by the power heuristic [Veach 1997]; Russian roulette by throughput.
[[nodiscard]] PathSample
trace_path(const PathScene& scene, const PathOptions& options, Ray ray, PathSampler& sampler);

} // namespace heddle
