#pragma once

#include <heddle/base/platform.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/packed.h>
#include <heddle/sggx/sggx.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace heddle {

/// The correlation r of a byte is the cosine of its angle: 254 steps from r = -1 to 1.
inline constexpr std::int32_t kAngleSteps = 254;

namespace detail {

/// cos of 0 .. pi / 4 to the rounding of a double.
[[nodiscard]] constexpr double cosine_series(double x) {
    double term = 1.0;
    double sum = 1.0;
    for (int k = 1; k < 12; ++k) {
        term *= -x * x / ((2.0 * k - 1.0) * (2.0 * k));
        sum += term;
    }
    return sum;
}

[[nodiscard]] constexpr double sine_series(double x) {
    double term = x;
    double sum = x;
    for (int k = 1; k < 12; ++k) {
        term *= -x * x / ((2.0 * k) * (2.0 * k + 1.0));
        sum += term;
    }
    return sum;
}

/// cos(pi k / kAngleSteps), k = 0 .. kAngleSteps; 1, 0 and -1 exactly, and odd about the middle.
[[nodiscard]] constexpr std::array<float, kAngleSteps + 1> make_cosines() {
    std::array<float, kAngleSteps + 1> table{};
    constexpr double kStep = 3.141592653589793 / kAngleSteps;
    for (int k = 0; 2 * k <= kAngleSteps; ++k) {
        const double x = kStep * k;
        const double y = kStep * (kAngleSteps / 2 - k);
        const auto c = static_cast<float>(4 * k <= kAngleSteps ? cosine_series(x) : sine_series(y));
        table[static_cast<std::size_t>(k)] = c;
        table[static_cast<std::size_t>(kAngleSteps - k)] = -c;
    }
    return table;
}

/// The correlation of an angle of k steps.
[[nodiscard]] HEDDLE_HD inline float cosine_of(std::int32_t k) {
    static constexpr std::array<float, kAngleSteps + 1> kCosine = make_cosines();
    return kCosine[static_cast<std::size_t>(k)];
}

/// The angle of a correlation byte, in steps: the larger the byte, the larger r.
[[nodiscard]] HEDDLE_HD constexpr std::int32_t angle_of(std::int32_t byte) {
    return kAngleSteps - byte;
}

/// The largest k in 1 .. kAngleSteps - 2 with cosine_of(k) >= r: k and k + 1 enclose r.
[[nodiscard]] HEDDLE_HD inline std::int32_t floor_angle(float r) {
    const float x = r < 0.0f ? -r : r;
    // acos to 7e-5 [Abramowitz and Stegun 4.4.45], 0.006 of a step
    const float root = std::sqrt(x < 1.0f ? 1.0f - x : 0.0f);
    const float angle = root * (1.5707288f + x * (-0.2121144f + x * (0.0742610f - 0.0187293f * x)));
    const float steps = angle * (static_cast<float>(kAngleSteps) * 0.31830987f);
    const float at = r < 0.0f ? static_cast<float>(kAngleSteps) - steps : steps;
    std::int32_t k = at > 1.0f ? static_cast<std::int32_t>(at) : 1; // NaN gives 1
    k = k < kAngleSteps - 2 ? k : kAngleSteps - 2;
    if (k > 1 && cosine_of(k) < r) --k;
    if (k < kAngleSteps - 2 && cosine_of(k + 1) >= r) ++k;
    return k;
}

/// True if the correlations of three angles, in steps, are those of a positive definite matrix: the
/// angles are those between three vectors that are not in one plane.
[[nodiscard]] HEDDLE_HD constexpr bool
is_definite(std::int32_t xy, std::int32_t xz, std::int32_t yz) {
    return xy < xz + yz && xz < xy + yz && yz < xy + xz && xy + xz + yz < 2 * kAngleSteps;
}

/// Two neighbouring angles and their squared errors in S.
struct AnglePair {
    std::int32_t lower;
    float error[2];
};

/// @param product  product of the two sigmas: weights the error
/// @param shift    0: the angles around r; -1: one step lower
[[nodiscard]] HEDDLE_HD inline AnglePair angle_pair(float r, float product, std::int32_t shift) {
    const std::int32_t k = floor_angle(r) + shift;
    AnglePair p{k > 1 ? k : 1, {}};
    for (int i = 0; i < 2; ++i) {
        const float e = product * (r - cosine_of(p.lower + i));
        p.error[i] = e * e;
    }
    return p;
}

/// Of the 8 choices of neighbouring angles, stores the definite one with least squared error in S.
///
/// @return  false if none is definite
[[nodiscard]] HEDDLE_HD inline bool
store_angles(Vec3f r, Vec3f product, std::int32_t shift, PackedSggx& out) {
    const AnglePair x = angle_pair(r.x, product.x, shift);
    const AnglePair y = angle_pair(r.y, product.y, shift);
    const AnglePair z = angle_pair(r.z, product.z, shift);
    bool found = false;
    float least = 0.0f;
    for (int choice = 0; choice < 8; ++choice) {
        const int i = choice & 1;
        const int j = choice >> 1 & 1;
        const int k = choice >> 2;
        const float error = x.error[i] + y.error[j] + z.error[k];
        if (found && !(error < least)) continue;
        if (!is_definite(x.lower + i, y.lower + j, z.lower + k)) continue;
        found = true;
        least = error;
        out.r[0] = static_cast<std::uint8_t>(angle_of(x.lower + i));
        out.r[1] = static_cast<std::uint8_t>(angle_of(y.lower + j));
        out.r[2] = static_cast<std::uint8_t>(angle_of(z.lower + k));
    }
    return found;
}

/// The same with the angles around r, or one step lower if r is at a singular corner of the lattice
/// of angles. False only if S was not semi-definite.
[[nodiscard]] HEDDLE_HD inline bool store_correlations(Vec3f r, Vec3f product, PackedSggx& out) {
    return store_angles(r, product, 0, out) || store_angles(r, product, -1, out);
}

/// Returns sqrt(x) of a diagonal entry and sets the byte that stores it: 1 to 255; NaN gives 1.
[[nodiscard]] HEDDLE_HD inline float pack_sigma(float square, std::uint8_t& byte) {
    const float sigma = std::sqrt(square > 0.0f ? square : 0.0f);
    const float x = 255.0f * sigma + 0.5f;
    byte = static_cast<std::uint8_t>(x >= 1.0f ? (x < 255.0f ? x : 255.0f) : 1.0f);
    return sigma;
}

[[nodiscard]] HEDDLE_HD constexpr float correlation(float covariance, float sigmas) {
    return sigmas > 0.0f ? covariance / sigmas : 0.0f;
}

} // namespace detail

