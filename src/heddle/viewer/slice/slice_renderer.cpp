#include <heddle/viewer/slice/slice_renderer.h>

#include <heddle/base/error.h>
#include <heddle/geom/color.h>
#include <heddle/viewer/slice/slice_resources.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace heddle::viewer {
namespace {

/// Gives every set one material, whose colour moves to its points: all slices are sorted together.
void merge_materials(Geometry& geometry) {
    for (CurveSet& set : geometry.curves) {
        const std::uint32_t color = pack_color(geometry.materials[set.material].albedo);
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

void check_look(const SliceLook& look) {
    if (look.opacity > 0.0 && length(look.light) > 0.0 && look.map_size >= 16 &&
        look.map_size <= 8192) {
        return;
    }
    throw Error(ErrorCode::InvalidArgument,
                str("view: opacity ", look.opacity, ", a shadow map of ", look.map_size,
                    " pixels, a light of length ", length(look.light)),
                "use an opacity above 0, a map of 16 to 8192 pixels and a light of nonzero length");
}

} // namespace

SliceRenderer::SliceRenderer(const opengl::Context& context,
                             Geometry geometry,
                             const SliceRendererOptions& options) {
    const Ball ball = ball_of(geometry);
    if (!geometry.meshes.empty() || !(ball.radius > 0.0)) {
        throw Error(ErrorCode::Unsupported,
                    str("view: '", geometry.name, "' has meshes, or no yarn and hair at all"),
                    "look at its .vdb");
    }
    merge_materials(geometry);
    scene_ = std::make_unique<SliceResources>(context, std::move(geometry), options);
    scene_->ball = ball;
    scene_->place(options.pixel > 0.0 ? options.pixel : 2.0e-3 * ball.radius);
}

SliceRenderer::~SliceRenderer() = default;

void SliceRenderer::place(Geometry geometry) {
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

void SliceRenderer::fit(double pixel) {
    const double ratio = pixel / scene_->pixel;
    if (ratio > 4.0 || ratio < 0.25) scene_->place(pixel);
}

std::int64_t SliceRenderer::slice_count() const {
    return scene_->slices->slice_count();
}

Ball SliceRenderer::ball() const {
    return scene_->ball;
}

bool SliceRenderer::is_split() const {
    return scene_->slices->chunk_count() > 1;
}

void SliceRenderer::draw(const RenderTarget& target,
                         const CameraParameters& camera,
                         const SliceLook& look,
                         const VoxelRenderer* grid,
                         SliceTimes* times) {
    using Clock = std::chrono::steady_clock;
    check_look(look);
    if (look.color == SliceColor::Grid && grid == nullptr) {
        throw Error(ErrorCode::InvalidArgument, "view: no voxels are there to take colors from",
                    "voxelize first, or use another color");
    }
    SliceResources& s = *scene_;
    const ShaderCamera eye(camera, target.width(), target.height(), s.units.unit);
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
    const opengl::Program& program = s.program_for(look, weighted, eye, grid);
    if (weighted) {
        s.draw_weighted(target, program, eye, look);
    } else {
        const std::uint32_t segments = s.slices->see(0, eye, s.middle(), look.sorted);
        sorted = waited("sort slices");
        s.draw_sorted(target, program, eye, look, segments);
    }
    const auto drawn = waited("draw slices");
    if (times == nullptr) return;
    const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    *times = {seconds(sorted - shadowed), seconds(shadowed - start), seconds(drawn - sorted)};
}

} // namespace heddle::viewer
