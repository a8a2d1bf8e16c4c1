#pragma once

#include <heddle/base/vec.h>

#include <cmath>

namespace heddle {

/// Absorption of a hair by its pigments, per fiber radius:
/// eumelanin (.419, .697, 1.37) + pheomelanin (.187, .4, 1.05)    [d'Eon11, "An energy-conserving
/// hair reflectance model", 6]
/// @param eumelanin    concentration, >= 0: about 8 is black, 1.3 brown, .3 blond
/// @param pheomelanin  concentration, >= 0: red
[[nodiscard]] inline Vec3f absorption_from_melanin(float eumelanin, float pheomelanin) {
    return Vec3f{0.419f, 0.697f, 1.37f} * eumelanin + Vec3f{0.187f, 0.4f, 1.05f} * pheomelanin;
}

/// Absorption that makes a full head of hair look about this colour:
/// (ln c / (5.969 - .215 b + 2.532 b^2 - 10.73 b^3 + 5.574 b^4 + .245 b^5))^2   [Chiang16, eq. 9]
/// @param color    linear RGB, in (0, 1]
/// @param width_n  b: azimuthal roughness, in [0, 1]
[[nodiscard]] inline Vec3f absorption_from_color(Vec3f color, float width_n) {
    const float b = width_n;
    const float scale =
        5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + b * 0.245f))));
    Vec3f absorption;
    for (int i = 0; i < 3; ++i) {
        const float x = std::log(color[i]) / scale;
        absorption[i] = x * x;
    }
    return absorption;
}

} // namespace heddle
