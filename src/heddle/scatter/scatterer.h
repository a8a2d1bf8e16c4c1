#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/sggx.h>

#include <cstdint>

namespace heddle {

/// The scattering models. docs/scatter.md has their formulas.
enum class ScatterModel : std::uint8_t {
    MicroflakeSpecular, ///< mirrors whose normals an SGGX distributes          [Heitz15, 3.3]
    MicroflakeDiffuse,  ///< Lambertian flakes; `axis` is the normal that was hit  [Heitz15, 3.4]
    LambertFiber,       ///< a round Lambertian fiber seen from afar; `axis` is its tangent
    LobeFiber,          ///< R and TT lobes of a fiber                    [Khungurn15]
    Hair,               ///< R, TT and TRT of an absorbing dielectric cylinder
    Surface             ///< diffuse and anisotropic GGX in a frame, mixed as in glTF 2.0
};

/// The constants of a material for scattering. A model ignores those of other models.
struct ScatterMaterial {
    ScatterModel model = ScatterModel::Surface;
    Vec3f albedo{0.8f, 0.8f, 0.8f}; ///< linear, in [0, 1]; of microflakes, fibers and surfaces
    // surface
    float roughness = 0.5f;  ///< glTF: alpha = roughness^2; in [0, 1]
    float metalness = 0.0f;  ///< in [0, 1]
    float anisotropy = 0.0f; ///< strength in [0, 1]        [KHR_materials_anisotropy]
    float specular = 1.0f;   ///< multiplies the dielectric's F0 of 0.04; 0: only diffuse
    // lobe fiber: energies and widths of the lobes. From a row of [Khungurn15, table 1]:
    // color_r = R, color_tt = (1 - R) TT, widths in radians, tilt 0 (docs/scatter.md)
    Vec3f color_r{0.1f, 0.1f, 0.1f};
    Vec3f color_tt{0.6f, 0.6f, 0.6f};
    float width_r = 0.1f;    ///< deviation of theta_o about -theta_i, radians
    float width_tt = 0.3f;   ///< the same for TT
    float azimuth_tt = 0.5f; ///< azimuthal width of TT, radians
    // hair
    Vec3f absorption{0.2f, 0.4f, 0.8f}; ///< sigma_a per fiber radius
    float width_m = 0.3f;               ///< longitudinal roughness in [0, 1]      [Chiang16]
    float width_n = 0.3f;               ///< azimuthal roughness in [0, 1]
    float eta = 1.55f;
    // fibers and hair
    float tilt = 0.035f; ///< of the cuticle's scales, radians: R leans towards -axis by twice this
};

/// The fiber, surface or microflake at which a path scatters: the same for the lobe direction that
/// was drawn in a voxel and for the point where traced geometry was hit. World axes.
struct Scatterer {
    ScatterMaterial material; ///< constants, maps multiplied in
    /// Unit: the tangent of a fiber, towards its tip; the normal of a surface on the viewer's side.
    Vec3f axis{0, 0, 1};
    /// Unit, perpendicular to `axis`: the direction in which an anisotropic surface is rougher;
    /// highlights stretch along it.
    Vec3f tangent{1, 0, 0};
    SggxMatrix lobe; ///< distribution of normals: for microflakes only
};

/// A direction that was drawn from a scatterer.
struct ScatterSample {
    Vec3f direction;        ///< unit, away from the scatterer
    Vec3f weight;           ///< evaluate / pdf; zero: absorbed
    float pdf = 0.0f;       ///< per steradian
    float roughness = 1.0f; ///< 0 mirror to 1 diffuse: how much a ray's footprint widens
};

/// Light scattered from the side of `wo` towards `wi`, per steradian of `wo`: the BSDF of a surface
/// times its cosine, a fiber's or flake's phase function. Its integral over all `wo` is the albedo.
/// @param wi  unit, away from the scatterer, towards the previous vertex of the path
/// @param wo  unit, away from the scatterer
/// @return    >= 0, finite; 1 / sr
[[nodiscard]] Vec3f evaluate(const Scatterer& at, Vec3f wi, Vec3f wo);

/// The density with which `sample` draws `wo`, per steradian.
[[nodiscard]] float pdf(const Scatterer& at, Vec3f wi, Vec3f wo);

/// The results of `evaluate` and `pdf` for one pair of directions.
struct ScatterValue {
    Vec3f value;      ///< as of `evaluate`
    float pdf = 0.0f; ///< as of `pdf`
};

/// Both at once, for the cost of one: for sampling lights.
[[nodiscard]] ScatterValue evaluate_with_pdf(const Scatterer& at, Vec3f wi, Vec3f wo);

/// Draws a direction.
/// @param u  three uniform numbers in [0, 1)
/// @return   `roughness` is 1 / sqrt(pi pdf), at most 1: the radius of a disc with this density,
///           for every model; weight and pdf are 0 if the draw was absorbed
[[nodiscard]] ScatterSample sample(const Scatterer& at, Vec3f wi, Vec3f u);

} // namespace heddle
