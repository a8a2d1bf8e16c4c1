#include <heddle/slice/slices.h>

#include <heddle/base/error.h>
#include <heddle/opengl/shader.h>
#include <heddle/slice/slice_glsl.h>
#include <heddle/slice/test_slices.h>
#include <heddle/yarn/fiber_source.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace heddle::slice {
namespace {

using namespace heddle::slice::test;

LatticeUnits units_of(double voxel_size) {
    return LatticeUnits({.voxel_size = {voxel_size, voxel_size, voxel_size}, .subvoxels = 8});
}

std::vector<PlacedSlice> place(const Geometry& geometry, const LatticeUnits& units) {
    const opengl::Context context;
    const SectionLayers sections = build_sections(geometry, 0);
    std::vector<PlacedSlice> out;
    for (const SliceChunk& c : place_slices(context, geometry, sections, units, {})) {
        const std::vector<PlacedSlice> more = read_slices(c);
        EXPECT_EQ(c.segments, std::count_if(more.begin(), more.end(),
                                            [](const PlacedSlice& s) { return s.flags == 0; }));
        out.insert(out.end(), more.begin(), more.end());
    }
    return out;
}

/// A circle of radius 1 about z as a closed curve of 12 points.
Geometry ring(YarnType yarn, Basis basis = Basis::CatmullRom) {
    CurveSet set;
    set.basis = basis;
    std::vector<Vec3f> points;
    for (int i = 0; i < 12; ++i) {
        const double a = 2.0 * std::numbers::pi * i / 12.0;
        points.push_back(to_float({std::cos(a), std::sin(a), 0.3 * std::sin(2.0 * a)}));
    }
    heddle::test::add_curve(set, points, true);
    Geometry geometry = heddle::test::geometry_of(set);
    set_yarn(geometry, std::move(yarn));
    return geometry;
}

TEST(PlaceSlices, AYarnOfMorePointsThanOneDispatchMeasuresIsPlacedToItsEnd) {
    constexpr int kPoints = 70000; // software drivers end a loop after 65535 turns
    std::vector<Vec3f> points;
    for (int i = 0; i < kPoints; ++i) {
        const double a = 0.01 * i;
        points.push_back(to_float({std::cos(a), std::sin(a), 1e-4 * i}));
    }
    CurveSet set;
    heddle::test::add_curve(set, points);
    set.default_radius = 0.05f;
    Geometry geometry = heddle::test::geometry_of(set);
    const std::vector<PlacedSlice> slices = place(geometry, units_of(0.05));
    ASSERT_GT(slices.size(), static_cast<std::size_t>(kPoints - 3));
    EXPECT_EQ(slices.back().flags, 1u);
    const Vec3d end = to_double(points[kPoints - 2]); // the last one only gives a tangent
    const Vec3d last = to_double(slices.back().center) * units_of(0.05).unit;
    EXPECT_LT(length(last - end), 1e-3);
    double farthest = 0.0;
    for (std::size_t i = 1; i < slices.size(); ++i) {
        const Vec3d step = to_double(slices[i].center - slices[i - 1].center);
        farthest = std::max(farthest, length(step) * units_of(0.05).unit);
        ASSERT_LT(std::fabs(static_cast<double>(dot(slices[i].normal, slices[i].tangent))), 1e-4)
            << i;
    }
    EXPECT_LT(farthest, 0.0102) << "no gap where one dispatch ends and the next begins";
}

TEST(PlaceSlices, LieOnTheCurveInEvenStepsWithFramesOfRightAngles) {
    const LatticeUnits units = units_of(0.05);
    for (const Basis basis : {Basis::CatmullRom, Basis::CubicBSpline, Basis::Linear}) {
        const Geometry yarn = ring(slice_yarn(0.1f), basis);
        const std::vector<PlacedSlice> slices = place(yarn, units);
        ASSERT_GT(slices.size(), 60u);
        const CurveSet& set = yarn.curves[0];
        double farthest = 0.0;
        for (std::size_t i = 0; i < slices.size(); ++i) {
            const PlacedSlice& s = slices[i];
            EXPECT_NEAR(static_cast<double>(length(s.tangent)), 1.0, 1e-5);
            EXPECT_NEAR(static_cast<double>(length(s.normal)), 1.0, 1e-5);
            EXPECT_NEAR(static_cast<double>(dot(s.tangent, s.normal)), 0.0, 1e-5);
            EXPECT_EQ(s.flags, i + 1 == slices.size() ? 1u : 0u);
            double nearest = 1e9; // distance to the curve, sampled finely in double
            for (std::size_t k = 0; k < set.span_count(0); ++k) {
                for (int j = 0; j <= 200; ++j) {
                    const Vec3d p = span_cubic(set, 0, k).at(j / 200.0) * (1.0 / units.unit);
                    nearest = std::min(nearest, length(p - to_double(s.center)));
                }
            }
            farthest = std::max(farthest, nearest);
            if (i == 0) continue;
            const float step = length(s.center - slices[i - 1].center);
            EXPECT_GT(step, 0.2f);
            EXPECT_LT(step, 9.0f); // half of 16 units, plus uneven speed
        }
        EXPECT_LT(farthest, 0.3); // half a step of the fine sampling
    }
}

TEST(PlaceSlices, TwistByTheYarnsLengthInDoublePrecision) {
    YarnType yarn = slice_yarn(0.05f);
    yarn.twist = 0.7f;
    const LatticeUnits units = units_of(0.05);
    const std::vector<PlacedSlice> slices = place(straight_yarn({1.0f, 0.0f, 0.0f}, yarn), units);
    const double per_unit = 0.7 * units.unit / 0.05; // at a scale of 1 model unit = 0.05
    double worst = 0.0;
    for (const PlacedSlice& s : slices) {
        const double length = static_cast<double>(s.center.x - slices[0].center.x);
        const double turned = std::remainder(per_unit * length, 2.0 * std::numbers::pi);
        const Vec3d n0 = to_double(slices[0].normal);
        const Vec3d expected =
            std::cos(turned) * n0 + std::sin(turned) * cross({1.0, 0.0, 0.0}, n0);
        worst = std::max(worst, heddle::length(expected - to_double(s.normal)));
    }
    EXPECT_LT(worst, 2e-4);
}

TEST(PlaceSlices, TwistClosesOverAClosedYarn) {
    YarnType yarn = slice_yarn(0.1f);
    for (const float twist : {0.0f, 0.5f, -3.3f}) {
        yarn.twist = twist;
        const std::vector<PlacedSlice> slices = place(ring(yarn), units_of(0.05));
        const PlacedSlice& first = slices.front();
        const PlacedSlice& last = slices.back();
        EXPECT_LT(length(first.center - last.center), 1e-3f);
        EXPECT_LT(length(first.normal - last.normal), 2e-3f) << twist;
        double turned = 0.0;
        for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
            turned += static_cast<double>(slices[i].turn);
        }
        const double length = 6.7; // length of the ring, about
        EXPECT_NEAR(turned, static_cast<double>(twist) * length / 0.1, 6.3 + std::abs(turned) * .1);
    }
}

