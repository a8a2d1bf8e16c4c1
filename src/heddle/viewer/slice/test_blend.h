#pragma once

#include <heddle/render/camera.h>
#include <heddle/slice/section_layers.h>
#include <heddle/slice/slices.h>
#include <heddle/viewer/orbit.h>
#include <heddle/viewer/slice/section_mipmaps.h>
#include <heddle/viewer/slice/slice_renderer.h>
#include <heddle/yarn/slice_image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

// What SliceRenderer draws without shadows, in double precision on the CPU; docs/raster.md
// describes it.

namespace heddle::viewer::test {

/// One image of a section in all its mipmap sizes, with texel lookup.
struct SectionImage {
    std::vector<Texture> sizes;
    std::vector<std::uint8_t> light;

    /// The value of a channel at u, v in [0, 1], interpolated between the centres of texels.
    static double bilinear(
        const std::uint8_t* texels, int width, int size, int channels, int c, double u, double v) {
        const double x = u * size - 0.5;
        const double y = v * size - 0.5;
        const double fx = std::floor(x);
        const double fy = std::floor(y);
        const auto at = [&](double col, double row) {
            const int i = std::clamp(static_cast<int>(col), 0, size - 1);
            const int j = std::clamp(static_cast<int>(row), 0, size - 1);
            return static_cast<double>(texels[(j * width + i) * channels + c]) / 255.0;
        };
        const double a = x - fx;
        const double b = y - fy;
        return (at(fx, fy) * (1 - a) + at(fx + 1, fy) * a) * (1 - b) +
               (at(fx, fy + 1) * (1 - a) + at(fx + 1, fy + 1) * a) * b;
    }
    [[nodiscard]] double color(int c, double u, double v, double level) const {
        const double most = static_cast<double>(sizes.size() - 1);
        const double l = std::clamp(level, 0.0, most);
        const auto lo = static_cast<std::size_t>(l);
        const std::size_t hi = std::min(lo + 1, sizes.size() - 1);
        const auto of = [&](std::size_t k) {
            const int size = std::max(sizes[0].width >> k, 1);
            return bilinear(sizes[k].texels.data(), sizes[k].width, size, 4, c, u, v);
        };
        return std::lerp(of(lo), of(hi), l - static_cast<double>(lo));
    }
    [[nodiscard]] double lit(double u, double v) const {
        const int n = sizes[0].width;
        return bilinear(light.data(), n, n, 1, 0, u, v);
    }
};

struct Segment {
    slice::PlacedSlice a, b;
    Vec3d pa, pb, ta, tb, na, nb; ///< in the eye's axes
    double depth = 0.0;
};

class BlendReference {
public:
    BlendReference(const Geometry& geometry,
                   const slice::SectionLayers& layers,
                   const std::vector<slice::PlacedSlice>& placed,
                   double unit)
        : layers_(layers), placed_(placed), unit_(unit) {
        const std::vector<std::vector<std::uint8_t>> light = bake_light(geometry, layers);
        for (std::size_t l = 0; l < layers.layers.size(); ++l) {
            Texture image;
            image.width = image.height = layers.size;
            image.channels = 4;
            image.texels = layers.layers[l].color;
            images_.push_back({shrink_slice(image), light[l]});
        }
    }

