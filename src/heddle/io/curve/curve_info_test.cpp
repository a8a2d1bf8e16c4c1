#include <heddle/io/curve/curve_info.h>

#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/io/curve/curve_span.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace heddle {
namespace {

CurveSet circle(Basis basis, int points) {
    CurveSet set;
    set.basis = basis;
    set.first = {0, static_cast<std::uint64_t>(points)};
    set.closed = {1};
    for (int i = 0; i < points; ++i) {
        const double a = 2.0 * std::numbers::pi * i / points;
        set.points.push_back(to_float({std::cos(a), std::sin(a), 0.0}));
    }
    return set;
}

/// The length as the sum of very many chords.
double chord_length(const CurveSet& set) {
    double sum = 0.0;
    visit_spans(set, 0, set.points.size(), [&](std::size_t curve, std::size_t span) {
        const BezierSpan b = bezier_span(set, curve, span);
        for (int i = 0; i < 1000; ++i) {
            sum += length(evaluate(b, (i + 1) / 1000.0) - evaluate(b, i / 1000.0));
        }
    });
    return sum;
}

TEST(CurveSpan, BezierFormIsTheBasisItself) {
    CurveSet set;
    set.points = {{0, 1, 2}, {3, -1, 0}, {4, 4, 1}, {9, 2, 2}};
    set.first = {0, 4};
    const double u = 0.3;
    const auto blend = [&](double a, double b, double c, double d) {
        return to_double(set.points[0]) * a + to_double(set.points[1]) * b +
               to_double(set.points[2]) * c + to_double(set.points[3]) * d;
    };
    const auto expect_near = [](Vec3d a, Vec3d b) { EXPECT_LT(length(a - b), 1e-12); };
    set.basis = Basis::CatmullRom;
    expect_near(evaluate(bezier_span(set, 0, 0), u),
                blend(0.5 * (-u + 2 * u * u - u * u * u), 0.5 * (2 - 5 * u * u + 3 * u * u * u),
                      0.5 * (u + 4 * u * u - 3 * u * u * u), 0.5 * (u * u * u - u * u)));
    set.basis = Basis::CubicBSpline;
    const double v = 1.0 - u;
    expect_near(evaluate(bezier_span(set, 0, 0), u),
                blend(v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                      (-3 * u * u * u + 3 * u * u + 3 * u + 1) / 6, u * u * u / 6));
    set.basis = Basis::Linear;
    expect_near(evaluate(bezier_span(set, 0, 2), u), blend(0, 0, v, u));
}

TEST(CurveSpan, ClosedCurvesPassThroughAllTheirPoints) {
    const CurveSet set = circle(Basis::CatmullRom, 7);
    ASSERT_EQ(set.span_count(0), 7u);
    for (std::size_t k = 0; k < 7; ++k) {
        EXPECT_EQ(to_float(bezier_span(set, 0, k)[0]), set.points[k]);
        EXPECT_EQ(to_float(bezier_span(set, 0, k)[3]), set.points[(k + 1) % 7]);
    }
    CurveSet line = circle(Basis::Linear, 7);
    EXPECT_EQ(to_float(bezier_span(line, 0, 6)[3]), line.points[0]);
}

TEST(Measure, LengthIsThatOfTheCurveNotOfItsPolygon) {
    for (const Basis basis : {Basis::Linear, Basis::CatmullRom, Basis::CubicBSpline}) {
        const CurveSet set = circle(basis, 8);
        EXPECT_NEAR(measure(set).length, chord_length(set), 1e-5 * chord_length(set));
    }
    EXPECT_NEAR(measure(circle(Basis::CatmullRom, 64)).length, 2.0 * std::numbers::pi, 1e-4);
    EXPECT_NEAR(measure(circle(Basis::Linear, 4)).length, 4.0 * std::sqrt(2.0), 1e-6);
}

TEST(Measure, PhantomEndPointsAreNeitherLengthNorBounds) {
    CurveSet set;
    set.points = {{-100, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {103, 0, 0}};
    set.first = {0, 5};
    set.basis = Basis::CatmullRom;
    const CurveStats s = measure(set);
    EXPECT_EQ(s.spans, 2u);
    EXPECT_EQ(s.points, 5u);
    EXPECT_LT(s.bounds.hi.x, 20.0);
    set.points.front() = {-1, 0, 0};
    set.points.back() = {3, 0, 0};
    EXPECT_DOUBLE_EQ(measure(set).length, 2.0);
    EXPECT_DOUBLE_EQ(measure(set).bounds.lo.x, 0.0);
    EXPECT_DOUBLE_EQ(measure(set).bounds.hi.x, 2.0);
}

TEST(Measure, CountsAndRadiiAreOfAllCurves) {
    CurveSet set = circle(Basis::CatmullRom, 8);
    set.first = {0, 4, 8};
    set.closed = {1, 0};
    set.default_radius = 0.5f;
    EXPECT_EQ(measure(set).closed, 1u);
    EXPECT_EQ(measure(set).curves, 2u);
    EXPECT_EQ(measure(set).spans, 5u);
    EXPECT_EQ(measure(set).radius_min, 0.5f);
    set.radius = {1, 2, 3, 4, 5, 6, 7, 0.25f};
    EXPECT_EQ(measure(set).radius_min, 0.25f);
    EXPECT_EQ(measure(set).radius_max, 7.0f);
}

TEST(Measure, NothingMeasuresNothing) {
    const CurveStats s = measure({});
    EXPECT_EQ(s.curves, 0u);
    EXPECT_EQ(s.length, 0.0);
    EXPECT_TRUE(s.bounds.empty());
}

TEST(Measure, BoundsHoldTheCurve) {
    CurveSet set;
    set.basis = Basis::CatmullRom;
    CounterRandom random{.seed = 1, .id = 2};
    for (int i = 0; i < 200; ++i) {
        set.points.push_back({random.uniform(), random.uniform(), random.uniform()});
    }
    set.first = {0, 100, 200};
    set.closed = {0, 1};
    const Bounds box = measure(set).bounds;
    visit_spans(set, 0, 200, [&](std::size_t curve, std::size_t span) {
        for (int i = 0; i <= 50; ++i) {
            const Vec3d p = evaluate(bezier_span(set, curve, span), i / 50.0);
            for (int a = 0; a < 3; ++a) {
                EXPECT_GE(p[a], box.lo[a] - 1e-12);
                EXPECT_LE(p[a], box.hi[a] + 1e-12);
            }
        }
    });
}

TEST(Measure, SameBitsForAnyThreadCount) {
    CurveSet set = circle(Basis::CubicBSpline, 50000);
    set_thread_count(1);
    const CurveStats one = measure(set);
    set_thread_count(7);
    const CurveStats seven = measure(set);
    set_thread_count(0);
    EXPECT_EQ(one.length, seven.length);
    EXPECT_EQ(one.bounds.lo, seven.bounds.lo);
}

} // namespace
} // namespace heddle
