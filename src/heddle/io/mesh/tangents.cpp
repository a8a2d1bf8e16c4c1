#include <heddle/io/mesh/tangents.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace heddle {
namespace {

constexpr std::uint32_t kNone = ~0U;

/// Vertices with equal position, normal and uv are one vertex. Adding 0 makes -0 and 0 equal.
struct WeldKey {
    float values[8];
    bool operator==(const WeldKey& other) const {
        return std::memcmp(values, other.values, sizeof values) == 0;
    }
};
struct WeldHash {
    std::size_t operator()(const WeldKey& key) const {
        std::uint64_t hash = 0x9E3779B97F4A7C15U;
        for (const float value : key.values) {
            std::uint32_t bits = 0;
            std::memcpy(&bits, &value, sizeof bits);
            hash = (hash ^ bits) * 0xFF51AFD7ED558CCDU;
            hash ^= hash >> 32;
        }
        return hash;
    }
};

/// Per vertex, the first vertex that is equal to it.
std::vector<std::uint32_t> weld(const Mesh& mesh) {
    std::unordered_map<WeldKey, std::uint32_t, WeldHash> first;
    first.reserve(mesh.positions.size());
    std::vector<std::uint32_t> welded(mesh.positions.size());
    for (std::uint32_t i = 0; i < welded.size(); ++i) {
        const Vec3f p = mesh.positions[i];
        const Vec3f n = mesh.normals[i];
        const Uv uv = mesh.uvs[i];
        WeldKey key{{p.x, p.y, p.z, n.x, n.y, n.z, uv.u, uv.v}};
        for (float& value : key.values) value += 0.0f;
        welded[i] = first.try_emplace(key, i).first->second;
    }
    return welded;
}

struct TangentFrame {
    Vec3d along;          ///< direction of increasing u; not unit
    double uv_area = 0.0; ///< twice the signed area in (u, v); 0: no frame
};

/// The uv derivatives of a triangle                                          [Mikkelsen 2008, A.2]
TangentFrame frame_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners) {
    const Vec3d p = to_double(mesh.positions[corners[0]]);
    const Vec3d d1 = to_double(mesh.positions[corners[1]]) - p;
    const Vec3d d2 = to_double(mesh.positions[corners[2]]) - p;
    const Uv a = mesh.uvs[corners[0]];
    const Uv b = mesh.uvs[corners[1]];
    const Uv c = mesh.uvs[corners[2]];
    const double u1 = double{b.u} - double{a.u};
    const double v1 = double{b.v} - double{a.v};
    const double u2 = double{c.u} - double{a.u};
    const double v2 = double{c.v} - double{a.v};
    TangentFrame frame;
    frame.uv_area = u1 * v2 - u2 * v1;
    frame.along = (d1 * v2 - d2 * v1) * (frame.uv_area < 0.0 ? -1.0 : 1.0);
    if (!(length(frame.along) > 0.0) || !(length(cross(d1, d2)) > 0.0)) frame.uv_area = 0.0;
    return frame;
}

/// Sets of corners (3 x triangle + 0, 1, 2) that share one tangent; a set's root is its smallest.
class CornerGroups {
public:
    explicit CornerGroups(std::size_t corners) : parent_(corners) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t root(std::uint32_t corner) {
        while (parent_[corner] != corner) {
            parent_[corner] = parent_[parent_[corner]];
            corner = parent_[corner];
        }
        return corner;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

struct Edge {
    std::uint32_t low, high; ///< welded vertices
    bool mirrored;
    std::uint32_t at_low, at_high; ///< the triangle's corners at these vertices
    [[nodiscard]] auto key() const { return std::tie(low, high, mirrored); }
    [[nodiscard]] auto order() const { return std::tie(low, high, mirrored, at_low); }
};

/// Joins the corners of triangles of equal handedness across their shared edges.
CornerGroups group_corners(const Mesh& mesh,
                           const std::vector<std::uint32_t>& welded,
                           const std::vector<TangentFrame>& frames) {
    std::vector<Edge> edges;
    edges.reserve(3 * frames.size());
    for (std::uint32_t t = 0; t < frames.size(); ++t) {
        if (frames[t].uv_area == 0.0) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t from = 3 * t + k;
            const std::uint32_t to = 3 * t + (k + 1) % 3;
            const std::uint32_t a = welded[mesh.triangles[t][k]];
            const std::uint32_t b = welded[mesh.triangles[t][(k + 1) % 3]];
            const bool mirrored = frames[t].uv_area < 0.0;
            edges.push_back(a < b ? Edge{a, b, mirrored, from, to}
                                  : Edge{b, a, mirrored, to, from});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return a.order() < b.order(); });
    CornerGroups groups(3 * frames.size());
    for (std::size_t i = 1; i < edges.size(); ++i) {
        if (edges[i - 1].key() != edges[i].key()) continue;
        groups.join(edges[i - 1].at_low, edges[i].at_low);
        groups.join(edges[i - 1].at_high, edges[i].at_high);
    }
    return groups;
}

Vec3d project(Vec3d v, Vec3d normal) {
    return normalize(v - normal * dot(normal, v), Vec3d{});
}

/// The contribution of a corner to its group's tangent: unit, times the angle of the triangle at
/// the corner, both projected along the vertex normal.
Vec3d weighted_tangent(const Mesh& mesh,
                       const std::array<std::uint32_t, 3>& corners,
                       std::uint32_t k,
                       const TangentFrame& frame) {
    const std::uint32_t at = corners[k];
    const Vec3d normal = normalize(to_double(mesh.normals[at]));
    const Vec3d p = to_double(mesh.positions[at]);
    const Vec3d next = project(to_double(mesh.positions[corners[(k + 1) % 3]]) - p, normal);
    const Vec3d last = project(to_double(mesh.positions[corners[(k + 2) % 3]]) - p, normal);
    const double angle = std::acos(std::clamp(dot(next, last), -1.0, 1.0));
    return project(frame.along, normal) * angle;
}

/// The tangent of each corner, which is that of its group.
struct CornerTangents {
    std::vector<std::uint32_t> group; ///< per corner, the root of its group; kNone: no frame
    std::vector<Vec3d> sum;           ///< at the group's root
    std::vector<float> sign;          ///< at the group's root
};

CornerTangents corner_tangents(const Mesh& mesh, const std::vector<std::uint32_t>& welded) {
    std::vector<TangentFrame> frames;
    frames.reserve(mesh.triangles.size());
    for (const auto& corners : mesh.triangles) frames.push_back(frame_of(mesh, corners));
    CornerGroups groups = group_corners(mesh, welded, frames);
    CornerTangents out{std::vector<std::uint32_t>(3 * frames.size(), kNone),
                       std::vector<Vec3d>(3 * frames.size()),
                       std::vector<float>(3 * frames.size(), 1.0f)};
    std::vector<std::uint32_t> group_at(welded.size(),
                                        kNone); // a frame to reuse, by welded vertex
    for (std::uint32_t t = 0; t < frames.size(); ++t) {
        if (frames[t].uv_area == 0.0) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t root = groups.root(3 * t + k);
            out.group[3 * t + k] = root;
            out.sum[root] = out.sum[root] + weighted_tangent(mesh, mesh.triangles[t], k, frames[t]);
            out.sign[root] = frames[t].uv_area < 0.0 ? 1.0f : -1.0f;
            std::uint32_t& borrow = group_at[welded[mesh.triangles[t][k]]];
            if (borrow == kNone) borrow = root;
        }
    }
    for (std::uint32_t corner = 0; corner < out.group.size(); ++corner) {
        if (out.group[corner] == kNone)
            out.group[corner] = group_at[welded[mesh.triangles[corner / 3][corner % 3]]];
    }
    return out;
}