    /// RGBA, linear, premultiplied, rows from the bottom.
    std::vector<double> draw(const CameraParameters& camera, int width, int height, Vec3d light) {
        const CameraAxes axes(camera.eye - camera.target, camera.up);
        parallel_ = camera.orthographic;
        pixel_ =
            (parallel_ ? camera.view_height / unit_ : 2.0 * std::tan(0.5 * camera.view_angle)) /
            height;
        to_light_ = axes.of(normalize(light));
        width_ = width;
        height_ = height;
        rgba_.assign(static_cast<std::size_t>(4 * width * height), 0.0);
        for (const Segment& segment : sorted(axes, camera.eye * (1.0 / unit_)))
            draw_segment(segment);
        return rgba_;
    }

private:
    std::vector<Segment> sorted(const CameraAxes& axes, Vec3d eye) const {
        std::vector<Segment> out;
        for (std::size_t i = 0; i + 1 < placed_.size(); ++i) {
            if (placed_[i].flags != 0) continue;
            Segment s{placed_[i], placed_[i + 1], {}, {}, {}, {}, {}, {}};
            s.pa = axes.of(to_double(s.a.center) - eye);
            s.pb = axes.of(to_double(s.b.center) - eye);
            s.ta = axes.of(to_double(s.a.tangent));
            s.tb = axes.of(to_double(s.b.tangent));
            s.na = axes.of(to_double(s.a.normal));
            s.nb = axes.of(to_double(s.b.normal));
            const Vec3d middle = (s.pa + s.pb) * 0.5;
            s.depth = parallel_ ? middle.z : length(middle);
            out.push_back(s);
        }
        std::stable_sort(out.begin(), out.end(),
                         [](const Segment& a, const Segment& b) { return a.depth > b.depth; });
        return out;
    }

    void draw_segment(const Segment& s) {
        const double reach =
            static_cast<double>(s.a.extent) * static_cast<double>(std::max(s.a.scale, s.b.scale));
        const Vec3d middle = (s.pa + s.pb) * 0.5;
        const double far =
            std::hypot(reach, 0.5 * length(s.pb - s.pa) + reach * length(s.tb - s.ta)) + 0.01;
        const double near = parallel_ ? 1.0 : middle.z - far;
        if (near <= 0.0) return;
        const double grow = far / (pixel_ * near) * 1.5 + 2.0;
        const double x = middle.x / (pixel_ * (parallel_ ? 1.0 : middle.z)) + 0.5 * width_;
        const double y = middle.y / (pixel_ * (parallel_ ? 1.0 : middle.z)) + 0.5 * height_;
        for (int j = std::max(0, int(y - grow)); j < std::min(height_, int(y + grow) + 1); ++j) {
            for (int i = std::max(0, int(x - grow)); i < std::min(width_, int(x + grow) + 1); ++i) {
                draw_pixel(s, i, j, far);
            }
        }
    }

    static void cut(double& lo, double& hi, double at, double slope, bool above) {
        if (slope == 0.0) {
            if ((at >= 0.0) != above) hi = lo;
            return;
        }
        const double t = -at / slope;
        if ((slope > 0.0) == above)
            lo = std::max(lo, t);
        else
            hi = std::min(hi, t);
    }

    void draw_pixel(const Segment& s, int i, int j, double far) {
        const double x = (i + 0.5 - 0.5 * width_) * pixel_;
        const double y = (j + 0.5 - 0.5 * height_) * pixel_;
        const Vec3d ray = parallel_ ? Vec3d{x, y, 0.0} : Vec3d{};
        const Vec3d way = parallel_ ? Vec3d{0.0, 0.0, 1.0} : normalize(Vec3d{x, y, 1.0});
        const Vec3d middle = (s.pa + s.pb) * 0.5;
        const double nearest = dot(middle - ray, way);
        const Vec3d from = ray + way * nearest - middle;
        const double room = far * far - dot(from, from);
        if (room <= 0.0) return;
        double lo = nearest - std::sqrt(room);
        double hi = nearest + std::sqrt(room);
        cut(lo, hi, dot(s.ta, ray - s.pa), dot(s.ta, way), true);
        cut(lo, hi, dot(s.tb, ray - s.pb), dot(s.tb, way), false);
        if (!parallel_) lo = std::max(lo, 0.0);
        if (!(lo < hi)) return;
        march(s, ray, way, lo, hi, &rgba_[static_cast<std::size_t>(4 * (j * width_ + i))]);
    }

