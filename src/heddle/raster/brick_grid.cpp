#include <heddle/raster/brick_grid.h>

#include <heddle/base/error.h>
#include <heddle/base/trig.h>
#include <heddle/raster/brick_glsl.h>
#include <heddle/slice/slice_glsl.h>
#include <heddle/voxel/z_order.h>

#include <algorithm>
#include <bit>
#include <map>

namespace heddle::raster {
namespace {

constexpr std::uint64_t kMaxBricks = std::uint64_t{1} << 25; ///< a table of 128 MiB
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 22;   ///< centres exact in single precision

struct ZOrder {
    bool operator()(const Vec3i& a, const Vec3i& b) const { return z_order_less(a, b); }
};

[[noreturn]] void too_large(const std::string& what) {
    throw Error(ErrorCode::Unsupported, "raster: " + what,
                "use larger voxels, a part (--bounds), or --backend sample");
}

} // namespace

BrickGrid::BrickGrid(const LatticeUnits& units_in, Vec3i origin_in, Vec3i first, Vec3i end)
    : origin(origin_in), voxel_lo(first - origin_in), voxel_hi(end - origin_in), units(units_in) {
    for (int a = 0; a < 3; ++a) {
        lo[a] = floor_div(voxel_lo[a], kBrickEdge);
        count[a] = floor_div(voxel_hi[a] - 1, kBrickEdge) - lo[a] + 1;
        const std::int64_t pixels = std::int64_t{std::max(-voxel_lo[a], voxel_hi[a])} * units.n;
        if (pixels > kMaxPixels) {
            too_large(str(pixels, " subvoxels along axis ", "xyz"[a], " (limit 2^22)"));
        }
    }
    if (size() > kMaxBricks) {
        too_large(str("a box of ", size(), " bricks of 8 x 8 x 8 voxels (limit 2^25)"));
    }
}

std::uint64_t BrickGrid::size() const {
    return static_cast<std::uint64_t>(count.x) * static_cast<std::uint64_t>(count.y) *
           static_cast<std::uint64_t>(count.z);
}

Vec3i BrickGrid::brick(std::uint64_t number) const {
    const auto y = static_cast<std::uint64_t>(count.y);
    const auto z = static_cast<std::uint64_t>(count.z);
    return lo + Vec3i{static_cast<std::int32_t>(number / (y * z)),
                      static_cast<std::int32_t>(number / z % y),
                      static_cast<std::int32_t>(number % z)};
}

std::uint64_t BrickGrid::number(Vec3i brick) const {
    const Vec3i b = brick - lo;
    return (static_cast<std::uint64_t>(b.x) * static_cast<std::uint64_t>(count.y) +
            static_cast<std::uint64_t>(b.y)) *
               static_cast<std::uint64_t>(count.z) +
           static_cast<std::uint64_t>(b.z);
}

void BrickGrid::set_uniforms(const opengl::Program& program) const {
    program.set("voxel_lo", voxel_lo);
    program.set("voxel_hi", voxel_hi);
    program.set("brick_lo", lo);
    program.set("brick_count", count);
    program.set("edge", units.edge);
    program.set("subvoxels", units.n);
}

opengl::Program make_mark_program() {
    const std::string shared =
        std::string(slice::kSliceGlsl) + std::string(slice::kSpanGlsl) + std::string(kBrickGlsl);
    return opengl::Program::compute("mark bricks", shared, kMarkGlsl);
}

std::vector<TouchedBlock> find_blocks(const opengl::Context& context,
                                      const opengl::Program& mark,
                                      const BrickGrid& grid,
                                      std::span<const slice::SliceChunk> chunks) {
    std::vector<std::uint32_t> marks((grid.size() + 31) / 32);
    const opengl::Buffer buffer("occupied bricks", marks.size() * sizeof(std::uint32_t));
    buffer.clear();
    grid.set_uniforms(mark);
    buffer.bind_storage(1);
    for (const slice::SliceChunk& chunk : chunks) {
        chunk.slices.bind_storage(0);
        mark.set("slice_count", chunk.count);
        mark.dispatch(chunk.count);
    }
    buffer.read(std::as_writable_bytes(std::span(marks)));
    context.check("mark bricks");

    constexpr int kBricks = kBlockVoxels / kBrickEdge;
    std::map<Vec3i, std::vector<std::uint32_t>, ZOrder> blocks;
    const Vec3i first = grid.origin; // a multiple of blocks
    for (std::size_t w = 0; w < marks.size(); ++w) {
        for (std::uint32_t word = marks[w]; word != 0; word &= word - 1) {
            const std::uint64_t number =
                w * 32 + static_cast<std::uint64_t>(std::countr_zero(word));
            const Vec3i brick = grid.brick(number);
            Vec3i block;
            for (int a = 0; a < 3; ++a) {
                block[a] = floor_div(brick[a], kBricks) + first[a] / kBlockVoxels;
            }
            blocks[block].push_back(static_cast<std::uint32_t>(number));
        }
    }
    std::vector<TouchedBlock> out;
    for (auto& [index, bricks] : blocks) out.push_back({index, std::move(bricks)});
    return out;
}

} // namespace heddle::raster
