#include <heddle/raster/segment_pass.h>

#include <heddle/raster/accumulate_glsl.h>
#include <heddle/raster/brick_glsl.h>
#include <heddle/raster/column_glsl.h>
#include <heddle/raster/compose_glsl.h>
#include <heddle/slice/segment_glsl.h>
#include <heddle/slice/slice_glsl.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace heddle::raster {
namespace {

constexpr std::size_t kGroupsOffset = 4 * sizeof(std::uint32_t); ///< in kListGlsl's Draw
constexpr std::size_t kMaxOffset = 7 * sizeof(std::uint32_t);
/// these two must equal those of kSegmentLanesGlsl and kSegmentLoopGlsl
constexpr std::uint32_t kSegmentLanes = 8;
constexpr std::uint32_t kTurns = 64;

std::string join(std::initializer_list<std::string_view> parts) {
    std::string out;
    for (const std::string_view part : parts) out += part;
    return out;
}

opengl::Program make_program(RasterPath path, Composition composition) {
    const std::string_view body =
        composition == Composition::Accumulate ? kAccumulateGlsl : kComposeGlsl;
    if (path == RasterPath::Compute) {
        return opengl::Program::compute(
            "walk slices",
            join({slice::kSegmentsInComputeGlsl, slice::kSliceGlsl, slice::kSpanGlsl, kBrickGlsl,
                  kSegmentLanesGlsl, slice::kSegmentGlsl}),
            join({slice::kSegmentRayGlsl, kRectangleGlsl, kColumnGlsl, body, kSegmentLoopGlsl}));
    }
    return opengl::Program::draw(
        "draw slices", join({slice::kSliceGlsl, slice::kSpanGlsl, kBrickGlsl}),
        join({slice::kSegmentGlsl, kRectangleGlsl, kQuadGlsl}),
        join({slice::kSegmentRayGlsl, kRectangleGlsl, kColumnGlsl, body, kFragmentGlsl}));
}

/// On llvmpipe compute takes 4 % (yarn) to 20 % (hair) less time: bench/results/raster_tables.md.
RasterPath resolve(RasterPath asked, const opengl::Context& context) {
    if (asked == RasterPath::Auto && context.is_software()) return RasterPath::Compute;
    return asked;
}

} // namespace

SegmentPass::SegmentPass(RasterPath path, Composition composition)
    : path_(path), program_(make_program(path, composition)) {
    program_.set("policy", static_cast<std::int32_t>(composition));
}

void SegmentPass::draw(const opengl::Buffer& command, const RasterWindow& window) const {
    program_.use();
    program_.set("window_lo", window.lo);
    program_.set("window_size", window.size);
    command.bind_indirect();
    command.bind_storage(4);
    for (std::int32_t axis = 0; axis < 3; ++axis) {
        program_.set("axis", axis);
        if (path_ == RasterPath::Compute) {
            walk(command);
            continue;
        }
        frame_.bind(axis == 0 ? window.size.y : window.size.x,
                    axis == 2 ? window.size.y : window.size.z);
        opengl::EmptyFramebuffer::draw_indirect();
    }
}

/// Runs as many dispatches as the largest segment needs; the first one finds out how many.
void SegmentPass::walk(const opengl::Buffer& command) const {
    std::array<std::uint32_t, 1> max_pixels{};
    command.write(std::as_bytes(std::span(max_pixels)), kMaxOffset);
    for (std::uint32_t turn = 0; turn == 0 || turn * kSegmentLanes < max_pixels[0];
         turn += kTurns) {
        program_.set("first_turn", static_cast<std::int32_t>(turn));
        program_.dispatch_indirect(kGroupsOffset);
        if (turn > 0) continue;
        opengl::finish_writes();
        command.read(std::as_writable_bytes(std::span(max_pixels)), kMaxOffset);
    }
}

SegmentResources::SegmentResources(const opengl::Context& context,
                                   RasterPath path,
                                   Composition composition)
    : composition_(composition),
      path_(resolve(path, context)),
      list_(opengl::Program::compute(
          "list slices",
          join({slice::kSliceGlsl, slice::kSpanGlsl, kBrickGlsl, kSegmentLanesGlsl}),
          kListGlsl)) {}

const SegmentPass& SegmentResources::pass(RasterPath path) {
    std::optional<SegmentPass>& pass = path == RasterPath::Compute ? compute_ : fragment_;
    if (!pass) pass.emplace(path, composition_);
    return *pass;
}

const opengl::Buffer& SegmentResources::pool(std::size_t bytes) {
    // the number of bricks varies between frames, and the whole pool is cleared for each batch
    const std::size_t held = pool_ ? pool_->byte_count() : 0;
    if (held < bytes || held > 2 * bytes) {
        pool_.reset(); // there may not be enough memory for both
        pool_.emplace("sums of bricks", bytes);
    }
    return *pool_;
}

} // namespace heddle::raster