    void march(const Segment& s, Vec3d ray, Vec3d way, double lo, double hi, double* to) const {
        const SectionImage& image = images_[s.a.layer];
        const auto extent = static_cast<double>(s.a.extent);
        const double texel = 2.0 * extent * static_cast<double>(s.a.scale) / layers_.size;
        const double wide = parallel_ ? pixel_ : pixel_ * 0.5 * (lo + hi);
        const double level = std::max(0.0, std::log2(wide / texel));
        const double size = texel * std::exp2(level);
        const int steps = std::clamp(static_cast<int>(std::ceil((hi - lo) / size)), 1, 48);
        const double dt = (hi - lo) / steps;
        const Vec3d chord = s.pb - s.pa;
        const Vec3d along = length(chord) > 0.0 ? normalize(chord) : s.ta;
        const Vec3d bulge = (s.ta - s.tb) * (0.5 * length(chord));
        double depth = 0.0;
        double open = 0.0;
        Vec3d color;
        Vec3d direction;
        for (int k = 0; k < steps && depth < 7.0; ++k) {
            const double t = lo + (k + 0.5) * dt;
            const Vec3d point = ray + way * t;
            const double before = dot(s.ta, point - s.pa);
            const double rise = before - dot(s.tb, point - s.pb);
            const double f = std::clamp(before / std::max(rise, 1e-6), 0.0, 1.0);
            const Vec3d p = point - (s.pa * (1 - f) + s.pb * f) - bulge * (f * (1 - f));
            const Vec3d lerped = s.na * (1 - f) + s.nb * f;
            const Vec3d normal = normalize(lerped - along * dot(lerped, along));
            const Vec3d binormal = cross(along, normal);
            const double scale =
                std::lerp(static_cast<double>(s.a.scale), static_cast<double>(s.b.scale), f);
            const double u = dot(p, normal);
            const double v = dot(p, binormal);
            if (std::max(std::fabs(u), std::fabs(v)) > extent * scale) continue;
            const double tu = 0.5 + 0.5 * u / (extent * scale);
            const double tv = 0.5 + 0.5 * v / (extent * scale);
            const double alpha = std::min(image.color(3, tu, tv, level), 0.996);
            const double hidden = -std::log(1.0 - alpha) * dt / size;
            const double weight = (1.0 - std::exp(-hidden)) * std::exp(-depth);
            depth += hidden;
            for (int c = 0; c < 3; ++c) {
                const double tint = static_cast<double>(s.a.color >> (8 * c) & 0xff) / 255.0;
                color[c] += weight * image.color(c, tu, tv, level) * tint;
            }
            open += weight * image.lit(tu, tv);
            const double half = 2.0 * std::sin(0.5 * static_cast<double>(s.a.turn));
            direction = direction + normalize(normal * (-half * v) + binormal * (half * u) +
                                              (s.ta * (1 - f) + s.tb * f) * std::max(rise, 1e-6)) *
                                        weight;
        }
        if (depth < 1e-4) return;
        const double alpha = 1.0 - std::exp(-depth);
        const Vec3d shaded = shade(color * (1.0 / alpha), normalize(direction), way, open / alpha);
        for (int c = 0; c < 3; ++c) to[c] = shaded[c] * alpha + to[c] * (1.0 - alpha);
        to[3] = alpha + to[3] * (1.0 - alpha);
    }

    /// The model of Kajiya and Kay in full light.
    [[nodiscard]] Vec3d shade(Vec3d color, Vec3d t, Vec3d way, double open) const {
        const double along_light = dot(t, to_light_);
        const double along_eye = -dot(t, way);
        const double across_light = std::sqrt(std::max(0.0, 1.0 - along_light * along_light));
        const double across_eye = std::sqrt(std::max(0.0, 1.0 - along_eye * along_eye));
        const double shine =
            std::pow(std::max(0.0, across_light * across_eye - along_light * along_eye), 24.0);
        const double diffuse = 0.25 * open + 0.75 * across_light * (0.5 + 0.5 * open);
        return color * diffuse + Vec3d{1, 1, 1} * (0.12 * shine);
    }

    const slice::SectionLayers& layers_;
    std::vector<slice::PlacedSlice> placed_;
    double unit_;
    std::vector<SectionImage> images_;
    bool parallel_ = false;
    double pixel_ = 1.0;
    Vec3d to_light_;
    int width_ = 0, height_ = 0;
    std::vector<double> rgba_;
};

} // namespace heddle::viewer::test
