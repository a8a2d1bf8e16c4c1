#include <heddle/render/light.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace heddle {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float luminance(Vec3f c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

/// Returns the coordinates of a direction in the map, both in [0, 1].
struct MapPoint {
    float u, v;
};

MapPoint point_of(const EnvironmentMap& map, Vec3f d) {
    const Vec3f right = cross(map.front, map.up);
    const float turn = std::atan2(dot(d, right), dot(d, map.front));
    return {0.5f + turn / (2.0f * kPi), std::acos(std::clamp(dot(d, map.up), -1.0f, 1.0f)) / kPi};
}

/// Finds the step of a running sum that contains `x`; `rest` is the position in it, in [0, 1).
std::size_t find_step(const float* sums, std::size_t n, float x, float& rest) {
    const float* at = std::upper_bound(sums + 1, sums + n, x);
    const auto i = static_cast<std::size_t>(at - sums) - 1;
    const float width = sums[i + 1] - sums[i];
    rest = width > 0.0f ? std::clamp((x - sums[i]) / width, 0.0f, 0.999999f) : 0.5f;
    return i;
}

/// Replaces weights by running sums from 0 to 1; equal steps if all weights are 0.
void accumulate(std::vector<float>& sums, std::size_t first, const std::vector<double>& weights) {
    double total = 0.0;
    for (double w : weights) total += w;
    double sum = 0.0;
    sums[first] = 0.0f;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += total > 0.0 ? weights[i] / total : 1.0 / static_cast<double>(weights.size());
        sums[first + i + 1] = static_cast<float>(std::min(sum, 1.0));
    }
    sums[first + weights.size()] = 1.0f;
}

double row_sine(std::int32_t row, std::int32_t height) {
    return std::sin(std::numbers::pi * (row + 0.5) / height);
}

} // namespace

LightSet::LightSet(std::vector<Light> lights, double scene_radius)
    : lights_(std::move(lights)), tables_(lights_.size()) {
    const auto disc = static_cast<float>(std::numbers::pi * scene_radius * scene_radius);
    float total = 0.0f;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const Light& light = lights_[i];
        float power = luminance(light.color);
        switch (light.kind) {
        case LightKind::Constant: power *= kPi * disc; break;
        case LightKind::Directional: power *= disc; break;
        case LightKind::Point: power *= 4.0f * kPi; break;
        case LightKind::Area:
            power *= kPi * static_cast<float>(length(cross(light.edge_u, light.edge_v)));
            break;
        case LightKind::Environment: {
            const EnvironmentMap& map = *light.map;
            const auto w = static_cast<std::size_t>(map.width);
            const auto h = static_cast<std::size_t>(map.height);
            MapTable& table = tables_[i];
            table.rows.resize(h + 1);
            table.columns.resize(h * (w + 1));
            std::vector<double> rows(h), texels(w);
            double mean = 0.0;
            for (std::size_t y = 0; y < h; ++y) {
                double sum = 0.0;
                for (std::size_t x = 0; x < w; ++x) {
                    texels[x] = static_cast<double>(luminance(map.radiance[y * w + x]));
                    sum += texels[x];
                }
                accumulate(table.columns, y * (w + 1), texels);
                rows[y] = sum * row_sine(static_cast<std::int32_t>(y), map.height);
                mean += rows[y];
            }
            accumulate(table.rows, 0, rows);
            mean *= std::numbers::pi / (2.0 * static_cast<double>(w) * static_cast<double>(h));
            power *= kPi * disc * static_cast<float>(mean);
            break;
        }
        }
        share_.push_back(power);
        total += power;
    }
    for (float& s : share_) { // half by power, half evenly, so that every light is sampled
        const float even = 1.0f / static_cast<float>(share_.size());
        s = total > 0.0f ? 0.5f * s / total + 0.5f * even : even;
    }
}

LightSample LightSet::sample(Vec3d from, Vec3f u) const {
    LightSample out;
    if (lights_.empty()) return out;
    std::size_t i = 0;
    float pick = u.z;
    while (i + 1 < lights_.size() && pick >= share_[i]) pick -= share_[i++];
    const Light& light = lights_[i];
    out.distance = kInfinity;
    switch (light.kind) {
    case LightKind::Constant: {
        const float z = 1.0f - 2.0f * u.x;
        const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
        const float phi = 2.0f * kPi * u.y;
        return sample_of_background({r * std::cos(phi), r * std::sin(phi), z});
    }
    case LightKind::Environment: return sample_of_background(sample_map(i, u.x, u.y));
    case LightKind::Directional:
        out.direction = light.direction * -1.0f;
        out.radiance = light.color;
        break;
    case LightKind::Point: {
        const Vec3d to = light.position - from;
        const double distance = length(to);
        if (!(distance > 0.0)) return {};
        out.direction = to_float(to * (1.0 / distance));
        out.distance = static_cast<float>(distance);
        out.radiance = light.color * static_cast<float>(1.0 / (distance * distance));
        break;
    }
    case LightKind::Area: {
        const Vec3d at = light.position + light.edge_u * static_cast<double>(u.x) +
                         light.edge_v * static_cast<double>(u.y);
        const Vec3d to = at - from;
        const double distance = length(to);
        const Vec3d normal = cross(light.edge_u, light.edge_v);
        const double facing = -dot(normal, to); // area x cosine x distance
        if (!(distance > 0.0) || !(facing > 0.0)) return {};
        out.direction = to_float(to * (1.0 / distance));
        out.distance = static_cast<float>(distance);
        out.pdf = static_cast<float>(distance * distance * distance / facing);
        out.radiance = light.color * (1.0f / out.pdf);
        break;
    }
    }
    out.radiance = out.radiance * (1.0f / share_[i]);
    out.pdf *= share_[i];
    return out;
}

