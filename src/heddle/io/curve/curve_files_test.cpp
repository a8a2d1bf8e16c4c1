#include <heddle/io/curve/curve_files.h>

#include <heddle/io/curve/curve_info.h>
#include <heddle/io/curve/estimate_radius.h>
#include <heddle/io/file/test_files.h>

namespace heddle {
namespace {

using testing::expect_error;
using testing::find_data;

/// The counts of an independent reader in another language (inspect_curves.py) for a file of real
/// data.
struct Expected {
    const char* name;
    std::size_t curves;
    std::size_t points;
    std::size_t closed;
    double polygon_length; ///< of control polygons, including closing steps
    float radius;          ///< from the file; 0: estimated, about 0.1
    /// The test's name in CTest; by default it would be the bytes, which contain a pointer.
    friend std::ostream& operator<<(std::ostream& out, const Expected& e) { return out << e.name; }
};

class RealCurves : public ::testing::TestWithParam<Expected> {};

TEST_P(RealCurves, CountsAreThoseOfAnIndependentReader) {
    const Expected& e = GetParam();
    const std::string path = find_data(e.name);
    if (path.empty()) GTEST_SKIP() << e.name << " is not there; set HEDDLE_TEST_DATA";
    const Geometry g = read_curves(path);
    const CurveStats s = measure(g.curves.at(0));
    EXPECT_EQ(s.curves, e.curves);
    EXPECT_EQ(s.points, e.points);
    EXPECT_EQ(s.closed, e.closed);
    // a spline is a little longer or shorter than its polygon; a polyline is its polygon
    const bool linear = g.curves[0].basis == Basis::Linear;
    EXPECT_NEAR(s.length, e.polygon_length, (linear ? 1e-5 : 0.11) * e.polygon_length);
    if (e.radius > 0.0f) {
        EXPECT_FLOAT_EQ(s.radius_max, e.radius);
    } else {
        EXPECT_GT(s.radius_max, 0.09f);
        EXPECT_LT(s.radius_max, 0.11f);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Data,
    RealCurves,
    ::testing::Values(
        Expected{"yarn/bcc/cable_work_pattern.bcc", 8, 130083, 0, 20353.1, 0},
        Expected{"yarn/bcc/flame_ribbing_pattern.bcc", 1, 49745, 0, 10858.2, 0},
        Expected{"yarn/bcc/sweater_flame_ribbing.bcc", 253, 271978, 253, 57491.4, 0},
        Expected{"yarn/bcc/tea_cozy.bcc", 22, 184159, 20, 37418.5, 0}, // 2 wrongly closed
        Expected{"yarn/bcc-modified/glove.bcc", 70, 58537, 70, 13925.1, 0},
        Expected{"yarn/bcc-modified/knittubeinit.bcc", 39, 18228, 39, 4730.07, 0},
        Expected{"hair/straight.hair", 10000, 160000, 0, 781535, 0.05f},
        Expected{"hair/ct2hair/Bangs_100.hair", 100, 1165, 0, 8170.29, 0.5f},
        Expected{"hair/ct2hair/Bangs_100.data", 100, 1165, 0, 8170.29, 0.059f},
        Expected{"hair/digital-salon/harolongo.data", 7905, 166005, 0, 186082, 0.00712f}));

TEST(RealPatterns, EveryEdgeIsDrawnOncePerTile) {
    struct Pattern {
        const char* name;
        std::size_t edges;
        float radius;
    };
    for (const Pattern& p :
         {Pattern{"basket", 80, 0.0009999f}, Pattern{"cartridge_belt_rib", 356, 0.001001f},
          Pattern{"satin", 130, 0.001f}, Pattern{"stockinette", 100, 0.001f},
          Pattern{"stockinette_small", 100, 0.0001f}}) {
        const std::string path = find_data(std::string("yarn/patterns/") + p.name + ".pyp");
        if (path.empty()) GTEST_SKIP() << p.name << " is not there; set HEDDLE_TEST_DATA";
        const CurveStats one = measure(read_curves(path).curves[0]);
        const CurveStats nine =
            measure(read_curves(path, {.repeat_x = 3, .repeat_y = 3}).curves[0]);
        EXPECT_EQ(one.spans, p.edges);
        EXPECT_EQ(nine.spans, 9 * p.edges);
        EXPECT_NEAR(nine.length, 9.0 * one.length, 1e-4 * nine.length);
        EXPECT_FLOAT_EQ(one.radius_max, p.radius);
    }
}

TEST(RealPatterns, TheEstimateFindsTheRadiusThatTheFileNames) {
    const std::string path = find_data("yarn/patterns/stockinette.pyp");
    if (path.empty()) GTEST_SKIP() << "stockinette.pyp is not there; set HEDDLE_TEST_DATA";
    const Geometry g = read_curves(path, {.repeat_x = 4, .repeat_y = 4});
    EXPECT_NEAR(estimate_radius(g.curves[0]), g.curves[0].default_radius, 0.0002f);
}

TEST(RealHair, TheSameStrandsInTwoFormatsAreTheSame) {
    const std::string hair = find_data("hair/ct2hair/Bangs_100.hair");
    const std::string data = find_data("hair/ct2hair/Bangs_100.data");
    if (hair.empty() || data.empty()) GTEST_SKIP() << "ct2hair is not there; set HEDDLE_TEST_DATA";
    const Geometry a = read_curves(hair);
    const Geometry b = read_curves(data);
    EXPECT_EQ(a.curves[0].points, b.curves[0].points);
    EXPECT_EQ(a.curves[0].first, b.curves[0].first);
}

TEST(ReadCurves, TheSuffixChoosesTheReader) {
    EXPECT_TRUE(is_curve_file("a/b.BCC"));
    EXPECT_TRUE(is_curve_file("x.hair"));
    EXPECT_FALSE(is_curve_file("x.obj"));
    EXPECT_FALSE(is_curve_file("bcc"));
    expect_error(ErrorCode::Unsupported, "x.obj: its suffix names no known kind",
                 [] { static_cast<void>(read_curves("x.obj")); });
    for (const char* name : {"none.bcc", "none.hair", "none.data", "none.pyp"}) {
        expect_error(ErrorCode::NotFound, "no such file",
                     [&] { static_cast<void>(read_curves(name)); });
    }
}

} // namespace
} // namespace heddle