TEST(PlaceSlices, MoreSlicesThanWantedAndATwistWithoutEndAreOneLineEach) {
    const opengl::Context context;
    Geometry yarn = straight_yarn({1.0f, 0.0f, 0.0f}, slice_yarn(0.05f));
    const auto code = [&](double most) {
        try {
            (void)place_slices(context, yarn, build_sections(yarn, 0), units_of(0.05),
                               {.origin = {}, .most_slices = most});
        } catch (const Error& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
            return e.code();
        }
        return ErrorCode::Internal;
    };
    EXPECT_EQ(code(10.0), ErrorCode::InvalidArgument);
    yarn.yarns[0].twist = 1e9f;
    EXPECT_EQ(code(0.0), ErrorCode::InvalidArgument);
}

TEST(FiberDirection, IsEquationOneInDoublePrecisionTurnedByHalfAStep) {
    const opengl::Context context;
    struct Item {
        float x, y, turn, rise;
        float out[4];
    };
    std::vector<Item> items;
    for (int i = 0; i < 1000; ++i) {
        const auto f = static_cast<float>(i);
        items.push_back({3.0f * std::sin(f),
                         2.0f * std::cos(1.7f * f),
                         0.4f * std::sin(0.3f * f),
                         0.5f + 0.004f * f,
                         {}});
    }
    const opengl::Buffer buffer("directions", std::span<const Item>(items));
    buffer.bind_storage(0);
    const opengl::Program program = opengl::Program::compute("directions", kSliceGlsl, R"(
struct Item { float x, y, turn, rise; vec4 direction; };
layout(std430, binding = 0) buffer Items { Item items[]; };
void main() {
    if (item() >= uint(items.length())) return;
    Item i = items[item()];
    items[item()].direction = vec4(
        fiber_direction(vec2(i.x, i.y), i.turn, i.rise,
                        vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)), 0);
}
)");
    program.dispatch(items.size());
    buffer.read(std::as_writable_bytes(std::span(items)));
    for (const Item& i : items) {
        const double a = static_cast<double>(i.turn);
        // the same fiber half a step later, from where eq. 1 looks back
        const double x =
            std::cos(a / 2) * static_cast<double>(i.x) - std::sin(a / 2) * static_cast<double>(i.y);
        const double y =
            std::sin(a / 2) * static_cast<double>(i.x) + std::cos(a / 2) * static_cast<double>(i.y);
        const Vec3d d = normalize(Vec3d{(1.0 - std::cos(a)) * x - std::sin(a) * y,
                                        std::sin(a) * x + (1.0 - std::cos(a)) * y,
                                        static_cast<double>(i.rise)});
        const Vec3d got = to_double(Vec3f{i.out[0], i.out[1], i.out[2]});
        EXPECT_LT(length(d - got), 1e-5);
    }
}

} // namespace
} // namespace heddle::slice
