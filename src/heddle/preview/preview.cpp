#include <heddle/preview/preview.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/geom/color.h>
#include <heddle/preview/preview_volume.h>
#include <heddle/preview/sheet.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heddle {
namespace {

using preview::kClosing;
using preview::kFlatWidth;
using preview::kOpaque;
using preview::kSheetGap;
using preview::PreviewLeaf;
using preview::PreviewVolume;
using preview::PreviewVoxel;

/// A ray with a direction in double precision (the renderer's has floats): it starts far from the
/// object and steps through tiles of 128 voxels.
struct Ray {
    Vec3d origin;
    Vec3d direction; ///< unit
};

/// The camera. The object's bounds fill the picture, with a margin of 4 % on each side.
struct Camera {
    Vec3d center, right, up, back; ///< `back` points to the eye
    double half_height = 1.0;      ///< of an orthographic picture, scene units
    double distance = 0.0;         ///< from the eye to `center`; 0: orthographic
    double tangent = 0.0;          ///< of half the field of view
    double depth = 1.0;            ///< rays start this far from `center`

    [[nodiscard]] Ray ray(double x, double y, double aspect) const { // in [-1, 1], y up
        if (distance > 0.0) {
            const Vec3d d = right * (x * tangent * aspect) + up * (y * tangent) - back;
            return {center + back * distance, normalize(d)};
        }
        return {center + right * (x * half_height * aspect) + up * (y * half_height) + back * depth,
                back * -1.0};
    }
};

int guess_up(const PreviewVolume& scene) {
    const Vec3d s = scene.bounds_hi() - scene.bounds_lo();
    return s.z < 0.5 * s.x && s.z < 0.5 * s.y ? 2
                                              : 1; // cloth that lies on the ground of a z-up scene
}

Camera make_camera(const PreviewVolume& scene, const PreviewOptions& options) {
    Vec3d up_axis;
    const int up = options.up_axis >= 0 ? options.up_axis : guess_up(scene);
    up_axis[up] = 1.0;
    Vec3d from = up == 2 ? Vec3d{0.6, -1.0, 0.8} : Vec3d{0.6, 0.7, 1.0};
    if (up == 0) from = {0.7, 0.6, 1.0};
    Camera camera;
    camera.back = normalize(options.from.value_or(from));
    Vec3d right = cross(up_axis, camera.back);
    if (length(right) < 1e-6) { // straight from above or below
        right = cross(up == 2 ? Vec3d{0.0, 1.0, 0.0} : Vec3d{0.0, 0.0, -1.0}, camera.back);
    }
    camera.right = normalize(right);
    camera.up = cross(camera.back, camera.right);
    camera.center = (scene.bounds_lo() + scene.bounds_hi()) * 0.5;
    const Vec3d half = (scene.bounds_hi() - scene.bounds_lo()) * 0.5;
    camera.depth = length(half) * 1.01;
    camera.tangent = std::tan(0.5 * options.field_of_view);
    const double aspect = static_cast<double>(options.width) / options.height;
    camera.half_height = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d p{(corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                      (corner & 4) != 0 ? half.z : -half.z};
        const double need =
            std::max(std::abs(dot(p, camera.right)) / aspect, std::abs(dot(p, camera.up))) * 1.04;
        camera.half_height = std::max(camera.half_height, need);
        if (camera.tangent > 0.0) {
            camera.distance =
                std::max(camera.distance, need / camera.tangent + dot(p, camera.back));
        }
    }
    return camera;
}

/// Steps through the cells of a lattice that a ray crosses.
struct Walk {
    Vec3i at;
    Vec3i step;
    Vec3d next;  ///< t at which the cell ends, by axis
    Vec3d width; ///< t across a cell