/// Adds a copy of vertex `from`; the caller sets its tangent.
void split_vertex(Mesh& mesh, std::uint32_t from) {
    mesh.positions.push_back(mesh.positions[from]);
    mesh.normals.push_back(mesh.normals[from]);
    mesh.uvs.push_back(mesh.uvs[from]);
    mesh.tangents.emplace_back();
}

Tangent arbitrary_tangent(Vec3f normal) {
    const Vec3f t = any_perpendicular(normalize(normal));
    return {t.x, t.y, t.z, 1.0f};
}

} // namespace

void set_flat_normals(Mesh& mesh) {
    Mesh flat;
    flat.material = mesh.material;
    flat.positions.reserve(3 * mesh.triangles.size());
    flat.normals.reserve(3 * mesh.triangles.size());
    flat.triangles.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3d p = to_double(mesh.positions[a]);
        const Vec3d n =
            normalize(cross(to_double(mesh.positions[b]) - p, to_double(mesh.positions[c]) - p));
        const auto base = static_cast<std::uint32_t>(flat.positions.size());
        flat.triangles.push_back({base, base + 1, base + 2});
        for (const std::uint32_t corner : {a, b, c}) {
            flat.positions.push_back(mesh.positions[corner]);
            flat.normals.push_back(to_float(n));
            if (!mesh.uvs.empty()) flat.uvs.push_back(mesh.uvs[corner]);
        }
    }
    mesh = std::move(flat);
}

void set_tangents(Mesh& mesh) {
    if (mesh.normals.empty()) set_flat_normals(mesh);
    mesh.tangents.clear();
    for (const Vec3f normal : mesh.normals) mesh.tangents.push_back(arbitrary_tangent(normal));
    if (mesh.uvs.empty()) return;
    const CornerTangents corners = corner_tangents(mesh, weld(mesh));

    // The first group that uses a vertex keeps it; every other group gets a copy.
    std::vector<std::uint32_t> owner(mesh.positions.size(), kNone);
    std::unordered_map<std::uint64_t, std::uint32_t> copies; // of (vertex, group)
    for (std::uint32_t corner = 0; corner < corners.group.size(); ++corner) {
        const std::uint32_t group = corners.group[corner];
        if (group == kNone) continue;
        std::uint32_t& vertex = mesh.triangles[corner / 3][corner % 3];
        if (owner[vertex] == group) continue;
        if (owner[vertex] != kNone) {
            const auto [copy, is_new] =
                copies.try_emplace((std::uint64_t{vertex} << 32) | group, mesh.positions.size());
            if (is_new) split_vertex(mesh, vertex);
            vertex = copy->second;
            if (!is_new) continue;
        } else {
            owner[vertex] = group;
        }
        const Vec3d fallback = to_double(any_perpendicular(normalize(mesh.normals[vertex])));
        const Vec3f t = to_float(normalize(corners.sum[group], fallback));
        mesh.tangents[vertex] = {t.x, t.y, t.z, corners.sign[group]};
    }
}

} // namespace heddle
