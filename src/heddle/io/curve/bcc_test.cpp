#include <heddle/io/curve/curve_files.h>

#include <heddle/io/file/test_files.h>

#include <cmath>
#include <limits>

namespace heddle {
namespace {

using testing::bytes;
using testing::expect_error;
using testing::has_note;
using testing::TempFolder;

std::string header(const std::string& type, std::uint64_t curves, std::uint64_t points) {
    return "BCC\x44" + type + "\x03\x01" + bytes(curves, points) +
           std::string(40, static_cast<char>(0xfe)); // info: garbage
}

/// `n` points along x from the origin, after a count of `count`.
std::string curve(std::int32_t count, int n, float y = 0.0f) {
    std::string out = bytes(count);
    for (int i = 0; i < n; ++i) out += bytes(static_cast<float>(i), y, 0.0f);
    return out;
}

void read(const std::string& path) {
    static_cast<void>(read_bcc(path));
}

TEST(Bcc, OpenAndClosedCurvesKeepTheirPoints) {
    const TempFolder folder;
    const Geometry g =
        read_bcc(folder.write("scarf.v2.bcc", header("C0", 2, 8) + curve(4, 4) + curve(-4, 4, 1)));
    const CurveSet& set = g.curves.at(0);
    EXPECT_EQ(g.name, "scarf.v2");
    EXPECT_EQ(set.basis, Basis::CatmullRom);
    EXPECT_EQ(set.first, (std::vector<std::uint64_t>{0, 4, 8}));
    EXPECT_EQ(set.closed, (std::vector<std::uint8_t>{0, 1}));
    EXPECT_EQ(set.points[7], (Vec3f{3, 1, 0}));
    EXPECT_EQ(set.span_count(0), 1u) << "the end points of an open C0 curve are phantoms";
    EXPECT_EQ(set.span_count(1), 4u);
    EXPECT_EQ(set.yarn, -1);
    ASSERT_EQ(g.materials.size(), 1u);
    EXPECT_EQ(g.materials[0].kind, MaterialKind::Fiber);
    EXPECT_EQ(g.materials[0].name, "yarn");
    EXPECT_TRUE(has_note(g, "up axis is y"));
    EXPECT_TRUE(has_note(g, "estimated"));
    EXPECT_GT(set.default_radius, 0.0f);
}

TEST(Bcc, TheRadiusOptionHoldsAndMustBeSane) {
    const TempFolder folder;
    const std::string path = folder.write("a.bcc", header("C0", 1, 4) + curve(4, 4));
    const Geometry g = read_bcc(path, {.radius = 0.25f});
    EXPECT_EQ(g.curves[0].default_radius, 0.25f);
    EXPECT_FALSE(has_note(g, "radius"));
    for (const float bad : {-1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        expect_error(ErrorCode::InvalidArgument, "yarn radius",
                     [&] { static_cast<void>(read_bcc(path, {.radius = bad})); });
    }
}

TEST(Bcc, ALoneStraightYarnGetsARadiusFromItsLength) {
    const TempFolder folder;
    const Geometry g = read_bcc(folder.write("a.bcc", header("PL", 1, 11) + curve(11, 11)));
    EXPECT_FLOAT_EQ(g.curves[0].default_radius, 0.1f);
    EXPECT_TRUE(has_note(g, "no neighbouring yarns"));
}

TEST(Bcc, EveryBasisSurvivesWritingAndReading) {
    const TempFolder folder;
    for (const Basis basis : {Basis::Linear, Basis::CatmullRom, Basis::CubicBSpline}) {
        CurveSet set;
        set.basis = basis;
        set.first = {0, 4, 9};
        set.closed = {0, 1};
        for (int i = 0; i < 9; ++i) {
            const float t = static_cast<float>(i);
            set.points.push_back({std::sin(t), 0.1f * t, std::cos(t)});
        }
        write_bcc(set, folder.file("a.bcc"), 2);
        const Geometry g = read_bcc(folder.file("a.bcc"));
        EXPECT_EQ(g.curves[0].basis, basis);
        EXPECT_EQ(g.curves[0].points, set.points);
        EXPECT_EQ(g.curves[0].first, set.first);
        EXPECT_EQ(g.curves[0].closed, set.closed);
        EXPECT_TRUE(has_note(g, "up axis is z"));
        set.closed.clear();
        write_bcc(set, folder.file("b.bcc"));
        EXPECT_TRUE(read_bcc(folder.file("b.bcc")).curves[0].closed.empty());
    }
}

/// Curves of these lengths; the coordinates of their points are consecutive numbers from `from`.
CurveSet counting_set(const std::vector<std::uint64_t>& lengths, float from) {
    CurveSet set;
    set.first = {0};
    for (const std::uint64_t n : lengths) {
        for (std::uint64_t i = 0; i < n; ++i) {
            set.points.push_back({from, 0.5f * static_cast<float>(i), 0.0f});
            from += 1.0f;
        }
        set.first.push_back(set.points.size());
    }
    set.basis = Basis::CatmullRom;
    return set;
}

TEST(Bcc, AllSetsAreWrittenOneAfterTheOther) {
    const TempFolder folder;
    const std::vector<CurveSet> sets{
        counting_set({7, 7, 7}, 0.0f), {}, counting_set({4, 9}, 50.0f)};
    write_bcc(sets, folder.file("a.bcc"));
    const Geometry g = read_bcc(folder.file("a.bcc"));
    ASSERT_EQ(g.curves.size(), 1u);
    EXPECT_EQ(g.curves[0].first, (std::vector<std::uint64_t>{0, 7, 14, 21, 25, 34}));
    std::vector<Vec3f> points = sets[0].points;
    points.insert(points.end(), sets[2].points.begin(), sets[2].points.end());
    EXPECT_EQ(g.curves[0].points, points);
    EXPECT_EQ(std::filesystem::file_size(folder.file("a.bcc")), 64u + 5 * 4 + 34 * 12);
}

TEST(Bcc, SetsOfSeveralBasesAreNotWritten) {
    const TempFolder folder;
    std::vector<CurveSet> sets{counting_set({7}, 0.0f), counting_set({7}, 9.0f)};
    sets[1].basis = Basis::Linear;
    expect_error(ErrorCode::InvalidArgument, "several bases",
                 [&] { write_bcc(sets, folder.file("a.bcc")); });
    EXPECT_EQ(folder.count_entries(), 0u);
}

TEST(Bcc, ACubicWhoseEndsAreFarApartIsNotClosed) {
    const TempFolder folder;
    const Geometry cubic = read_bcc(folder.write("a.bcc", header("C0", 1, 20) + curve(-20, 20)));
    EXPECT_FALSE(cubic.curves[0].is_closed(0));
    EXPECT_TRUE(has_note(cubic, "read as open"));
    const Geometry near = read_bcc(folder.write("b.bcc", header("C0", 1, 16) + curve(-16, 16)));
    EXPECT_TRUE(near.curves[0].is_closed(0));
    const Geometry line = read_bcc(folder.write("c.bcc", header("PL", 1, 20) + curve(-20, 20)));
    EXPECT_TRUE(line.curves[0].is_closed(0)) << "a polygon may have a long side";
}

TEST(Bcc, TooFewPointsAreCountedAndToldOnce) {
    const TempFolder folder;
    const std::string good = curve(4, 4);
    const std::string path = folder.write("scarf.bcc", header("C0", 4, 11) + good + curve(3, 3) +
                                                           curve(-2, 2) + curve(-2, 2));
    expect_error(
        ErrorCode::BadFile,
        "scarf.bcc: byte 116: curve 1 has 3 control points, a cubic needs at least 4 (and 2 more problems); drop the curve or store it as 'PL'",
        [&] { read(path); });
    expect_error(ErrorCode::BadFile, "has 0 control points, a cubic needs at least 4",
                 [&] { read(folder.write("b.bcc", header("BS", 2, 4) + good + curve(0, 0))); });
    expect_error(ErrorCode::BadFile, "curve 0 has 1 control point, a polyline needs at least 2",
                 [&] { read(folder.write("c.bcc", header("PL", 1, 1) + curve(1, 1))); });
}

TEST(Bcc, NanAndInfinitePointsAreToldWithCurveAndByte) {
    const TempFolder folder;
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
        std::string whole = header("C0", 2, 8) + curve(4, 4) + curve(4, 4);
        const std::size_t at = 64 + 52 + 4 + 12 * 2 + 4; // y of point 2 of curve 1
        whole.replace(at, 4, bytes(bad));
        expect_error(ErrorCode::BadFile, "byte 148: point 2 of curve 1 has y = ", [&] {
            read(folder.write("a.bcc", whole));
        });
    }
}

TEST(Bcc, CountsThatDoNotFitAreErrors) {
    const TempFolder folder;
    constexpr std::uint64_t kHuge = ~std::uint64_t{0};
    const auto expect = [&](const std::string& text, const std::string& whole) {
        expect_error(ErrorCode::BadFile, text, [&] { read(folder.write("a.bcc", whole)); });
    };
    expect("'curves' needs", header("C0", kHuge, 4) + curve(4, 4));
    expect("'points' needs", header("C0", 1, kHuge) + curve(4, 4));
    expect("'points' needs", header("C0", 1, 6) + curve(4, 4));
    expect("holds no curves", header("C0", 0, 4) + curve(4, 4));
    expect("holds no points", header("C0", 1, 0) + curve(4, 4));
    expect("curve 0 has 5 points, the header's 4", header("C0", 1, 4) + curve(5, 5));
    expect("header says 5 points, the curves hold 4", header("C0", 1, 5) + curve(4, 5));
    expect("has 2147483648 points",
           header("C0", 1, 4) + curve(std::numeric_limits<std::int32_t>::min(), 4));
}

TEST(Bcc, AnotherKindOfFileIsSaidToBeOne) {
    const TempFolder folder;
    const std::string body = curve(4, 4);
    const auto expect = [&](const std::string& text, const std::string& whole) {
        expect_error(ErrorCode::BadFile, text, [&] { read(folder.write("a.bcc", whole)); });
    };
    std::string whole = header("C0", 1, 4) + body;
    expect("does not start with 'BCC'", "# a text file with the wrong suffix\n");
    expect("does not start with 'BCC'", "");
    expect("curve type 'C?' is not known", header("C\n", 1, 4) + body);
    whole[3] = 0x48;
    expect("number sizes are 0x48", whole);
    whole[3] = 0x44;
    whole[6] = 2;
    expect("2 dimensions", whole);
    expect_error(ErrorCode::BadFile, "is a directory", [&] { read(folder.path()); });
    expect_error(ErrorCode::BadFile, "device", [] { read("/dev/null"); });
}

TEST(Bcc, TrailingBytesAndOddUpAxesAreNoted) {
    const TempFolder folder;
    std::string whole = header("C0", 1, 4) + curve(4, 4) + "extra";
    whole[7] = 9;
    const Geometry g = read_bcc(folder.write("a.bcc", whole));
    EXPECT_TRUE(has_note(g, "5 bytes after the last curve, from byte 116"));
    EXPECT_TRUE(has_note(g, "up axis 9 is not known"));
}

TEST(Bcc, EveryTruncationIsAnErrorAndNoFlippedBitCrashes) {
    const TempFolder folder;
    const std::string whole = header("C0", 2, 8) + curve(4, 4) + curve(-4, 4, 1);
    testing::expect_truncations_fail(folder, "a.bcc", whole, read);
    testing::flip_every_bit(folder, "a.bcc", whole, read);
}

TEST(Bcc, WhatTheReaderWouldRefuseIsNotWritten) {
    const TempFolder folder;
    const auto write = [&](const CurveSet& set, int up) {
        write_bcc(set, folder.file("a.bcc"), up);
    };
    CurveSet set;
    expect_error(ErrorCode::InvalidArgument, "no curves", [&] { write(set, 2); });
    set.points.resize(3);
    set.first = {0, 3};
    expect_error(ErrorCode::InvalidArgument, "takes 4 to", [&] { write(set, 2); });
    set.basis = Basis::Linear;
    expect_error(ErrorCode::InvalidArgument, "up axis is 3", [&] { write(set, 3); });
    EXPECT_EQ(folder.count_entries(), 0u);
}

} // namespace
} // namespace heddle