    /// @param p, d  of the ray at t = 0, in units of the cell
    Walk(Vec3d p, Vec3d d, double t, Vec3i lo, Vec3i hi) {
        for (int a = 0; a < 3; ++a) {
            const double x = p[a] + d[a] * t;
            at[a] = std::clamp(static_cast<std::int32_t>(std::floor(x)), lo[a], hi[a]);
            step[a] = d[a] > 0.0 ? 1 : -1;
            constexpr double kNever = std::numeric_limits<double>::infinity();
            width[a] = d[a] != 0.0 ? std::abs(1.0 / d[a]) : kNever;
            const double edge = at[a] + (d[a] > 0.0 ? 1.0 : 0.0);
            next[a] = d[a] != 0.0 ? (edge - p[a]) / d[a] : kNever;
        }
    }
    [[nodiscard]] int axis() const {
        return next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    }
    [[nodiscard]] double end() const { return next[axis()]; }
    /// Moves to the next cell. Returns false if it is outside [lo, hi]; by rounding, this may
    /// happen before t reaches the end.
    bool advance(Vec3i lo, Vec3i hi) {
        const int a = axis();
        at[a] += step[a];
        next[a] += width[a];
        return at[a] >= lo[a] && at[a] <= hi[a];
    }
};

Vec3f palette(std::uint64_t id) {
    const double turn = static_cast<double>(id % 4096) * 0.61803398875 + 0.05; // golden ratio
    const float hue = static_cast<float>(turn - std::floor(turn)) * 6.0f;
    const auto channel = [&](float shift) {
        const float x = std::abs(std::fmod(hue + shift, 6.0f) - 3.0f) - 1.0f;
        return 0.15f + 0.75f * std::clamp(x, 0.0f, 1.0f);
    };
    return {channel(0.0f), channel(4.0f), channel(2.0f)};
}

Vec3f heat(float x) { // blue, green, yellow, red
    return {std::clamp(2.0f * x - 0.4f, 0.0f, 1.0f), 1.0f - std::abs(2.0f * x - 0.9f),
            std::clamp(1.0f - 2.2f * x, 0.0f, 1.0f)};
}

/// Composites the voxels along a ray, front to back.
class Painter {
public:
    Painter(const PreviewVolume& scene, const PreviewOptions& options, Vec3d back)
        : scene_(scene), options_(options), eye_(normalize(to_float(back))) {}

    /// @return  linear premultiplied colour, and alpha
    void trace(const Ray& ray, Vec3f& color, float& alpha) const {
        Vec3d p, d;
        for (int a = 0; a < 3; ++a) {
            p[a] = ray.origin[a] / scene_.voxel_size()[a];
            d[a] = ray.direction[a] / scene_.voxel_size()[a];
        }
        double t = 0.0, t_end = 0.0;
        if (!clip(p, d, t, t_end)) return;
        RayState state{.p = p, .d = d, .weight = to_float(d), .color = color, .through = 1.0f};
        traverse_cells(state, t, t_end);
        color = state.color;
        alpha = 1.0f - state.through;
    }

private:
    struct RayState {
        Vec3d p, d;   ///< voxels
        Vec3f weight; ///< d in floats: voxels that the ray crosses along each axis per unit of t
        Vec3f color;
        float through;
        /// t at which the last voxel of a flat surface ended
        double sheet_end = -std::numeric_limits<double>::infinity();
        float sheet_left = 1.0f; ///< part of the ray that this surface has not covered yet
    };
    bool clip(Vec3d p, Vec3d d, double& t, double& t_end) const {
        t = 0.0;
        t_end = std::numeric_limits<double>::infinity();
        for (int a = 0; a < 3; ++a) {
            const double lo = scene_.lo()[a] * 8.0, hi = (scene_.hi()[a] + 1) * 8.0;
            if (d[a] == 0.0) {
                if (p[a] < lo || p[a] >= hi) return false;
                continue;
            }
            const double u = (lo - p[a]) / d[a], v = (hi - p[a]) / d[a];
            t = std::max(t, std::min(u, v));
            t_end = std::min(t_end, std::max(u, v));
        }
        return t < t_end;
    }

    void traverse_cells(RayState& s, double t, double t_end) const {
        const Vec3i lo{scene_.lo().x >> 4, scene_.lo().y >> 4, scene_.lo().z >> 4};
        const Vec3i hi{scene_.hi().x >> 4, scene_.hi().y >> 4, scene_.hi().z >> 4};
        Walk walk(s.p * (1.0 / 128.0), s.d * (1.0 / 128.0), t, lo, hi);
        while (t < t_end && s.through > kOpaque) {
            const double leave = std::min(walk.end(), t_end);
            const std::uint32_t tile = scene_.table().find_tile(walk.at);
            if (tile != PreviewVolume::Table::kNone) traverse_leaves(s, tile, walk.at, t, leave);
            t = std::max(t, leave);
            if (leave >= t_end || !walk.advance(lo, hi)) break;
        }
    }

