#include <heddle/viewer/slice/slice_view.h>

#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/opengl/empty_frame.h>
#include <heddle/slice/slab_glsl.h>
#include <heddle/slice/slice_glsl.h>
#include <heddle/viewer/eye_glsl.h>
#include <heddle/viewer/slice/seen_slices.h>
#include <heddle/viewer/slice/view_glsl.h>
#include <heddle/viewer/slice/view_sections.h>
#include <heddle/viewer/slice/weighted_blend.h>
#include <heddle/viewer/volume/voxel_table_glsl.h>
#include <heddle/viewer/volume/voxel_tables.h>
#include <heddle/viewer/volume/voxel_view.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace heddle::viewer {
namespace {

using opengl::Buffer;
using opengl::Program;

constexpr std::uint32_t kNothing = 0xffffffff; ///< of a depth map: all is lit
constexpr double kDepths = 16777215.0;         ///< that it tells apart

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

/// Slabs as quads, and fragments of these parts.
Program slab_program(const char* name, std::initializer_list<std::string_view> fragment) {
    const std::string shared =
        std::string(slice::kSliceGlsl) + std::string(slice::kSpanGlsl) + std::string(kEyeGlsl);
    const std::string vertex =
        std::string(slice::kStretchGlsl) + std::string(kAcrossGlsl) + std::string(kSeenQuadGlsl);
    std::string body = std::string(slice::kSlabGlsl) + std::string(kOpacityGlsl);
    for (const std::string_view part : fragment) body += part;
    return Program::draw(name, shared, vertex, body);
}

/// Slabs with colours of voxels.
struct GridPrograms {
    Program over = slab_program("color slices",
                                {kDepthGlsl, kVoxelTableGlsl, kGridGlsl, kShadeGlsl, kOverGlsl});
    Program weigh = slab_program("weigh colors",
                                 {kDepthGlsl, kVoxelTableGlsl, kGridGlsl, kShadeGlsl, kWeighGlsl});
};

/// A map of another size than the picture is drawn whole.
class ScissorOff {
public:
    ScissorOff() : was_(glIsEnabled(GL_SCISSOR_TEST)) { glDisable(GL_SCISSOR_TEST); }
    ~ScissorOff() {
        if (was_ == GL_TRUE) glEnable(GL_SCISSOR_TEST);
    }
    ScissorOff(const ScissorOff&) = delete;
    ScissorOff& operator=(const ScissorOff&) = delete;

private:
    GLboolean was_;
};

/// Where the driver's memory is the host's, it gives more than is there: so many slices at most. 0: no limit.
double most_slices(const opengl::Context& context) {
    if (!context.is_software()) return 0.0;
    const auto each = static_cast<double>(sizeof(slice::PlacedSlice)) + kSeenBytes;
    return 0.9 * static_cast<double>(available_bytes()) / each;
}

void check_look(const SliceLook& look) {
    if (look.opacity > 0.0 && length(look.light) > 0.0 && look.map_size >= 16 &&
        look.map_size <= 8192) {
        return;
    }
    throw Error(ErrorCode::InvalidArgument,
                str("view: opacity ", look.opacity, ", a shadow map of ", look.map_size,
                    " pixels, a light of length ", length(look.light)),
                "use an opacity above 0, a map of 16 to 8192 pixels and a light of any length "
                "but 0");
}

} // namespace

struct SliceView::Scene {
    const opengl::Context& context;
    SliceViewOptions options;
    Geometry geometry;
    Ball ball;
    double pixel = 0.0; ///< that slices were placed for, scene units
    LatticeUnits units;
    slice::SectionLayers layers;
    ViewSections sections;
    opengl::EmptyFrame frame;
    std::optional<SeenSlices> slices;
    Program nearest = slab_program("find what is nearest", {kDepthGlsl, kNearestGlsl});
    Program over = slab_program("shade slices", {kDepthGlsl, kNoGridGlsl, kShadeGlsl, kOverGlsl});
    Program weigh = slab_program("weigh slices", {kDepthGlsl, kNoGridGlsl, kShadeGlsl, kWeighGlsl});
    std::optional<GridPrograms> grid; ///< made when they are asked for

