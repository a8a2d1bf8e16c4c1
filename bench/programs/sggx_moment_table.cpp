// Prints the rows of src/heddle/sggx/moment_table.h: build with -DHEDDLE_BENCH=ON, then
//   build/release/bench/heddle_sggx_moment_table
// Newton's method in log sigma on the convex function ln R_G - m . log sigma (docs/sggx.md).

#include <heddle/sggx/moments.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace {

using heddle::Vec3d;

/// Mean of sqrt(u^T S u) over the sphere = R_G(a) = sum of a_i (P_j + P_k) / 6 (docs/sggx.md).
double mean_sigma(Vec3d a) {
    Vec3d b = a;
    Vec3d sum{};
    double weight = 1.0;
    for (int step = 0; step < 25; ++step) {
        const Vec3d root{std::sqrt(b.x), std::sqrt(b.y), std::sqrt(b.z)};
        const double lambda = root.x * (root.y + root.z) + root.y * root.z;
        for (int i = 0; i < 3; ++i) sum[i] += weight / (root[i] * (b[i] + lambda));
        for (int i = 0; i < 3; ++i) b[i] = 0.25 * (b[i] + lambda);
        weight *= 0.25;
    }
    const Vec3d P = 3.0 * a * sum;
    return (a.x * (P.y + P.z) + a.y * (P.x + P.z) + a.z * (P.x + P.y)) / 6.0;
}

/// The sigmas whose second moment is m.
Vec3d invert(Vec3d m) {
    m = m * (1.0 / (m.x + m.y + m.z));
    std::array<double, 2> t{0.5 * std::log(m.y / m.x), 0.5 * std::log(m.z / m.x)};
    const auto moment = [](double ty, double tz) {
        return heddle::detail::moment_of_eigenvalues({1.0, std::exp(2.0 * ty), std::exp(2.0 * tz)});
    };
    for (int step = 0; step < 100; ++step) {
        constexpr double kStep = 1e-4;
        const Vec3d at = moment(t[0], t[1]);
        const Vec3d dy = moment(t[0] + kStep, t[1]) - moment(t[0] - kStep, t[1]);
        const Vec3d dz = moment(t[0], t[1] + kStep) - moment(t[0], t[1] - kStep);
        const double gy = at.y - m.y;
        const double gz = at.z - m.z;
        const double scale = 2.0 * kStep / (dy.y * dz.z - dz.y * dy.z);
        const double sy = (dz.z * gy - dz.y * gz) * scale;
        const double sz = (dy.y * gz - dy.z * gy) * scale;
        const double damp = 1.0 / std::max({1.0, std::fabs(sy), std::fabs(sz)});
        t[0] -= damp * sy;
        t[1] -= damp * sz;
        if (std::fabs(sy) + std::fabs(sz) < 1e-10) break;
    }
    const Vec3d s{1.0, std::exp(t[0]), std::exp(t[1])};
    return s * (0.5 / mean_sigma(s * s));
}

/// An entry of the table: sigma_x, sigma_y / u^2, sigma_z / (u^2 v).
Vec3d node(double u, double v) {
    const double y = u * u * u * u;
    const Vec3d s = invert({1.0, y, y * v * v});
    return {s.x, s.y / (u * u), s.z / (u * u * v)};
}

} // namespace

int main() {
    int k = 0;
    for (int i = 0; i < heddle::detail::kTableCountU; ++i) {
        for (int j = 0; j < heddle::detail::kTableCountV; ++j) {
            const double u = (i + 1.0) / static_cast<double>(heddle::detail::kTableStepsU);
            const double v = j / static_cast<double>(heddle::detail::kTableStepsV);
            // at v = 0 the limit: linear through two small v
            const Vec3d e = j > 0 ? node(u, v) : 2.0 * node(u, 1e-3) - node(u, 2e-3);
            std::printf("%s{%.8gf, %.8gf, %.8gf},%s", k % 2 == 0 ? "        " : " ", e.x, e.y, e.z,
                        k % 2 == 1 ? "\n" : "");
            ++k;
        }
    }
}
