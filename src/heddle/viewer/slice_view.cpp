#include <heddle/viewer/slice_view.h>

#include <heddle/base/error.h>
#include <heddle/geom/slice_image.h>
#include <heddle/raster/brick_glsl.h>
#include <heddle/raster/slab_glsl.h>
#include <heddle/raster/slice_glsl.h>
#include <heddle/raster/slices.h>
#include <heddle/raster/texture.h>
#include <heddle/viewer/radix_sort.h>
#include <heddle/viewer/view_glsl.h>
#include <heddle/viewer/view_target.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>

namespace heddle::viewer {
namespace {

using raster::Buffer;
using raster::Program;

constexpr std::int32_t kShadowSize = 1024;
constexpr std::uint32_t kNothing = 0xffffffff; ///< of the shadow map: all is lit

/// Axes of a view, unit and at right angles; z away from the eye.
struct Axes {
    Vec3d right, up, away;

    Axes(Vec3d from, Vec3d upward) {
        away = normalize(from * -1.0);
        right = normalize(cross(away, upward), to_double(any_perpendicular(to_float(away))));
        up = cross(right, away);
    }
    [[nodiscard]] Vec3f of(Vec3d v) const {
        return to_float({dot(right, v), dot(up, v), dot(away, v)});
    }
};

/// Every set gets one material, whose colour goes to its points: all slices are sorted as one.
void merge_materials(Geometry& geometry) {
    for (CurveSet& set : geometry.curves) {
        const Vec3f albedo = geometry.materials[set.material].albedo;
        std::uint32_t color = 0;
        for (int c = 0; c < 3; ++c) {
            const float v = std::clamp(albedo[c], 0.0f, 1.0f) * 255.0f + 0.5f;
            color |= static_cast<std::uint32_t>(v) << (8 * c);
        }
        if (set.color.empty()) set.color.assign(set.points.size(), color);
        set.material = 0;
    }
}

/// What the section's occlusion leaves, by layer; plain fibers have none.
std::vector<std::vector<std::uint8_t>> light_of(const Geometry& geometry,
                                                const raster::SectionLayers& sections) {
    const auto n = static_cast<std::size_t>(sections.size);
    std::vector<std::vector<std::uint8_t>> out(sections.layers.size(),
                                               std::vector<std::uint8_t>(n * n, 255));
    for (std::size_t s = 0; s < geometry.curves.size(); ++s) {
        const YarnType* yarn = geometry.yarn_of(geometry.curves[s]);
        if (yarn == nullptr || yarn->model != YarnModel::Slice) continue;
        const Texture baked = bake_occlusion(*yarn);
        for (std::uint32_t l = sections.first[s]; l < sections.first[s + 1]; ++l) {
            const float extent = sections.layers[l].extent / yarn->model_radius;
            for (std::size_t i = 0; i < n * n; ++i) {
                const auto part = [&](std::size_t at) {
                    return ((static_cast<float>(at) + 0.5f) / static_cast<float>(n) * 2.0f - 1.0f) *
                           extent;
                };
                const float col = (part(i % n) + 1.0f) * 0.5f * static_cast<float>(baked.width);
                const float row = (1.0f - part(i / n)) * 0.5f * static_cast<float>(baked.height);
                if (!(col >= 0.0f && row >= 0.0f)) continue;
                const auto c = static_cast<std::int32_t>(col);
                const auto r = static_cast<std::int32_t>(row);
                if (c >= baked.width || r >= baked.height) continue;
                out[l][i] = baked.texels[static_cast<std::size_t>(r * baked.width + c)];
            }
        }
    }
    return out;
}

/// A ball around all matter.
struct Ball {
    Vec3d middle;
    double radius = 0.0;
};

Ball ball_of(const Geometry& geometry) {
    Bounds box;
    double reach = 0.0;
    for (const CurveSet& set : geometry.curves) {
        const YarnType* yarn = geometry.yarn_of(set);
        for (std::size_t i = 0; i < set.points.size(); ++i) {
            box.grow(to_double(set.points[i]));
            reach = std::max(reach, static_cast<double>(set.radius_at(i)));
        }
        if (yarn != nullptr) reach = std::max(reach, static_cast<double>(yarn->radius));
    }
    if (box.empty()) return {};
    return {(box.lo + box.hi) * 0.5, 0.5 * length(box.size()) + 1.5 * reach};
}

std::uint8_t to_srgb(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(255.0 * s + 0.5);
}

ViewImage over_white(const ViewOptions& options, const std::vector<float>& rgba) {
    ViewImage out{options.width, options.height, {}};
    const auto width = static_cast<std::size_t>(options.width);
    const auto height = static_cast<std::size_t>(options.height);
    out.rgb.resize(3 * width * height);
    for (std::size_t i = 0; i < width * height; ++i) {
        const float* from = &rgba[4 * ((height - 1 - i / width) * width + i % width)];
        for (std::size_t c = 0; c < 3; ++c) {
            out.rgb[3 * i + c] = to_srgb(static_cast<double>(from[c] + 1.0f - from[3]));
        }
    }
    return out;
}

Program slab_program(const char* name, std::string_view fragment) {
    const std::string shared = std::string(raster::kSliceGlsl) + std::string(raster::kBrickGlsl);
    return Program::draw(name, shared, raster::kQuadGlsl,
                         std::string(raster::kSlabGlsl) + std::string(kOpacityGlsl) +
                             std::string(fragment));
}

} // namespace

struct SliceView::Scene {
    const raster::Context& context;
    ViewOptions options;
    Ball ball;
    LatticeUnits units;
    std::optional<raster::SliceChunk> slices;
    std::int32_t section_size = 0;
    std::uint32_t slabs = 0;
    std::unique_ptr<ViewSections> sections;
    std::unique_ptr<raster::EmptyFrame> frame;
    std::unique_ptr<ViewTarget> target;
    std::unique_ptr<RadixSort> sort;
    std::unique_ptr<Buffer> seen;
    std::unique_ptr<Buffer> shadow;
    Program see = Program::compute("see slices", raster::kSliceGlsl, kSeeGlsl);
    Program shadow_program = slab_program("draw shadows", kShadowGlsl);
    Program shade_program = slab_program("shade slices", kShadeGlsl);