    struct ShadowMap {
        Vec3d light; ///< that it was drawn for
        double opacity;
        Ball over; ///< what it covers
        Buffer depths;
    };
    std::map<std::int32_t, ShadowMap> shadows; ///< by size
    std::optional<Buffer> front;               ///< what is nearest to the eye
    std::optional<WeightedBlend> blend;
    std::int32_t blend_width = 0, blend_height = 0;

    Scene(const opengl::Context& on, Geometry what, const SliceViewOptions& asked)
        : context(on),
          options(asked),
          geometry(std::move(what)),
          layers(slice::build_sections(geometry, asked.seed)),
          sections(layers, bake_light(geometry, layers)) {}

    [[nodiscard]] Vec3d middle() const { return ball.middle * (1.0 / units.unit); }
    void place(double asked_pixel);
    void set_common(const Program& program, const EyeFrame& eye, const SliceLook& look) const;
    void set_light(const Program& program, const EyeFrame& eye, const SliceLook& look) const;
    /// Least depth of anything in a map over `part`, units.
    [[nodiscard]] double shadow_depth(const Ball& part) const {
        return -(ball.radius + length(part.middle - ball.middle)) / units.unit;
    }
    void set_depths(const Program& program, double shift) const;
    void draw_nearest(const EyeFrame& eye, const SliceLook& look, double shift, const Buffer& map);
    [[nodiscard]] Ball shadowed_part(const CameraView& camera, double aspect) const;
    void draw_shadows(const SliceLook& look, const Ball& part);
    void set_grid(const Program& program,
                  const EyeFrame& eye,
                  const SliceLook& look,
                  const VoxelView& voxels) const;
    void draw_weighted(const ViewTarget& target,
                       const Program& program,
                       const EyeFrame& eye,
                       const SliceLook& look);
};

void SliceView::Scene::place(double asked_pixel) {
    const LatticeUnits next(
        {.voxel_size = {asked_pixel, asked_pixel, asked_pixel}, .subvoxels = 1});
    const std::int64_t each = kSeenBytes + static_cast<std::int64_t>(sizeof(slice::PlacedSlice));
    const auto part = static_cast<std::int64_t>(sizeof(slice::PlacedSlice));
    std::vector<slice::SliceChunk> chunks =
        slice::place_slices(context, geometry, layers, next,
                            {.most_slices = most_slices(context),
                             .chunk_bytes = options.memory_bytes / each * part,
                             .lattice = false});
    if (chunks.empty()) {
        throw Error(ErrorCode::Unsupported,
                    str("view: no curve of '", geometry.name, "' has any length"),
                    "give curves of two points or more");
    }
    slices.emplace(std::move(chunks));
    context.check("place slices");
    units = next;
    pixel = asked_pixel;
    shadows.clear();
}

void SliceView::Scene::set_common(const Program& program,
                                  const EyeFrame& eye,
                                  const SliceLook& look) const {
    program.use();
    eye.set_uniforms(program);
    program.set("section_size", static_cast<float>(layers.size));
    program.set("opacity", static_cast<float>(look.opacity));
    sections.bind();
}

/// Depths from `shift` on, as far as anything in a map can lie.
void SliceView::Scene::set_depths(const Program& program, double shift) const {
    program.set("depth_scale", static_cast<float>(kDepths * units.unit / (4.0 * ball.radius)));
    program.set("depth_shift", static_cast<float>(shift));
}

void SliceView::Scene::draw_nearest(const EyeFrame& eye,
                                    const SliceLook& look,
                                    double shift,
                                    const Buffer& map) {
    map.clear(kNothing);
    opengl::finish_writes();
    for (std::size_t c = 0; c < slices->chunk_count(); ++c) {
        const std::uint32_t slabs = slices->see(c, eye, middle(), false);
        set_common(nearest, eye, look);
        set_depths(nearest, shift);
        map.bind_storage(4);
        frame.bind(eye.width, eye.height);
        ViewTarget::draw_quads(slabs);
    }
    opengl::finish_writes();
}

