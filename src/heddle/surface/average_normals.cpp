#include <heddle/surface/average_normals.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace heddle {

std::vector<Vec3f> average_normals(const Mesh& mesh) {
    std::vector<Vec3d> sum(mesh.positions.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3d p = to_double(mesh.positions[a]);
        const Vec3d n = cross(to_double(mesh.positions[b]) - p, to_double(mesh.positions[c]) - p);
        for (const std::uint32_t v : {a, b, c}) sum[v] = sum[v] + n;
    }
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t v) {
        const Vec3f p = mesh.positions[v];
        return std::array<float, 3>{p.x, p.y, p.z};
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<Vec3f> normals(mesh.positions.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first;
        Vec3d total;
        for (; last < order.size() && key(order[last]) == key(order[first]); ++last)
            total = total + sum[order[last]];
        for (; first < last; ++first) normals[order[first]] = to_float(normalize(total));
    }
    return normals;
}

} // namespace heddle
