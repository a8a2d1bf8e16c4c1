#include <heddle/voxelize/triangle/triangle_scan.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace heddle {
namespace {

using Triangle = std::array<Vec3d, 3>;
using Face = std::tuple<int, int, int, int>; // axis, voxel

constexpr int kRays = 64; // of the reference, per voxel edge

std::filesystem::path data_folder() {
    const char* folder = std::getenv("HEDDLE_TEST_DATA");
    return folder != nullptr ? folder : HEDDLE_SOURCE_DIR "/../shared/data";
}

std::vector<Triangle> read_obj_xz(const std::filesystem::path& path) {
    const std::string command = "xz -dc '" + path.string() + "' 2>/dev/null";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::vector<Vec3d> vertices;
    std::vector<Triangle> triangles;
    char line[512];
    while (pipe && std::fgets(line, sizeof line, pipe.get()) != nullptr) {
        Vec3d p;
        std::size_t a = 0, b = 0, c = 0;
        if (std::sscanf(line, "v %lf %lf %lf", &p.x, &p.y, &p.z) == 3) vertices.push_back(p);
        const bool face = std::sscanf(line, "f %zu%*[^ ] %zu%*[^ ] %zu", &a, &b, &c) == 3 ||
                          std::sscanf(line, "f %zu %zu %zu", &a, &b, &c) == 3;
        if (face && std::min({a, b, c}) > 0 && std::max({a, b, c}) <= vertices.size())
            triangles.push_back({vertices[a - 1], vertices[b - 1], vertices[c - 1]});
    }
    return triangles;
}

// Rays through the exact triangles in double: which of a face's 64 x 64 rays meet something inside.
void cast_rays(const Triangle& t, std::map<Face, std::vector<bool>>& faces) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Vec3d d1 = t[1] - t[0], d2 = t[2] - t[0];
        const double area = d1[u] * d2[v] - d2[u] * d1[v];
        if (std::abs(area) < 1e-14) continue;
        const auto first = [&](int a) {
            return static_cast<int>(std::floor(std::min({t[0][a], t[1][a], t[2][a]}) * kRays));
        };
        const auto last = [&](int a) {
            return static_cast<int>(std::ceil(std::max({t[0][a], t[1][a], t[2][a]}) * kRays));
        };
        for (int y = first(v); y <= last(v); ++y)
            for (int x = first(u); x <= last(u); ++x) {
                const double pu = (x + 0.5) / kRays - t[0][u], pv = (y + 0.5) / kRays - t[0][v];
                const double b1 = (pu * d2[v] - pv * d2[u]) / area;
                const double b2 = (pv * d1[u] - pu * d1[v]) / area;
                if (b1 < 0.0 || b2 < 0.0 || b1 + b2 > 1.0) continue;
                int voxel[3];
                voxel[u] = static_cast<int>(std::floor(static_cast<double>(x) / kRays));
                voxel[v] = static_cast<int>(std::floor(static_cast<double>(y) / kRays));
                voxel[axis] =
                    static_cast<int>(std::floor(t[0][axis] + b1 * d1[axis] + b2 * d2[axis]));
                auto& rays = faces[{axis, voxel[0], voxel[1], voxel[2]}];
                rays.resize(kRays * kRays);
                const int at = (y - voxel[v] * kRays) * kRays + (x - voxel[u] * kRays);
                rays[static_cast<std::size_t>(at)] = true;
            }
    }
}

void scan_columns(const Triangle& t, std::map<Face, std::uint64_t>& faces) {
    const double n = 8.0;
    scan_triangle(
        prepare_triangle(t[0] * n, t[1] * n, t[2] * n),
        {{-(1 << 20), -(1 << 20), -(1 << 20)}, {1 << 20, 1 << 20, 1 << 20}},
        [&](int axis, std::int32_t i, std::int32_t j, std::int32_t k, float, float, float) {
            const std::int32_t at[3] = {i, j, k};
            const int column = (at[(axis + 1) % 3] & 7) + 8 * (at[(axis + 2) % 3] & 7);
            faces[{axis, i >> 3, j >> 3, k >> 3}] |= std::uint64_t{1} << column;
        });
}

TEST(TriangleCoverage, ABunnyPatchCoversWhatRaysThroughItFind) {
    const auto path = data_folder() / "mesh" / "stanford-bunny.obj.xz";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
    std::vector<Triangle> bunny = read_obj_xz(path);
    if (bunny.empty()) GTEST_SKIP() << "the program 'xz' is needed to read " << path;
    ASSERT_GT(bunny.size(), 60000u);
    Vec3d lo = bunny[0][0], hi = lo;
    for (const Triangle& t : bunny)
        for (const Vec3d& p : t)
            for (int a = 0; a < 3; ++a)
                lo[a] = std::min(lo[a], p[a]), hi[a] = std::max(hi[a], p[a]);
    const double scale = 150.0 / std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
    std::map<Face, std::vector<bool>> rays;
    std::map<Face, std::uint64_t> columns;
    for (Triangle& t : bunny) {
        for (Vec3d& p : t) p = (p - lo) * scale;
        if (t[0].x < 40.0 || t[0].x > 54.0 || t[0].y < 60.0 || t[0].y > 84.0) continue;
        cast_rays(t, rays);
        scan_columns(t, columns);
    }
    for (const auto& [face, mask] : columns) rays[face].resize(kRays * kRays);
    ASSERT_GT(rays.size(), 2000u);
    double bias = 0.0, error = 0.0;
    for (const auto& [face, hit] : rays) {
        const auto found = columns.find(face);
        const int bits = found == columns.end() ? 0 : std::popcount(found->second);
        const auto exact = static_cast<double>(std::count(hit.begin(), hit.end(), true));
        const double off = bits / 64.0 - exact / (kRays * kRays);
        bias += off;
        error += std::abs(off);
    }
    const auto count = static_cast<double>(rays.size());
    RecordProperty("bias", std::to_string(bias / count));
    RecordProperty("mean_abs_error", std::to_string(error / count));
    EXPECT_LT(std::abs(bias / count), 0.005);
    EXPECT_LT(error / count, 0.025);
}

} // namespace
} // namespace heddle