    Scene(const raster::Context& on, const ViewOptions& asked) : context(on), options(asked) {}

    void see_from(const Axes& axes, double zoom, Vec3f shift, bool sorted) const;
    void set_common(const Program& program, std::int32_t width, std::int32_t height) const;
    void draw_shadows(const Axes& light) const;
    void set_light(const Axes& view, const Axes& light, double zoom, Vec3d to_light) const;
};

void SliceView::Scene::see_from(const Axes& axes, double zoom, Vec3f shift, bool sorted) const {
    slices->slices.bind_storage(0);
    seen->bind_storage(1);
    sort->keys().bind_storage(2);
    sort->values().bind_storage(3);
    see.set("slice_count", slices->count);
    see.set("right", to_float(axes.right));
    see.set("up", to_float(axes.up));
    see.set("away", to_float(axes.away));
    see.set("middle", to_float(ball.middle * (1.0 / units.unit)));
    see.set("shift", shift);
    see.set("zoom", static_cast<float>(zoom));
    see.set("sorted", sorted ? 1 : 0);
    see.dispatch(slices->count);
    sort->sort(); // unsorted: slabs before what is none
}

void SliceView::Scene::set_common(const Program& program,
                                  std::int32_t width,
                                  std::int32_t height) const {
    constexpr std::int32_t kFar = 1 << 24;
    program.use();
    program.set("voxel_lo", Vec3i{-kFar, -kFar, -kFar});
    program.set("voxel_hi", Vec3i{kFar, kFar, kFar});
    program.set("edge", Vec3f{1.0f, 1.0f, 1.0f});
    program.set("subvoxels", 1);
    program.set("axis", 2);
    program.set("view_lo", Vec3i{});
    program.set("view_size", Vec3i{width, height, 1});
    program.set("section_size", static_cast<float>(section_size));
    program.set("opacity", static_cast<float>(options.opacity));
    program.set("shadow_size", options.shadows ? kShadowSize : 0);
    sections->bind();
    seen->bind_storage(0);
    sort->values().bind_storage(2);
    shadow->bind_storage(4);
}

void SliceView::Scene::draw_shadows(const Axes& light) const {
    const std::vector<std::uint32_t> clear(
        static_cast<std::size_t>(kShadowSize) * static_cast<std::size_t>(kShadowSize), kNothing);
    shadow->write(std::as_bytes(std::span(clear)));
    const double zoom = 0.5 * kShadowSize / (ball.radius / units.unit);
    see_from(light, zoom, {0.5f * kShadowSize, 0.5f * kShadowSize, 0.0f}, false);
    set_common(shadow_program, kShadowSize, kShadowSize);
    frame->bind(kShadowSize, kShadowSize);
    ViewTarget::draw_quads(slabs);
    raster::finish_writes();
}

void SliceView::Scene::set_light(const Axes& view,
                                 const Axes& light,
                                 double zoom,
                                 Vec3d to_light) const {
    const double shadow_zoom = 0.5 * kShadowSize / (ball.radius / units.unit);
    const double ratio = shadow_zoom / zoom; // pixels of the map a pixel
    shade_program.set("to_light", view.of(normalize(to_light)));
    shade_program.set("light_right", view.of(light.right * ratio));
    shade_program.set("light_up", view.of(light.up * ratio));
    shade_program.set("light_away", view.of(light.away * ratio));
    shade_program.set("light_shift", Vec3f{0.5f * kShadowSize, 0.5f * kShadowSize, 0.0f});
    shade_program.set("view_middle", Vec3f{0.5f * static_cast<float>(options.width),
                                           0.5f * static_cast<float>(options.height), 0.0f});
    shade_program.set("occlusion", options.occlusion ? 1 : 0);
}

SliceView::SliceView(const raster::Context& context, Geometry geometry, const ViewOptions& options)
    : scene_(std::make_unique<Scene>(context, options)) {
    constexpr std::int32_t kMost = 8192;
    if (options.width < 1 || options.height < 1 || options.width > kMost ||
        options.height > kMost || !(options.opacity > 0.0)) {
        throw Error(ErrorCode::InvalidArgument,
                    str("view: ", options.width, " x ", options.height, " pixels, opacity ",
                        options.opacity),
                    "use 1 to 8192 pixels and an opacity above 0");
    }
    Scene& s = *scene_;
    s.ball = ball_of(geometry);
    if (!geometry.meshes.empty() || !(s.ball.radius > 0.0)) {
        throw Error(ErrorCode::Unsupported,
                    str("view: '", geometry.name, "' has meshes, or no yarn and hair at all"),
                    "look at its .vdb with heddle preview");
    }
    merge_materials(geometry);
    const double pixel = 2.0 * s.ball.radius / std::min(options.width, options.height);
    s.units = LatticeUnits({.voxel_size = {pixel, pixel, pixel}, .subvoxels = 1});
    const raster::SectionLayers layers = raster::build_sections(geometry, options.seed);
    std::vector<raster::SliceChunk> chunks =
        raster::place_slices(context, geometry, layers, s.units, {});
    if (chunks.size() != 1) {
        throw Error(ErrorCode::Unsupported,
                    str("view: slices fill ", chunks.size(), " buffers of the driver (limit 1)"),
                    "look at a part, or at its .vdb with heddle preview");
    }
    s.slices = std::move(chunks[0]);
    s.section_size = layers.size;
    for (const raster::PlacedSlice& p : raster::read_slices(*s.slices)) {
        s.slabs += p.flags == 0 ? 1u : 0u;
    }
    s.sections = std::make_unique<ViewSections>(layers, light_of(geometry, layers));
    s.frame = std::make_unique<raster::EmptyFrame>();
    s.target = std::make_unique<ViewTarget>(options.width, options.height);
    s.sort = std::make_unique<RadixSort>(s.slices->count);
    s.seen = std::make_unique<Buffer>("slices in view", s.slices->slices.byte_count());
    s.shadow = std::make_unique<Buffer>("shadow map", sizeof(std::uint32_t) * kShadowSize *
                                                          static_cast<std::size_t>(kShadowSize));
    context.check("view");
}

SliceView::~SliceView() = default;

std::int64_t SliceView::slice_count() const {
    return scene_->slices->count;
}

ViewImage SliceView::draw(const ViewPose& pose, ViewTimes* times) const {
    using Clock = std::chrono::steady_clock;
    const Scene& s = *scene_;
    if (!(length(pose.from) > 0.0) || !(length(pose.light) > 0.0) || !(pose.zoom > 0.0)) {
        throw Error(ErrorCode::InvalidArgument, "view: a direction or the zoom is 0",
                    "give directions of any length but 0");
    }
    const Axes view(pose.from, pose.up);
    const Axes light(pose.light, pose.up);
    const auto start = Clock::now();
    if (s.options.shadows) {
        s.draw_shadows(light);
        s.context.check("shadows");
    }
    const auto shadowed = Clock::now();
    const Vec3f shift{0.5f * static_cast<float>(s.options.width),
                      0.5f * static_cast<float>(s.options.height), 0.0f};
    s.see_from(view, pose.zoom, shift, s.options.sorted);
    s.context.check("sort slices");
    const auto sorted = Clock::now();
    s.set_common(s.shade_program, s.options.width, s.options.height);
    s.set_light(view, light, pose.zoom, pose.light);
    s.target->begin();
    ViewTarget::draw_quads(s.slabs);
    ViewImage image = over_white(s.options, s.target->read());
    s.context.check("draw slices");
    if (times != nullptr) {
        const auto seconds = [](Clock::duration d) {
            return std::chrono::duration<double>(d).count();
        };
        *times = {seconds(sorted - shadowed), seconds(shadowed - start),
                  seconds(Clock::now() - sorted)};
    }
    return image;
}

} // namespace heddle::viewer
