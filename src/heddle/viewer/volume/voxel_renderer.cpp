#include <heddle/viewer/volume/voxel_renderer.h>

#include <heddle/base/error.h>
#include <heddle/opengl/shader.h>
#include <heddle/viewer/eye_glsl.h>
#include <heddle/viewer/shader_camera.h>
#include <heddle/viewer/volume/block_edges.h>
#include <heddle/viewer/volume/voxel_glsl.h>
#include <heddle/viewer/volume/voxel_line_glsl.h>
#include <heddle/viewer/volume/voxel_table_glsl.h>
#include <heddle/viewer/volume/voxel_tables.h>
#include <heddle/viewer/volume/voxel_walk_glsl.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace heddle::viewer {
namespace {

using opengl::Program;

constexpr std::uint32_t kEdgesStorage = 14;

bool casts_shadows(const VoxelLook& look) {
    return look.shadows && look.light && look.color == VoxelColor::Shaded;
}

// A look's constants are compiled in: branches on them cost a software driver a third of its time.

std::string white_constant(const VoxelLook& look) {
    return str("const int white = ", look.white_block ? 1 : 0, ";\n");
}

std::string color_constants(const VoxelLook& look) {
    return str("const int color_mode = ", static_cast<int>(look.color),
               ";\nconst int eye_light = ", look.light ? 0 : 1,
               ";\nconst int shadows = ", casts_shadows(look) ? 1 : 0, ";\n");
}

/// The program that casts one ray per pixel.
Program ray_program(const std::string& constants) {
    const std::string fragment = constants + std::string(kVoxelEyeGlsl) +
                                 std::string(kVoxelWalkGlsl) + std::string(kVoxelShadowGlsl) +
                                 std::string(kVoxelColorGlsl) + std::string(kVoxelMainGlsl);
    return Program::draw("cast rays at voxels", kVoxelTableGlsl, kAllPixelsGlsl, fragment);
}

Program line_program(const std::string& constants) {
    const std::string shared = std::string(kVoxelTableGlsl) + std::string(kVoxelEyeGlsl);
    const std::string fragment =
        constants + std::string(kVoxelWalkGlsl) + std::string(kEdgeLineGlsl);
    return Program::draw("draw blocks of voxels", shared, kEdgeQuadGlsl, fragment);
}

/// A program for each set of constants, compiled when it is first needed.
class Programs {
public:
    explicit Programs(Program (*make)(const std::string&)) : make_(make) {}

    const Program& of(const std::string& constants) {
        const auto found = made_.find(constants);
        return found != made_.end() ? found->second
                                    : made_.emplace(constants, make_(constants)).first->second;
    }

private:
    Program (*make_)(const std::string&);
    std::map<std::string, Program> made_;
};

void check_look(const VoxelLook& look) {
    const double light = look.light ? length(*look.light) : 1.0;
    if (light > 0.0 && std::isfinite(light) && look.density_scale > 0.0 &&
        std::isfinite(look.density_scale) && std::isfinite(look.level_offset) && look.level >= -1) {
        return;
    }
    throw Error(
        ErrorCode::InvalidArgument,
        str("view: level ", look.level, ", an offset of ", look.level_offset,
            " levels, a density scale of ", look.density_scale, ", a light of length ", light),
        "use a level from -1 on, a finite offset, a scale above 0 and a light of nonzero length");
}

/// The distance from the eye to the front of a box; in perspective not behind the eye.
double distance_to(const Bounds& box, const ShaderCamera& eye) {
    double near = std::numeric_limits<double>::infinity();
    for (int c = 0; c < 8; ++c) {
        const Vec3d corner{(c & 1) != 0 ? box.hi.x : box.lo.x, (c & 2) != 0 ? box.hi.y : box.lo.y,
                           (c & 4) != 0 ? box.hi.z : box.lo.z};
        near = std::min(near, dot(eye.axes.away, corner - eye.eye));
    }
    return eye.parallel ? near : std::max(near, 0.0);
}

} // namespace

struct VoxelRenderer::Impl {
    const opengl::Context& context;
    VoxelTables tables;
    std::vector<std::array<float, 4>> list; ///< of edges
    opengl::Buffer edges;
    Programs rays{ray_program};
    Programs lines{line_program};

    Impl(const opengl::Context& on,
         std::span<const VoxelLevel* const> levels,
         const VoxelRendererOptions& options,
         Progress& progress)
        : context(on),
          tables(on, levels, options.storage_bytes, progress),
          list(edges_of_blocks(tables.blocks(), tables.block_size(), tables.middle())),
          edges("edges of blocks", std::span<const std::array<float, 4>>(list)) {}