/// What the shadow map has to cover: all, or where little of that is seen, what lies around the target; it moves
/// and grows in steps, so that a moving view seldom needs another.
Ball SliceView::Scene::shadowed_part(const CameraView& camera, double aspect) const {
    const double height = camera.orthographic ? camera.view_height
                                              : 2.0 * std::tan(0.5 * camera.view_angle) *
                                                    length(camera.eye - camera.target);
    const double seen = height * std::max(1.0, aspect);
    const double radius = ball.radius * std::exp2(std::ceil(std::log2(seen / ball.radius)));
    if (radius >= ball.radius) return ball;
    Ball out{{}, radius};
    for (int a = 0; a < 3; ++a) {
        const double step = 0.25 * radius;
        out.middle[a] = std::round(camera.target[a] / step) * step;
    }
    return out;
}

void SliceView::Scene::draw_shadows(const SliceLook& look, const Ball& part) {
    const auto at = shadows.find(look.map_size);
    if (at != shadows.end() && at->second.light == look.light &&
        at->second.opacity == look.opacity && at->second.over == part) {
        return;
    }
    const auto pixels = static_cast<std::size_t>(look.map_size);
    if (at != shadows.end()) shadows.erase(at);
    ShadowMap map{look.light, look.opacity, part,
                  Buffer("the shadow map", pixels * pixels * sizeof(std::uint32_t))};
    const ScissorOff whole;
    const EyeFrame eye(part, look.light, look.map_size, units.unit);
    draw_nearest(eye, look, shadow_depth(part), map.depths);
    shadows.emplace(look.map_size, std::move(map));
}

void SliceView::Scene::set_light(const Program& program,
                                 const EyeFrame& eye,
                                 const SliceLook& look) const {
    const Ball part = look.shadows ? shadows.at(look.map_size).over : ball;
    const EyeFrame map(part, look.light, look.map_size, units.unit);
    const auto seen = [&](Vec3d v, double factor) { return to_float(eye.axes.of(v) * factor); };
    program.set("to_light", seen(normalize(look.light), 1.0));
    program.set("light_right", seen(map.axes.right, 1.0 / map.pixel));
    program.set("light_up", seen(map.axes.up, 1.0 / map.pixel));
    program.set("light_away", seen(map.axes.away, 1.0));
    program.set("light_middle", eye.seen(map.eye));
    program.set("light_pixel", static_cast<float>(map.pixel));
    program.set("shadow_size", look.shadows ? look.map_size : 0);
    program.set("occlusion", look.occlusion ? 1 : 0);
    program.set("color_mode", static_cast<std::int32_t>(look.color));
    program.set("world_x", seen({1.0, 0.0, 0.0}, 1.0));
    program.set("world_y", seen({0.0, 1.0, 0.0}, 1.0));
    program.set("world_z", seen({0.0, 0.0, 1.0}, 1.0));
    set_depths(program, shadow_depth(part));
    if (look.shadows) shadows.at(look.map_size).depths.bind_storage(4);
}

void SliceView::Scene::set_grid(const Program& program,
                                const EyeFrame& eye,
                                const SliceLook& look,
                                const VoxelView& voxels) const {
    constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::min();
    program.set("eye_place", to_float(eye.eye * units.unit));
    program.set("unit", static_cast<float>(units.unit));
    program.set("block_edge", to_float(voxels.tables().block_size()));
    program.set("white_block", look.white_block.value_or(Vec3i{kNone, kNone, kNone}));
    voxels.bind_tables();
}

