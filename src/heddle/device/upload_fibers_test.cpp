#include <heddle/device/upload_fibers.h>
#include <heddle/executor/host_executor.h>
#include <heddle/voxelize/bin_op.h>
#include <heddle/voxelize/chord/yarn_frame.h>
#include <heddle/voxelize/test_swatch.h>

#include <gtest/gtest.h>

#include <bit>
#include <vector>

namespace heddle {
namespace {

/// The results for one span, as bits.
struct SpanBits {
    std::uint64_t blocks = 0, path = 0, course = 0;
    friend bool operator==(const SpanBits&, const SpanBits&) = default;
};

/// Visits a span's pieces as bins and fibers do.
struct WalkSpan {
    FiberView fibers;
    LatticeUnits units;
    BlockRange range;
    SpanBits* out;

    HEDDLE_HD static void add(std::uint64_t& sum, double x) {
        sum = hash64(sum, std::bit_cast<std::uint64_t>(x));
    }
    HEDDLE_HD void operator()(std::size_t span) const {
        SpanBits bits;
        const FiberPiece whole = fibers.whole_span(span);
        for (std::uint32_t part = 0; part < whole.parts; ++part) {
            const FiberPiece piece = fibers.piece(pack_piece(span, part));
            for_each_block(fibers, piece, units, range, [&](int x, int y, int z) {
                bits.blocks = hash64(bits.blocks, range.number({x, y, z}));
            });
            const YarnCourse course = fibers.course(piece, units.unit);
            YarnFrame frame(LocalCubic(piece.cubic, units), course, 0.375f);
            frame.twist(course);
            const PlyFrame ply = frame.of_ply(SinCos{0.6f, 0.8f});
            for (int a = 0; a < 3; ++a)
                add(bits.path, static_cast<double>(ply.center[a] + ply.u[a]));
            add(bits.path, static_cast<double>(ply.fiber.sin + ply.migration.cos));
            add(bits.course, course.start + course.length + course.total + course.closing_turns);
            add(bits.course, fibers.reach(piece));
        }
        out[span] = bits;
    }
};

std::vector<SpanBits>
walk(executor::HostExecutor& exec, const FiberView& fibers, const LatticeUnits& units) {
    const executor::Array<SpanBits> out = exec.make<SpanBits>(fibers.span_count);
    exec.for_each(fibers.span_count,
                  WalkSpan{fibers, units, {{-40, -500, -500}, {500, 500, 70}}, out.data()});
    std::vector<SpanBits> bits(fibers.span_count);
    exec.download(std::span(bits), out.data());
    return bits;
}

/// The swatch, and closed yarns whose radius changes along them.
Geometry swatch_and_rings() {
    Geometry geometry = test::swatch();
    CurveSet rings = geometry.curves[0];
    rings.closed.assign(rings.curve_count(), 1);
    for (std::size_t i = 0; i < rings.points.size(); ++i) {
        rings.radius.push_back(0.3f + 0.01f * static_cast<float>(i % 7));
    }
    geometry.curves.push_back(CurveSet{}); // without a curve
    geometry.curves.push_back(rings);
    return geometry;
}

TEST(UploadFibers, TheCopyGivesTheSourcesBitsWithoutTheSource) {
    executor::Budget budget(std::int64_t{1} << 30);
    executor::HostExecutor exec(budget);
    std::vector<SpanBits> expected;
    DeviceFibers arrays;
    const LatticeUnits units(Lattice{{0.02, 0.05, 0.03}, 8});
    {
        const Geometry geometry = swatch_and_rings();
        const FiberSource source(geometry, piece_length_of(units), 7);
        expected = walk(exec, source.view(), units);
        arrays = upload_fibers(exec, source);
    }
    EXPECT_TRUE(walk(exec, arrays.view, units) == expected);
    EXPECT_GT(expected.size(), 1000u);
}

} // namespace
} // namespace heddle
