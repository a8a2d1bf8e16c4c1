#include <heddle/scatter/scatter_material.h>

#include <algorithm>
#include <cmath>

namespace heddle {

ScatterMaterial scatter_material_of(const Material& material) {
    ScatterMaterial m;
    m.model =
        material.kind == MaterialKind::Fiber ? ScatterModel::LambertFiber : ScatterModel::Surface;
    m.albedo = material.albedo;
    m.roughness = material.roughness;
    m.metalness = material.metalness;
    m.anisotropy = material.anisotropy;
    return m;
}

Vec3f absorption_from_melanin(float eumelanin, float pheomelanin) {
    return Vec3f{0.419f, 0.697f, 1.37f} * eumelanin + Vec3f{0.187f, 0.4f, 1.05f} * pheomelanin;
}

Vec3f absorption_from_color(Vec3f color, float width_n) {
    const float n = std::min(1.0f, std::max(0.0f, width_n));
    const float scale =
        5.969f + n * (-0.215f + n * (2.532f + n * (-10.73f + n * (5.574f + n * 0.245f))));
    const auto channel = [scale](float c) {
        const float root = std::log(std::min(1.0f, std::max(0.001f, c))) / scale;
        return root * root;
    };
    return {channel(color.x), channel(color.y), channel(color.z)};
}

} // namespace heddle
