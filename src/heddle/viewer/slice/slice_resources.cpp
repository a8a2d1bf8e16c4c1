#include <heddle/viewer/slice/slice_resources.h>

#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/slice/segment_glsl.h>
#include <heddle/slice/slice_glsl.h>
#include <heddle/viewer/eye_glsl.h>
#include <heddle/viewer/slice/view_glsl.h>
#include <heddle/viewer/volume/voxel_renderer.h>
#include <heddle/viewer/volume/voxel_table_glsl.h>
#include <heddle/viewer/volume/voxel_tables.h>

#include <epoxy/gl.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace heddle::viewer {
namespace {

using opengl::Buffer;
using opengl::Program;

constexpr std::uint32_t kNothing = 0xffffffff; ///< in a depth map: all is lit
constexpr double kDepths = 16777215.0;         ///< number of depths that it distinguishes

/// A program that draws segments as quads, with a fragment shader of these parts.
Program segment_program(const char* name, std::initializer_list<std::string_view> fragment) {
    const std::string shared =
        std::string(slice::kSliceGlsl) + std::string(slice::kSpanGlsl) + std::string(kEyeGlsl);
    const std::string vertex = std::string(slice::kSegmentGlsl) + std::string(kSeenQuadGlsl);
    std::string body = std::string(slice::kSegmentRayGlsl) + std::string(kOpacityGlsl);
    for (const std::string_view part : fragment) body += part;
    return Program::draw(name, shared, vertex, body);
}

/// Turns the row limit off: a map of another size than the picture is drawn as a whole.
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

/// If the driver's memory is that of the host, it reports more than it has; this limits the slices.
/// 0: no limit.
double most_slices(const opengl::Context& context) {
    if (!context.is_software()) return 0.0;
    const auto each = static_cast<double>(sizeof(slice::PlacedSlice)) + kSortedSliceBytes;
    return 0.9 * static_cast<double>(available_bytes()) / each;
}

} // namespace

SegmentPrograms::SegmentPrograms()
    : nearest(segment_program("find what is nearest", {kDepthGlsl, kNearestGlsl})),
      over(segment_program("shade slices", {kDepthGlsl, kNoGridGlsl, kShadeGlsl, kOverGlsl})),
      weigh(segment_program("weigh slices", {kDepthGlsl, kNoGridGlsl, kShadeGlsl, kWeighGlsl})) {}

GridPrograms::GridPrograms()
    : over(segment_program("color slices",
                           {kDepthGlsl, kVoxelTableGlsl, kGridGlsl, kShadeGlsl, kOverGlsl})),
      weigh(segment_program("weigh colors",
                            {kDepthGlsl, kVoxelTableGlsl, kGridGlsl, kShadeGlsl, kWeighGlsl})) {}

void SliceResources::place(double asked_pixel) {
    const LatticeUnits next(
        {.voxel_size = {asked_pixel, asked_pixel, asked_pixel}, .subvoxels = 1});
    const std::int64_t each =
        kSortedSliceBytes + static_cast<std::int64_t>(sizeof(slice::PlacedSlice));
    const auto part = static_cast<std::int64_t>(sizeof(slice::PlacedSlice));
    const std::int64_t chunk = options.memory_bytes > 0
                                   ? std::max(options.memory_bytes / each, std::int64_t{1}) * part
                                   : 0;
    std::vector<slice::SliceChunk> chunks = slice::place_slices(
        context, geometry, layers, next,
        {.most_slices = most_slices(context), .chunk_bytes = chunk, .lattice = false});
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

void SliceResources::set_common(const Program& program,
                                const ShaderCamera& eye,
                                const SliceLook& look) const {
    program.use();
    eye.set_uniforms(program);
    program.set("section_size", static_cast<float>(layers.size));
    program.set("opacity", static_cast<float>(look.opacity));
    sections.bind();
}

/// Sets the depths from `shift` on, as far as anything in a map can be.
void SliceResources::set_depths(const Program& program, double shift) const {
    program.set("depth_scale", static_cast<float>(kDepths * units.unit / (4.0 * ball.radius)));
    program.set("depth_shift", static_cast<float>(shift));
}

void SliceResources::draw_nearest(const ShaderCamera& eye,
                                  const SliceLook& look,
                                  double shift,
                                  const Buffer& map) {
    map.clear(kNothing);
    opengl::finish_writes();
    for (std::size_t c = 0; c < slices->chunk_count(); ++c) {
        const std::uint32_t segments = slices->see(c, eye, middle(), false);
        set_common(programs.nearest, eye, look);
        set_depths(programs.nearest, shift);
        map.bind_storage(4);
        frame.bind(eye.width, eye.height);
        RenderTarget::draw_quads(segments);
    }
    opengl::finish_writes();
}

/// The part that the shadow map covers: all or, if only a small part is visible, the surroundings
/// of the target. It moves and grows in steps, so that a moving view rarely needs a new map.
Ball SliceResources::shadowed_part(const CameraParameters& camera, double aspect) const {
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

void SliceResources::draw_shadows(const SliceLook& look, const Ball& part) {
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
    const ShaderCamera eye(part, look.light, look.map_size, units.unit);
    draw_nearest(eye, look, shadow_depth(part), map.depths);
    shadows.emplace(look.map_size, std::move(map));
}

void SliceResources::set_light(const Program& program,
                               const ShaderCamera& eye,
                               const SliceLook& look) const {
    const Ball part = look.shadows ? shadows.at(look.map_size).over : ball;
    const ShaderCamera map(part, look.light, look.map_size, units.unit);
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

void SliceResources::set_grid(const Program& program,
                              const ShaderCamera& eye,
                              const SliceLook& look,
                              const VoxelRenderer& voxels) const {
    constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::min();
    program.set("eye_position", to_float(eye.eye * units.unit));
    program.set("unit", static_cast<float>(units.unit));
    program.set("block_edge", to_float(voxels.tables().block_size()));
    program.set("white_block", look.white_block.value_or(Vec3i{kNone, kNone, kNone}));
    voxels.bind_tables();
}

void SliceResources::draw_weighted(const RenderTarget& target,
                                   const Program& program,
                                   const ShaderCamera& eye,
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
        const std::uint32_t segments = slices->see(c, eye, middle(), false);
        set_common(program, eye, look);
        set_light(program, eye, look);
        program.set("eye_scale", static_cast<float>(kDepths * units.unit / (4.0 * ball.radius)));
        program.set("eye_shift", static_cast<float>(first));
        front->bind_storage(5);
        RenderTarget::draw_quads(segments);
    }
    blend->resolve(target);
}

void SliceResources::draw_sorted(const RenderTarget& target,
                                 const Program& program,
                                 const ShaderCamera& eye,
                                 const SliceLook& look,
                                 std::uint32_t segments) {
    target.begin();
    set_common(program, eye, look);
    set_light(program, eye, look);
    RenderTarget::draw_quads(segments);
}

const Program& SliceResources::program_for(const SliceLook& look,
                                           bool weighted,
                                           const ShaderCamera& eye,
                                           const VoxelRenderer* grid) {
    if (look.color != SliceColor::Grid) return weighted ? programs.weigh : programs.over;
    if (!grid_programs) grid_programs.emplace();
    const Program& program = weighted ? grid_programs->weigh : grid_programs->over;
    set_grid(program, eye, look, *grid);
    return program;
}

} // namespace heddle::viewer
