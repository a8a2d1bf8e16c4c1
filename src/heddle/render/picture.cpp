#include <heddle/render/picture.h>

#include <heddle/geom/color.h>
#include <heddle/sggx/eigen.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace heddle {
namespace {

double luminance(double r, double g, double b) {
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

/// Returns the variance of the mean luminance; 0 with fewer than two samples.
double variance_of_mean(const PixelSums& p) {
    if (p.samples < 2) return 0.0;
    const double n = p.samples;
    const double mean = luminance(p.red, p.green, p.blue) / n;
    return std::max(0.0, (p.square / n - mean * mean) / (n - 1.0));
}

/// Returns the channel `axis`, as channels_of describes it.
Vec3d mean_axis(const PixelSums& p) {
    if (p.hits == 0) return {};
    const Vec3d d = decompose(p.axes).axis[0];
    const Vec3d sum = to_double(p.axis);
    const bool sided = length(sum) > 0.5 * p.hits; // axes of random sign have a far smaller sum
    const int most = std::fabs(d.x) > std::fabs(d.y) ? (std::fabs(d.x) > std::fabs(d.z) ? 0 : 2)
                                                     : (std::fabs(d.y) > std::fabs(d.z) ? 1 : 2);
    return d * ((sided ? dot(sum, d) : d[most]) < 0.0 ? -1.0 : 1.0);
}

} // namespace

void PixelSums::add(const PathSample& sample) {
    ++samples;
    transmittance += static_cast<double>(sample.transmittance);
    const Vec3d c = to_double(sample.radiance);
    const double y = luminance(c.x, c.y, c.z);
    if (std::isfinite(y)) {
        red += c.x;
        green += c.y;
        blue += c.z;
        square += y * y;
    }
    const FirstHit& first = sample.first;
    if (!first.any) return;
    if (hits++ == 0) material = first.material;
    depth += static_cast<double>(first.depth);
    level += static_cast<double>(first.level);
    albedo = albedo + first.albedo;
    const Vec3f d = first.axis;
    axis = axis + d;
    axes = {axes.xx + d.x * d.x, axes.yy + d.y * d.y, axes.zz + d.z * d.z,
            axes.xy + d.x * d.y, axes.xz + d.x * d.z, axes.yz + d.y * d.z};
}

double Picture::noise() const {
    double sum = 0.0;
    for (const PixelSums& p : pixels) {
        if (p.samples < 2) return 0.0;
        sum += std::min(variance_of_mean(p), 1.0);
    }
    return pixels.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(pixels.size()));
}

std::vector<PictureChannel> channels_of(const Picture& picture, bool all) {
    std::vector<PictureChannel> out;
    const auto add = [&](const char* name, const std::function<double(const PixelSums&)>& value) {
        PictureChannel& channel = out.emplace_back();
        channel.name = name;
        channel.values.reserve(picture.pixels.size());
        for (const PixelSums& p : picture.pixels)
            channel.values.push_back(static_cast<float>(value(p)));
    };
    const auto mean = [](double sum, const PixelSums& p) {
        return p.samples == 0 ? 0.0 : sum / p.samples;
    };
    const auto of_hits = [](double sum, const PixelSums& p) {
        return p.hits == 0 ? 0.0 : sum / p.hits;
    };
    add("R", [&](const PixelSums& p) { return mean(p.red, p); });
    add("G", [&](const PixelSums& p) { return mean(p.green, p); });
    add("B", [&](const PixelSums& p) { return mean(p.blue, p); });
    add("A", [&](const PixelSums& p) { return 1.0 - mean(p.transmittance, p); });
    if (!all) return out;
    add("depth", [&](const PixelSums& p) { return of_hits(p.depth, p); });
    add("transmittance", [&](const PixelSums& p) { return mean(p.transmittance, p); });
    for (int a = 0; a < 3; ++a) {
        const char* const names[] = {"axis.X", "axis.Y", "axis.Z"};
        add(names[a], [&](const PixelSums& p) { return mean_axis(p)[a]; });
    }
    for (int a = 0; a < 3; ++a) {
        const char* const names[] = {"albedo.R", "albedo.G", "albedo.B"};
        add(names[a],
            [&](const PixelSums& p) { return of_hits(static_cast<double>(p.albedo[a]), p); });
    }
    add("level", [&](const PixelSums& p) { return of_hits(p.level, p); });
    add("material", [&](const PixelSums& p) { return p.hits == 0 ? -1.0 : p.material; });
    add("samples", [&](const PixelSums& p) { return p.samples; });
    add("variance", [&](const PixelSums& p) { return variance_of_mean(p); });
    return out;
}

std::vector<std::uint8_t> to_srgb8(const Picture& picture, double exposure) {
    std::vector<std::uint8_t> out;
    out.reserve(4 * picture.pixels.size());
    const double gain = std::exp2(exposure);
    for (const PixelSums& p : picture.pixels) {
        const double scale = p.samples == 0 ? 0.0 : 1.0 / p.samples;
        for (const double c : {p.red, p.green, p.blue}) out.push_back(srgb_byte(c * scale * gain));
        out.push_back(255);
    }
    return out;
}

} // namespace heddle