/// True if `p` decodes to a positive definite matrix; exact, for any 6 bytes.
///
/// S = D C D with D = diag(sigma) and C the correlations: no sigma is 0, and the angles of C are
/// those of a triangle on the sphere.
[[nodiscard]] HEDDLE_HD constexpr bool is_positive_definite(const PackedSggx& p) {
    for (int i = 0; i < 3; ++i) {
        if (p.sigma[i] == 0 || p.r[i] > kAngleSteps) return false;
    }
    return detail::is_definite(detail::angle_of(p.r[0]), detail::angle_of(p.r[1]),
                               detail::angle_of(p.r[2]));
}

/// Packs S into 6 bytes that decode to a positive definite matrix, whatever S is.
///
/// sigma_x = sqrt(S_xx), r_xy = S_xy / (sigma_x sigma_y)                      [Fabre26, eq. 17]
/// sigma is rounded to the nearest byte, at least 1. A byte of r is an angle, r = -cos(pi byte /
/// 254). The bytes of the paper are linear in r and end at 253/255, which widens a diagonal needle
/// to 0.05 and changes its moment by 0.015; these are 150 times finer there. Of the 8 choices of
/// neighbouring angles the definite one nearest to S is taken; a semi-definite S has one.
///
/// @param S  positive semi-definite, diagonal in [0, 1]; anything else is clamped
[[nodiscard]] HEDDLE_HD inline PackedSggx pack(const SggxMatrix& S) {
    PackedSggx p;
    const float x = detail::pack_sigma(S.xx, p.sigma[0]);
    const float y = detail::pack_sigma(S.yy, p.sigma[1]);
    const float z = detail::pack_sigma(S.zz, p.sigma[2]);
    const Vec3f product{x * y, x * z, y * z};
    const Vec3f r{detail::correlation(S.xy, product.x), detail::correlation(S.xz, product.y),
                  detail::correlation(S.yz, product.z)};
    if (!detail::store_correlations(r, product, p)) {
        for (std::uint8_t& byte : p.r) byte = kAngleSteps / 2; // no correlation
    }
    return p;
}

/// The matrix that 6 bytes encode.
///
/// Rounding changes its scale: the distribution integrates to 1 within 1 %. Untrusted bytes may
/// decode to any matrix: check is_positive_definite first.
[[nodiscard]] HEDDLE_HD inline SggxMatrix unpack(const PackedSggx& p) {
    const std::int32_t x = p.sigma[0];
    const std::int32_t y = p.sigma[1];
    const std::int32_t z = p.sigma[2];
    const auto square = [](std::int32_t s) { return static_cast<float>(s * s) / 65025.0f; };
    const auto product = [](std::int32_t ss, std::uint8_t byte) {
        const std::int32_t angle = detail::angle_of(byte);
        return static_cast<float>(ss) * detail::cosine_of(angle > 0 ? angle : 0) / 65025.0f;
    };
    return {square(x),
            square(y),
            square(z),
            product(x * y, p.r[0]),
            product(x * z, p.r[1]),
            product(y * z, p.r[2])};
}

} // namespace heddle