LightSample LightSet::sample_of_background(Vec3f direction) const {
    const LightHit hit = background(direction);
    if (!(hit.pdf > 0.0f)) return {};
    return {direction, hit.radiance * (1.0f / hit.pdf), hit.pdf, kInfinity};
}

Vec3f LightSet::sample_map(std::size_t i, float u, float v) const {
    const EnvironmentMap& map = *lights_[i].map;
    const MapTable& table = tables_[i];
    const auto w = static_cast<std::size_t>(map.width);
    const auto h = static_cast<std::size_t>(map.height);
    float dx = 0.0f, dy = 0.0f;
    const std::size_t y = find_step(table.rows.data(), h, v, dy);
    const std::size_t x = find_step(table.columns.data() + y * (w + 1), w, u, dx);
    const float theta = kPi * (static_cast<float>(y) + dy) / static_cast<float>(h);
    const float phi = 2.0f * kPi * ((static_cast<float>(x) + dx) / static_cast<float>(w) - 0.5f);
    const Vec3f right = cross(map.front, map.up);
    return map.up * std::cos(theta) +
           (map.front * std::cos(phi) + right * std::sin(phi)) * std::sin(theta);
}

float LightSet::map_pdf(std::size_t i, Vec3f direction) const {
    const EnvironmentMap& map = *lights_[i].map;
    const MapTable& table = tables_[i];
    const auto w = static_cast<std::size_t>(map.width);
    const auto h = static_cast<std::size_t>(map.height);
    const MapPoint at = point_of(map, direction);
    const std::size_t x = std::min(static_cast<std::size_t>(at.u * static_cast<float>(w)), w - 1);
    const std::size_t y = std::min(static_cast<std::size_t>(at.v * static_cast<float>(h)), h - 1);
    const float row = table.rows[y + 1] - table.rows[y];
    const float column = table.columns[y * (w + 1) + x + 1] - table.columns[y * (w + 1) + x];
    const float sine = std::sin(kPi * at.v);
    if (!(sine > 1e-6f)) return 0.0f;
    return row * column * static_cast<float>(w) * static_cast<float>(h) / (2.0f * kPi * kPi * sine);
}

Vec3f LightSet::map_radiance(const Light& light, Vec3f direction) {
    const EnvironmentMap& map = *light.map;
    const MapPoint at = point_of(map, direction);
    const auto x =
        std::min(static_cast<std::int32_t>(at.u * static_cast<float>(map.width)), map.width - 1);
    const auto y =
        std::min(static_cast<std::int32_t>(at.v * static_cast<float>(map.height)), map.height - 1);
    return light.color *
           map.radiance[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                        static_cast<std::size_t>(x)];
}

bool LightSet::intersect(const Ray& ray, LightHit& hit) const {
    bool found = false;
    float nearest = ray.t_max;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const Light& light = lights_[i];
        if (light.kind != LightKind::Area) continue;
        const Vec3d d = to_double(ray.direction);
        const Vec3d normal = cross(light.edge_u, light.edge_v);
        const double facing = -dot(normal, d);
        if (!(facing > 0.0)) continue;
        const double t = dot(normal, ray.origin - light.position) / facing;
        if (!(t > 0.0) || !(t < static_cast<double>(nearest))) continue;
        const Vec3d at = ray.origin + d * t - light.position;
        const double area2 = dot(normal, normal);
        const double u = dot(cross(at, light.edge_v), normal) / area2;
        const double v = dot(cross(light.edge_u, at), normal) / area2;
        if (u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) continue;
        nearest = static_cast<float>(t);
        hit = {light.color, share_[i] * static_cast<float>(t * t / facing), nearest};
        found = true;
    }
    return found;
}

LightHit LightSet::background(Vec3f direction) const {
    LightHit out;
    out.t = kInfinity;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        if (lights_[i].kind == LightKind::Constant) {
            out.radiance = out.radiance + lights_[i].color;
            out.pdf += share_[i] * 0.25f / kPi;
        } else if (lights_[i].kind == LightKind::Environment) {
            out.radiance = out.radiance + map_radiance(lights_[i], direction);
            out.pdf += share_[i] * map_pdf(i, direction);
        }
    }
    return out;
}

} // namespace heddle
