#pragma once

// Random lobes and direction sets for this room's tests and tables.

#include <heddle/base/random.h>
#include <heddle/base/vec.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/sggx.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heddle::test {

/// Uniform in [0, 1).
inline double uniform(CounterRandom& random) {
    return random.uniform();
}

/// A random direction, uniform on the sphere.
inline Vec3d random_direction(CounterRandom& random) {
    for (;;) {
        const Vec3f p{2.0f * random.uniform() - 1.0f, 2.0f * random.uniform() - 1.0f,
                      2.0f * random.uniform() - 1.0f};
        if (dot(p, p) < 1.0f && dot(p, p) > 1e-4f) return normalize(to_double(p));
    }
}

/// The matrix with these eigenvalues on random axes.
inline SymmetricMatrix rotate(Vec3d value, CounterRandom& random) {
    const Vec3d x = random_direction(random);
    const Vec3d y = normalize(cross(x, random_direction(random)));
    return compose({{value.x, value.y, value.z}, {x, y, cross(x, y)}});
}

/// The normalized SGGX with these ratios of sigma, on random axes.
inline SggxMatrix random_sggx(Vec3d sigma, CounterRandom& random) {
    const Vec3d square = sigma * sigma;
    const Vec3d m = detail::moment_of_eigenvalues(square);
    // the scale is the fit's own sigma of the longest axis, not a second formula
    const double scale = static_cast<double>(detail::sigma_of_moment(m).x) / sigma.x;
    return rotate(square * (scale * scale), random);
}

/// The largest difference of two matrices in any entry.
inline double difference(const SymmetricMatrix& a, const SymmetricMatrix& b) {
    const float d[6] = {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz,
                        a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
    double most = 0.0;
    for (const float x : d) most = std::max(most, static_cast<double>(std::fabs(x)));
    return most;
}

/// The mean of d d^T.
inline SymmetricMatrix pool(const std::vector<Vec3d>& directions) {
    double sum[6]{};
    for (const Vec3d& d : directions) {
        const double product[6] = {d.x * d.x, d.y * d.y, d.z * d.z,
                                   d.x * d.y, d.x * d.z, d.y * d.z};
        for (int i = 0; i < 6; ++i) sum[i] += product[i];
    }
    const auto mean = [&](int i) {
        return static_cast<float>(sum[i] / static_cast<double>(directions.size()));
    };
    return {mean(0), mean(1), mean(2), mean(3), mean(4), mean(5)};
}

/// Directions spread evenly around `axis` at polar angle `angle`: a cone; pi / 2 gives a ring.
inline std::vector<Vec3d> cone(Vec3d axis, double angle, int count) {
    const Vec3d x =
        normalize(cross(axis, std::fabs(axis.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
    const Vec3d y = cross(axis, x);
    std::vector<Vec3d> directions;
    for (int i = 0; i < count; ++i) {
        const double phi = 2.0 * 3.141592653589793 * i / count;
        directions.push_back(axis * std::cos(angle) +
                             (x * std::cos(phi) + y * std::sin(phi)) * std::sin(angle));
    }
    return directions;
}

/// Directions spread evenly over the sphere (Fibonacci).
inline std::vector<Vec3d> sphere(int count) {
    std::vector<Vec3d> directions;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double phi = 2.399963229728653 * i;
        const double r = std::sqrt(1.0 - z * z);
        directions.push_back({r * std::cos(phi), r * std::sin(phi), z});
    }
    return directions;
}

} // namespace heddle::test
