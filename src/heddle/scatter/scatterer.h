#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/sggx.h>

#include <cstdint>

namespace heddle {

/// How light scatters at one place. docs/scatter.md has the formulas of each.
enum class ScatterModel : std::uint8_t {
    MicroflakeSpecular, ///< mirrors whose normals an SGGX distributes          [Heitz15, 3.3]
    MicroflakeDiffuse,  ///< Lambertian flakes of such normals; `axis` is the one met [Heitz15, 3.4]
    LambertFiber,       ///< a round Lambertian fiber seen from afar; `axis` is its tangent
    LobeFiber,          ///< R and TT lobes of a fiber                    [Khungurn15]
    Hair,               ///< R, TT, TRT of a dielectric cylinder that absorbs
    Surface             ///< diffuse and anisotropic GGX about a frame, as glTF 2.0 mixes them
};

/// A material's constants for scattering. What a model does not name it ignores.
struct ScatterMaterial {
    ScatterModel model = ScatterModel::Surface;
    Vec3f albedo{0.8f, 0.8f, 0.8f}; ///< linear, in [0, 1]; microflakes', fiber's, surface's
    // surface
    float roughness = 0.5f;  ///< glTF: alpha = roughness^2; in [0, 1]
    float metalness = 0.0f;  ///< in [0, 1]
    float anisotropy = 0.0f; ///< strength in [0, 1]        [KHR_materials_anisotropy]
    float specular = 1.0f;   ///< multiplies the dielectric's F0 of .04; 0: diffuse alone
    // lobe fiber: energies of the lobes and their widths. Of a row of [Khungurn15, table 1]:
    // color_r = R, color_tt = (1 - R) TT, widths in radians, tilt 0 (docs/scatter.md)
    Vec3f color_r{0.1f, 0.1f, 0.1f};
    Vec3f color_tt{0.6f, 0.6f, 0.6f};
    float width_r = 0.1f;    ///< of theta_o about -theta_i, radians
    float width_tt = 0.3f;   ///< the same of TT
    float azimuth_tt = 0.5f; ///< azimuthal width of TT, radians
    // hair
    Vec3f absorption{0.2f, 0.4f, 0.8f}; ///< sigma_a per fiber radius
    float width_m = 0.3f;               ///< longitudinal roughness in [0, 1]      [Chiang16]
    float width_n = 0.3f;               ///< azimuthal roughness in [0, 1]
    float eta = 1.55f;
    // fibers and hair
    float tilt = 0.035f; ///< of the cuticle's scales, radians: R leans to -axis by twice this
};

/// What stands at a place where a path scatters: the same thing for a voxel's drawn lobe direction
/// and for the point where traced geometry was hit. World axes.
struct Scatterer {
    ScatterMaterial material; ///< constants, maps multiplied in
    /// Unit: tangent of a fiber, to its tip; normal of a surface on the viewer's side.
    Vec3f axis{0, 0, 1};
    /// Unit, at right angles to `axis`: where an anisotropic surface is rougher; highlights stretch
    /// along it.
    Vec3f tangent{1, 0, 0};
    SggxMatrix lobe; ///< of normals: microflakes alone
};

/// A direction drawn from a scatterer.
struct ScatterSample {
    Vec3f direction;        ///< unit, away from the scatterer
    Vec3f weight;           ///< evaluate / pdf; zero: absorbed
    float pdf = 0.0f;       ///< per steradian
    float roughness = 1.0f; ///< 0 mirror to 1 diffuse: how much a ray's footprint widens
};

/// Light scattered from `wo`'s side towards `wi`, per steradian of `wo`: a surface's BSDF times its
/// cosine, a fiber's or flake's phase function. Its integral over all `wo` is what is not absorbed.
/// @param wi  unit, away from the scatterer, towards where the path came from
/// @param wo  unit, away from the scatterer
/// @return    >= 0, finite; 1 / sr
[[nodiscard]] Vec3f evaluate(const Scatterer& at, Vec3f wi, Vec3f wo);

/// Density with which `sample` draws `wo`, per steradian.
[[nodiscard]] float pdf(const Scatterer& at, Vec3f wi, Vec3f wo);

/// What `evaluate` and `pdf` say of one pair of directions.
struct ScatterValue {
    Vec3f value;      ///< of `evaluate`
    float pdf = 0.0f; ///< of `pdf`
};

/// Both at once, for the price of one: what a light's sample needs.
[[nodiscard]] ScatterValue evaluate_with_pdf(const Scatterer& at, Vec3f wi, Vec3f wo);

/// Draws a direction.
/// @param u  three uniform numbers in [0, 1)
/// @return   `roughness` is 1 / sqrt(pi pdf), at most 1: the radius of a disc with that
///           density, for every model; weight and pdf are 0 where the draw was absorbed
[[nodiscard]] ScatterSample sample(const Scatterer& at, Vec3f wi, Vec3f u);

} // namespace heddle
