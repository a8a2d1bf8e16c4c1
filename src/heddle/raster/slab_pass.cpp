#include <heddle/raster/slab_pass.h>

#include <heddle/raster/accumulate_glsl.h>
#include <heddle/raster/brick_glsl.h>
#include <heddle/raster/column_glsl.h>
#include <heddle/raster/compose_glsl.h>
#include <heddle/slice/slab_glsl.h>
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
/// these two must equal those of kSlabLanesGlsl and kSlabLoopGlsl
constexpr std::uint32_t kSlabLanes = 8;
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
            join({slice::kSlabsInComputeGlsl, slice::kSliceGlsl, slice::kSpanGlsl, kBrickGlsl,
                  kSlabLanesGlsl, slice::kStretchGlsl}),
            join({slice::kSlabGlsl, kRectangleGlsl, kColumnGlsl, body, kSlabLoopGlsl}));
    }
    return opengl::Program::draw(
        "draw slices", join({slice::kSliceGlsl, slice::kSpanGlsl, kBrickGlsl}),
        join({slice::kStretchGlsl, kRectangleGlsl, kQuadGlsl}),
        join({slice::kSlabGlsl, kRectangleGlsl, kColumnGlsl, body, kFragmentGlsl}));
}

/// On llvmpipe compute takes 4 % (yarn) to 20 % (hair) less time: bench/results/raster_tables.md.
RasterPath resolve(RasterPath asked, const opengl::Context& context) {
    if (asked == RasterPath::Auto && context.is_software()) return RasterPath::Compute;
    return asked;
}

} // namespace

SlabPass::SlabPass(RasterPath path, Composition composition)
    : path_(path), program_(make_program(path, composition)) {
    program_.set("policy", static_cast<std::int32_t>(composition));
}

void SlabPass::draw(const opengl::Buffer& command, const RasterWindow& view) const {
    program_.use();
    program_.set("view_lo", view.lo);
    program_.set("view_size", view.size);
    command.bind_indirect();
    command.bind_storage(4);
    for (std::int32_t axis = 0; axis < 3; ++axis) {
        program_.set("axis", axis);
        if (path_ == RasterPath::Compute) {
            walk(command);
            continue;
        }
        frame_.bind(axis == 0 ? view.size.y : view.size.x, axis == 2 ? view.size.y : view.size.z);
        opengl::EmptyFramebuffer::draw_indirect();
    }
}

/// Runs as many dispatches as the largest slab needs; the first one finds out how many.
void SlabPass::walk(const opengl::Buffer& command) const {
    std::array<std::uint32_t, 1> most{};
    command.write(std::as_bytes(std::span(most)), kMaxOffset);
    for (std::uint32_t turn = 0; turn == 0 || turn * kSlabLanes < most[0]; turn += kTurns) {
        program_.set("first_turn", static_cast<std::int32_t>(turn));
        program_.dispatch_indirect(kGroupsOffset);
        if (turn > 0) continue;
        opengl::finish_writes();
        command.read(std::as_writable_bytes(std::span(most)), kMaxOffset);
    }
}

SlabResources::SlabResources(const opengl::Context& context,
                             RasterPath path,
                             Composition composition)
    : composition_(composition),
      path_(resolve(path, context)),
      list_(opengl::Program::compute(
          "list slices",
          join({slice::kSliceGlsl, slice::kSpanGlsl, kBrickGlsl, kSlabLanesGlsl}),
          kListGlsl)) {}

const SlabPass& SlabResources::pass(RasterPath path) {
    std::optional<SlabPass>& pass = path == RasterPath::Compute ? compute_ : fragment_;
    if (!pass) pass.emplace(path, composition_);
    return *pass;
}

const opengl::Buffer& SlabResources::pool(std::size_t bytes) {
    // the number of bricks varies between frames, and the whole pool is cleared for each batch
    const std::size_t held = pool_ ? pool_->byte_count() : 0;
    if (held < bytes || held > 2 * bytes) {
        pool_.reset(); // there may not be enough memory for both
        pool_.emplace("sums of bricks", bytes);
    }
    return *pool_;
}

} // namespace heddle::raster
