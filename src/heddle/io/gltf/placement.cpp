#include <heddle/io/gltf/placement.h>

#include <cmath>

namespace heddle {

Placement operator*(const Placement& outer, const Placement& inner) {
    return {outer.turn(inner.x), outer.turn(inner.y), outer.turn(inner.z),
            outer.turn(inner.origin) + outer.origin};
}

Placement placement_from(Vec3d translation, const std::array<double, 4>& rotation, Vec3d scale) {
    const auto [qx, qy, qz, qw] = rotation;
    const double norm = qx * qx + qy * qy + qz * qz + qw * qw;
    const double s = norm > 0.0 ? 2.0 / norm : 0.0;
    return {Vec3d{1.0 - s * (qy * qy + qz * qz), s * (qx * qy + qz * qw), s * (qx * qz - qy * qw)} *
                scale.x,
            Vec3d{s * (qx * qy - qz * qw), 1.0 - s * (qx * qx + qz * qz), s * (qy * qz + qx * qw)} *
                scale.y,
            Vec3d{s * (qx * qz + qy * qw), s * (qy * qz - qx * qw), 1.0 - s * (qx * qx + qy * qy)} *
                scale.z,
            translation};
}

void append_placed(const Mesh& local, const Placement& place, Mesh& world) {
    const double determinant = dot(place.x, cross(place.y, place.z));
    const bool mirrors = determinant < 0.0;
    // The inverse transpose up to a positive factor; also finite if the map flattens space.
    const double sign = mirrors ? -1.0 : 1.0;
    const Placement turn_normal{cross(place.y, place.z) * sign, cross(place.z, place.x) * sign,
                                cross(place.x, place.y) * sign};
    const auto base = static_cast<std::uint32_t>(world.positions.size());
    for (const Vec3f p : local.positions)
        world.positions.push_back(to_float(place.turn(to_double(p)) + place.origin));
    for (const Vec3f n : local.normals)
        world.normals.push_back(to_float(normalize(turn_normal.turn(to_double(n)))));
    for (std::size_t i = 0; i < local.tangents.size(); ++i) {
        const Tangent t = local.tangents[i];
        const Vec3d normal = to_double(world.normals[base + i]);
        const Vec3d turned = place.turn(to_double(Vec3f{t.x, t.y, t.z}));
        const Vec3d fallback = to_double(any_perpendicular(to_float(normal)));
        const Vec3f unit = to_float(normalize(turned - normal * dot(normal, turned), fallback));
        world.tangents.push_back({unit.x, unit.y, unit.z, mirrors ? -t.w : t.w});
    }
    world.uvs.insert(world.uvs.end(), local.uvs.begin(), local.uvs.end());
    for (const auto& [a, b, c] : local.triangles) {
        if (mirrors)
            world.triangles.push_back({base + a, base + c, base + b});
        else
            world.triangles.push_back({base + a, base + b, base + c});
    }
}

} // namespace heddle
