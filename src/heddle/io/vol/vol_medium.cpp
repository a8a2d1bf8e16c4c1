#include <heddle/io/vol/vol_medium.h>

#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle {
namespace {

constexpr double kMaxCoverage = 1.0 - 0.5 / (VolMedium::kSubvoxels * VolMedium::kSubvoxels);

bool has_direction(Vec3f t) {
    return t.x != 0.0f || t.y != 0.0f || t.z != 0.0f;
}

std::uint16_t hidden16(double depth, double most) {
    return static_cast<std::uint16_t>(std::min(1.0 - std::exp(-depth), most) * 65535.0 + 0.5);
}

} // namespace

VolMedium::VolMedium(Vec3d voxel_size, double scale) : depth_(voxel_size * scale) {}

Coverage VolMedium::coverage(float density, Vec3f tangent) const {
    Vec3d depth = depth_ * double{density};
    if (has_direction(tangent)) {
        const Vec3d t = to_double(tangent);
        const Vec3d square = t * t;
        const Vec3d sine{std::sqrt(square.y + square.z), std::sqrt(square.x + square.z),
                         std::sqrt(square.x + square.y)};
        depth = depth * sine * (4.0 / std::numbers::pi);
    }
    const double mean = (depth.x + depth.y + depth.z) * (1.0 / 3.0);
    return {hidden16(depth.x, kMaxCoverage), hidden16(depth.y, kMaxCoverage),
            hidden16(depth.z, kMaxCoverage), hidden16(mean / kSubvoxels, 1.0)};
}

PackedSggx VolMedium::lobe(Vec3f tangent) {
    static const SggxMatrix along_x = fit_sggx({1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f});
    static const PackedSggx uniform = pack(fit_sggx({1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f}));
    if (!has_direction(tangent)) return uniform;
    const Vec3f t = tangent;
    const float rest = along_x.yy;
    const float more = along_x.xx - rest; // S = rest I + more t t^T: along_x, rotated to t
    return pack({rest + more * t.x * t.x, rest + more * t.y * t.y, rest + more * t.z * t.z,
                 more * t.x * t.y, more * t.x * t.z, more * t.y * t.z});
}

double default_density_scale(Vec3d voxel_size) {
    constexpr double kDepth = 2.0;
    return kDepth / ((voxel_size.x + voxel_size.y + voxel_size.z) / 3.0);
}

} // namespace heddle