    void traverse_leaves(RayState& s, std::uint32_t tile, Vec3i at, double t, double t_end) const {
        const Vec3i lo = at * 16;
        const Vec3i hi = lo + Vec3i{15, 15, 15};
        Walk walk(s.p * 0.125, s.d * 0.125, t, lo, hi);
        while (t < t_end && s.through > kOpaque) {
            const double leave = std::min(walk.end(), t_end);
            const PreviewLeaf* leaf = scene_.leaf(tile, walk.at);
            if (leaf != nullptr) traverse_leaf(s, *leaf, walk.at, t, leave);
            t = std::max(t, leave);
            if (leave >= t_end || !walk.advance(lo, hi)) break;
        }
    }

    void
    traverse_leaf(RayState& s, const PreviewLeaf& leaf, Vec3i at, double t, double t_end) const {
        const Vec3i lo = at * 8;
        const Vec3i hi = lo + Vec3i{7, 7, 7};
        Walk walk(s.p, s.d, t, lo, hi);
        while (t < t_end && s.through > kOpaque) {
            const double leave = std::min(walk.end(), t_end);
            const std::int32_t number = leaf.mask.find(walk.at);
            if (leave > t && number >= 0) add(s, scene_.voxel(leaf, number), at, t, leave);
            t = std::max(t, leave);
            if (leave >= t_end || !walk.advance(lo, hi)) break;
        }
    }

    void add(RayState& s, const PreviewVoxel& v, Vec3i leaf, double t, double leave) const {
        const Vec3f k = Vec3f{static_cast<float>(v.depth[0]), static_cast<float>(v.depth[1]),
                              static_cast<float>(v.depth[2])} *
                        (preview::kMaxDepth / 255.0f);
        const bool flat = !v.is_fiber() && v.width < kFlatWidth;
        const float hidden =
            s.through *
            (flat ? hidden_by_sheet(s, v, k, t, leave)
                  : 1.0f - std::exp(-heddle::length(k * s.weight) * static_cast<float>(leave - t)));
        // the light is at the eye: a voxel behind others is in their shadow
        const float light = options_.color == PreviewColor::Albedo ? 0.5f + 0.5f * s.through : 1.0f;
        s.color = s.color + shade(v, leaf) * (hidden * light);
        s.through -= hidden;
    }

    /// Returns the opacity of a voxel of a flat surface: the projected area of the surface, A n d,
    /// over that of the voxel, where A n_a = c_a h^2 along each axis. It does not depend on where
    /// the ray enters the voxel. Voxels of one surface share the ray: the next voxel does not cover
    /// again what the one before it covered. A slanted surface that is rendered as a medium would
    /// have a hole wherever it passes from one layer of voxels to the next.
    float
    hidden_by_sheet(RayState& s, const PreviewVoxel& v, Vec3f k, double t, double leave) const {
        float surface = 0.0f;
        float voxel = 0.0f;
        for (int a = 0; a < 3; ++a) {
            const float c = 1.0f - std::exp(-k[a]);
            surface += (v.is_negative(a) ? -c : c) * s.weight[a];
            voxel += std::abs(s.weight[a]);
        }
        const float opaque = kClosing * std::abs(surface) / voxel;
        const Vec3d h = scene_.voxel_size();
        if (t > s.sheet_end + double{kSheetGap} * std::min({h.x, h.y, h.z})) s.sheet_left = 1.0f;
        s.sheet_end = leave;
        const float left = std::max(0.0f, s.sheet_left - opaque);
        const float hidden = s.sheet_left > 0.0f ? 1.0f - left / s.sheet_left : 1.0f;
        s.sheet_left = left;
        return hidden;
    }

    [[nodiscard]] Vec3f shade(const PreviewVoxel& v, Vec3i leaf) const {
        const Vec3f axis =
            normalize(Vec3f{static_cast<float>(v.axis[0]), static_cast<float>(v.axis[1]),
                            static_cast<float>(v.axis[2])});
        switch (options_.color) {
        case PreviewColor::Albedo: return lit(v, axis);
        case PreviewColor::Tangent: return {axis.x * axis.x, axis.y * axis.y, axis.z * axis.z};
        case PreviewColor::Width: return heat(static_cast<float>(v.width) / 255.0f);
        case PreviewColor::Material: return palette(v.material);
        case PreviewColor::Block:
            return palette(hash64(static_cast<std::uint32_t>(leaf.x >> 2),
                                  static_cast<std::uint32_t>(leaf.y >> 2),
                                  static_cast<std::uint32_t>(leaf.z >> 2)) %
                           97);
        }
        return {};
    }