void SliceView::Scene::draw_weighted(const ViewTarget& target,
                                     const Program& program,
                                     const EyeFrame& eye,
                                     const SliceLook& look) {
    if (!blend || blend_width != eye.width || blend_height != eye.height) {
        blend.emplace(eye.width, eye.height);
        front.emplace("what is nearest", sizeof(std::uint32_t) *
                                             static_cast<std::size_t>(eye.width) *
                                             static_cast<std::size_t>(eye.height));
        blend_width = eye.width;
        blend_height = eye.height;
    }
    const double first = length(middle() - eye.eye) - ball.radius / units.unit;
    draw_nearest(eye, look, first, *front);
    blend->begin();
    for (std::size_t c = 0; c < slices->chunk_count(); ++c) {
        const std::uint32_t slabs = slices->see(c, eye, middle(), false);
        set_common(program, eye, look);
        set_light(program, eye, look);
        program.set("eye_scale", static_cast<float>(kDepths * units.unit / (4.0 * ball.radius)));
        program.set("eye_shift", static_cast<float>(first));
        front->bind_storage(5);
        ViewTarget::draw_quads(slabs);
    }
    blend->resolve(target);
}

SliceView::SliceView(const opengl::Context& context,
                     Geometry geometry,
                     const SliceViewOptions& options) {
    const Ball ball = ball_of(geometry);
    if (!geometry.meshes.empty() || !(ball.radius > 0.0)) {
        throw Error(ErrorCode::Unsupported,
                    str("view: '", geometry.name, "' has meshes, or no yarn and hair at all"),
                    "look at its .vdb");
    }
    merge_materials(geometry);
    scene_ = std::make_unique<Scene>(context, std::move(geometry), options);
    scene_->ball = ball;
    scene_->place(options.pixel > 0.0 ? options.pixel : 2.0e-3 * ball.radius);
}

SliceView::~SliceView() = default;

void SliceView::place(Geometry geometry) {
    const Ball ball = ball_of(geometry);
    merge_materials(geometry);
    std::swap(scene_->geometry, geometry);
    try {
        scene_->place(scene_->pixel);
    } catch (...) {
        std::swap(scene_->geometry, geometry);
        throw;
    }
    scene_->ball = ball;
}

void SliceView::fit(double pixel) {
    const double ratio = pixel / scene_->pixel;
    if (ratio > 4.0 || ratio < 0.25) scene_->place(pixel);
}

std::int64_t SliceView::slice_count() const {
    return scene_->slices->slice_count();
}

Ball SliceView::ball() const {
    return scene_->ball;
}

bool SliceView::is_split() const {
    return scene_->slices->chunk_count() > 1;
}

void SliceView::draw(const ViewTarget& target,
                     const CameraView& camera,
                     const SliceLook& look,
                     const VoxelView* grid,
                     SliceTimes* times) {
    using Clock = std::chrono::steady_clock;
    check_look(look);
    const bool of_grid = look.color == SliceColor::Grid;
    if (of_grid && grid == nullptr) {
        throw Error(ErrorCode::InvalidArgument, "view: no voxels are there to take colors from",
                    "voxelize first, or use another color");
    }
    Scene& s = *scene_;
    const EyeFrame eye(camera, target.width(), target.height(), s.units.unit);
    const auto start = Clock::now();
    const auto waited = [&](const char* stage) {
        if (times == nullptr) return Clock::time_point{};
        glFinish();
        s.context.check(stage);
        return Clock::now();
    };
    if (look.shadows) {
        const double aspect =
            static_cast<double>(target.width()) / static_cast<double>(target.height());
        s.draw_shadows(look, s.shadowed_part(camera, aspect));
    }
    const auto shadowed = waited("shadows");
    auto sorted = shadowed;
    const bool weighted = look.weighted || is_split();
    if (of_grid && !s.grid) s.grid.emplace();
    const Program& program =
        of_grid ? (weighted ? s.grid->weigh : s.grid->over) : (weighted ? s.weigh : s.over);
    if (of_grid) s.set_grid(program, eye, look, *grid);
    if (weighted) {
        s.draw_weighted(target, program, eye, look);
    } else {
        const std::uint32_t slabs = s.slices->see(0, eye, s.middle(), look.sorted);
        sorted = waited("sort slices");
        target.begin();
        s.set_common(program, eye, look);
        s.set_light(program, eye, look);
        ViewTarget::draw_quads(slabs);
    }
    const auto drawn = waited("draw slices");
    if (times == nullptr) return;
    const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    *times = {seconds(sorted - shadowed), seconds(shadowed - start), seconds(drawn - sorted)};
}

} // namespace heddle::viewer