    void set_walk(const Program& program, const ShaderCamera& eye, const VoxelLook& look) const;
};

void VoxelRenderer::Impl::set_walk(const Program& program,
                                   const ShaderCamera& eye,
                                   const VoxelLook& look) const {
    const double near = distance_to(tables.bounds(), eye);
    eye.set_uniforms(program);
    program.set("right", to_float(eye.axes.right));
    program.set("up", to_float(eye.axes.up));
    program.set("away", to_float(eye.axes.away));
    program.set("start", to_float(eye.eye + eye.axes.away * near - tables.middle()));
    program.set("near", static_cast<float>(near));
    program.set("box_lo", to_float(tables.bounds().lo - tables.middle()));
    program.set("box_hi", to_float(tables.bounds().hi - tables.middle()));
    const int last = tables.level_count() - 1;
    const int only = std::clamp(look.level, tables.first_level(), last);
    program.set("level_first", look.level < 0 ? tables.first_level() : only);
    program.set("level_last", look.level < 0 ? last : only);
    program.set("level_reach", static_cast<float>(std::exp2(-look.level_offset)));
    program.set("density_scale", static_cast<float>(look.density_scale));
    program.set("white_block", look.white_block.value_or(Vec3i{}));
}

VoxelRenderer::VoxelRenderer(const opengl::Context& context,
                             std::span<const VoxelLevel* const> levels,
                             const VoxelRendererOptions& options,
                             Progress& progress)
    : scene_(std::make_unique<Impl>(context, levels, options, progress)) {}

VoxelRenderer::~VoxelRenderer() = default;

void VoxelRenderer::draw(const RenderTarget& target,
                         const CameraParameters& camera,
                         const VoxelLook& look) const {
    check_look(look);
    const ShaderCamera eye(camera, target.width(), target.height(), 1.0);
    if (scene_->tables.empty()) return;
    target.begin();
    scene_->tables.bind();
    const Program& rays = scene_->rays.of(color_constants(look) + white_constant(look));
    scene_->set_walk(rays, eye, look);
    const Vec3d to_eye = eye.axes.away * -1.0;
    rays.set("to_eye", to_float(to_eye));
    rays.set("to_light", to_float(normalize(look.light.value_or(to_eye))));
    rays.use();
    RenderTarget::draw_all();
    scene_->context.check("cast rays at voxels");
    if (look.blocks) draw_blocks(target, camera, look);
}

void VoxelRenderer::draw_blocks(const RenderTarget& target,
                                const CameraParameters& camera,
                                const VoxelLook& look) const {
    check_look(look);
    if (scene_->tables.empty()) return;
    const ShaderCamera eye(camera, target.width(), target.height(), 1.0);
    target.begin();
    scene_->tables.bind();
    const Program& lines = scene_->lines.of(white_constant(look));
    scene_->set_walk(lines, eye, look);
    lines.set("block_size", to_float(scene_->tables.block_size()));
    scene_->edges.bind_storage(kEdgesStorage);
    lines.use();
    RenderTarget::draw_quads(static_cast<std::uint32_t>(scene_->list.size()));
    scene_->context.check("draw blocks");
}

std::optional<Vec3i> VoxelRenderer::block_at(const CameraParameters& camera,
                                             std::int32_t width,
                                             std::int32_t height,
                                             double x,
                                             double y) const {
    const ShaderCamera eye(camera, width, height, 1.0);
    const Vec3d aside = eye.axes.right * ((x - 0.5 * width) * eye.pixel) +
                        eye.axes.up * ((0.5 * height - y) * eye.pixel);
    const Vec3d from = eye.parallel ? eye.eye + aside : eye.eye;
    const Vec3d way = eye.parallel ? eye.axes.away : eye.axes.away + aside;
    const Vec3d size = scene_->tables.block_size();
    const Vec3d per{1.0 / size.x, 1.0 / size.y, 1.0 / size.z};
    return first_block(scene_->tables.blocks(), from * per, way * per, eye.parallel);
}

void VoxelRenderer::bind_tables() const {
    scene_->tables.bind();
}

const VoxelTables& VoxelRenderer::tables() const {
    return scene_->tables;
}

Ball VoxelRenderer::ball() const {
    const Bounds& box = scene_->tables.finest_bounds();
    if (box.empty()) return {};
    return {(box.lo + box.hi) * 0.5, 0.5 * length(box.size())};
}

} // namespace heddle::viewer