    /// Shades a voxel by a light at the eye: the sine of the angle to a fiber's tangent [Kajiya
    /// 1989] or the cosine of that to a normal. Wide lobes depend less on the angle; narrow ones
    /// have a highlight.
    [[nodiscard]] Vec3f lit(const PreviewVoxel& v, Vec3f axis) const {
        const Vec3f root{static_cast<float>(v.color[0]) / 255.0f,
                         static_cast<float>(v.color[1]) / 255.0f,
                         static_cast<float>(v.color[2]) / 255.0f};
        const float along = std::abs(dot(axis, eye_));
        const float facing = v.is_fiber() ? std::sqrt(std::max(0.0f, 1.0f - along * along)) : along;
        const float wide = static_cast<float>(v.width) / 255.0f;
        const float f = facing + (0.75f - facing) * wide;
        const float f2 = f * f, f8 = f2 * f2 * f2 * f2;
        const float shine = 0.12f * (1.0f - wide) * f8 * f8;
        const float diffuse = 0.12f + 0.88f * f2;
        return root * root * diffuse + Vec3f{shine, shine, shine};
    }

    const PreviewVolume& scene_;
    const PreviewOptions& options_;
    Vec3f eye_;
};

void put_pixel(PreviewImage& image, std::size_t at, Vec3f color, float alpha, bool transparent) {
    if (!transparent) {
        color = color + Vec3f{1.0f, 1.0f, 1.0f} * (1.0f - alpha);
        alpha = 1.0f;
    }
    const float s = alpha > 0.0f ? 1.0f / alpha : 0.0f;
    std::uint8_t* to = image.rgba.data() + at * 4;
    for (int c = 0; c < 3; ++c) to[c] = srgb_byte(color[c] * s);
    to[3] = static_cast<std::uint8_t>(alpha * 255.0f + 0.5f);
}

void check_options(const PreviewOptions& o) {
    const auto fail = [](const std::string& what, const char* fix) {
        throw Error(ErrorCode::InvalidArgument, "preview: " + what, fix);
    };
    if (o.width < 1 || o.height < 1 || o.width > 16384 || o.height > 16384) {
        fail(str("size ", o.width, "x", o.height, " (allowed: 1 to 16384)"), "give another --size");
    }
    if (o.rays < 1 || o.rays > 8) fail(str(o.rays, " rays (allowed: 1 to 8)"), "use 1 to 3");
    if (o.up_axis < -1 || o.up_axis > 2) fail(str("up axis ", o.up_axis), "use 0, 1 or 2");
    if (!(o.field_of_view >= 0.0 && o.field_of_view < 3.0)) {
        fail(str("field of view ", o.field_of_view, " (allowed: 0 to 3 radians)"), "use 0.6");
    }
    if (!o.from) return;
    const double n = length(*o.from);
    if (!(std::isfinite(n) && n > 0.0)) {
        fail("the direction to look from has no length", "give --from x,y,z that is not 0,0,0");
    }
}

} // namespace

PreviewImage
render_preview(const VoxelLevel& source, const PreviewOptions& options, Progress& progress) {
    check_options(options);
    const PreviewVolume scene(source, options.color == PreviewColor::Tangent, progress);
    PreviewImage image{options.width, options.height, {}};
    const auto width = static_cast<std::size_t>(options.width);
    const auto height = static_cast<std::size_t>(options.height);
    image.rgba.resize(width * height * 4);
    progress.begin("draw", "rows", options.height);
    if (scene.empty()) {
        if (!options.transparent) std::fill(image.rgba.begin(), image.rgba.end(), 255);
        return image;
    }

    const Camera camera = make_camera(scene, options);
    const Painter painter(scene, options, camera.back);
    const double aspect = static_cast<double>(options.width) / options.height;
    const int n = options.rays;
    parallel_chunks(height, 4, [&](std::size_t begin, std::size_t end) {
        progress.check();
        for (std::size_t i = begin * width; i < end * width; ++i) {
            Vec3f sum;
            float alpha = 0.0f;
            for (int k = 0; k < n * n; ++k) {
                const double x = static_cast<double>(i % width) + (k % n + 0.5) / n;
                const double y = static_cast<double>(i / width) + (k / n + 0.5) / n;
                Vec3f color;
                float a = 0.0f;
                painter.trace(camera.ray(2.0 * x / options.width - 1.0,
                                         1.0 - 2.0 * y / options.height, aspect),
                              color, a);
                sum = sum + color;
                alpha += a;
            }
            const float s = 1.0f / static_cast<float>(n * n);
            put_pixel(image, i, sum * s, alpha * s, options.transparent);
        }
        progress.advance(static_cast<std::int64_t>(end - begin));
    });
    return image;
}

} // namespace heddle
