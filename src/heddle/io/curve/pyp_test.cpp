#include <heddle/io/curve/curve_files.h>
#include <heddle/io/curve/curve_info.h>

#include <heddle/io/file/test_files.h>

#include <cmath>

namespace heddle {
namespace {

using testing::expect_error;
using testing::has_note;
using testing::TempFolder;

/// A yarn of three vertices along x that continues in the next tile; period 3 x 2.
const std::string kStraight = "*pattern # px py radius num_vertedges\n3 2 0.25 3\n\n"
                              "*Q # dofs: x y z t\n0 0 0 0.5\n1 0 0.5 0\n2 0 0 0\n\n"
                              "*E # edges [v0, v1, dx, dy]\n2 0 1 0\n0 1 0 0\n1 2 0 0\n\n"
                              "*RL # rest lengths\n1\n1\n1\n";

void read(const std::string& path) {
    static_cast<void>(read_pyp(path));
}

TEST(Pyp, AYarnRunsThroughTheTileOntoTheNodesBeyondItsBorder) {
    const TempFolder folder;
    const Geometry g = read_pyp(folder.write("plain.pyp", kStraight));
    const CurveSet& set = g.curves.at(0);
    EXPECT_EQ(set.basis, Basis::CatmullRom);
    EXPECT_EQ(set.points,
              (std::vector<Vec3f>{
                  {-1, 0, 0}, {0, 0, 0}, {1, 0, 0.5f}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0.5f}}));
    EXPECT_EQ(set.first, (std::vector<std::uint64_t>{0, 6}));
    EXPECT_EQ(set.span_count(0), 3u) << "one per edge";
    EXPECT_EQ(set.default_radius, 0.25f);
    EXPECT_TRUE(set.closed.empty());
    EXPECT_EQ(g.name, "plain");
    EXPECT_EQ(read_pyp(folder.file("plain.pyp"), {.radius = 2.0f}).curves[0].default_radius, 2.0f);
}

TEST(Pyp, RepeatedTilesJoinIntoLongYarns) {
    const TempFolder folder;
    const Geometry g = read_pyp(folder.write("a.pyp", kStraight), {.repeat_x = 4, .repeat_y = 2});
    const CurveSet& set = g.curves[0];
    ASSERT_EQ(set.curve_count(), 2u);
    EXPECT_EQ(set.span_count(0), 12u);
    EXPECT_EQ(set.points[1], (Vec3f{0, 0, 0}));
    EXPECT_EQ(set.points[13], (Vec3f{12, 0, 0})) << "the end of the last span, at the border";
    EXPECT_EQ(set.points[set.first[1] + 1], (Vec3f{0, 2, 0})) << "the tile above";
}

TEST(Pyp, EveryEdgeOfEveryTileIsDrawnOnce) {
    // a yarn that weaves up and down across the tile's lower border and steps back in x
    const std::string loops = "*pattern\n4 2 0.1 4\n*Q\n0 0 0 0\n1 1.5 0 0\n2 0.5 0 0\n3 1 0 0\n"
                              "*E\n0 1 0 -1\n1 2 0 1\n2 3 0 0\n3 0 -1 0\n";
    const TempFolder folder;
    const std::string path = folder.write("a.pyp", loops);
    const auto tiled = [&](int x, int y) {
        return measure(read_pyp(path, {.repeat_x = x, .repeat_y = y}).curves[0]);
    };
    const CurveStats one = tiled(1, 1);
    const CurveStats many = tiled(5, 3);
    EXPECT_EQ(one.spans, 4u);
    EXPECT_EQ(many.spans, 4u * 15u);
    EXPECT_NEAR(many.length, 15.0 * one.length, 1e-5 * many.length) << "no gap and no overlap";
}

TEST(Pyp, ARingWithinTheTileIsClosed) {
    const TempFolder folder;
    const Geometry g =
        read_pyp(folder.write("a.pyp", "*pattern\n4 2 0.1 3\n*Q\n0 0 0 0\n1 1 0 0\n2 0 0 0\n"
                                       "*E\n0 1 0 0\n1 2 0 0\n2 0 0 0\n"),
                 {.repeat_x = 2});
    EXPECT_EQ(g.curves[0].closed, (std::vector<std::uint8_t>{1, 1}));
    EXPECT_EQ(g.curves[0].points.size(), 6u);
    expect_error(ErrorCode::BadFile, "ring of 2 points", [&] {
        read(folder.write("b.pyp", "*pattern\n4 2 0.1 2\n*Q\n0 0 0 0\n1 1 0 0\n"
                                   "*E\n0 1 0 0\n1 0 0 0\n"));
    });
}

TEST(Pyp, AYarnThatEndsInTheTileIsMirroredInItsEnds) {
    const TempFolder folder;
    const Geometry g = read_pyp(
        folder.write("a.pyp", "*pattern\n4 2 0.1 3\n*Q\n0 0 0 0\n1 1 0 0\n3 3 3 0\n*E\n0 1 0 0\n"));
    EXPECT_EQ(g.curves[0].points,
              (std::vector<Vec3f>{{-1, -1, 0}, {0, 0, 0}, {1, 1, 0}, {2, 2, 0}}));
    EXPECT_TRUE(has_note(g, "1 vertices are on no edge"));
}

TEST(Pyp, AOneVertexYarnCrossesBothBorders) {
    const TempFolder folder;
    const Geometry g =
        read_pyp(folder.write("a.pyp", "*pattern\n4 2 0.1 1\n*Q\n1 1 0 0\n*E\n0 0 0 1\n"));
    EXPECT_EQ(g.curves[0].points,
              (std::vector<Vec3f>{{1, -1, 0}, {1, 1, 0}, {1, 3, 0}, {1, 5, 0}}));
}

TEST(Pyp, BadRowsAreToldWithTheirLine) {
    const TempFolder folder;
    const auto expect = [&](const std::string& text, const std::string& from,
                            const std::string& to) {
        std::string whole = kStraight;
        whole.replace(whole.find(from), from.size(), to);
        expect_error(ErrorCode::BadFile, text, [&] { read(folder.write("a.pyp", whole)); });
    };
    expect("a.pyp:6: 'nan' is not a finite number", "1 0 0.5 0\n", "1 nan 0.5 0\n");
    expect("a.pyp:6: '1e400' is not a finite number", "1 0 0.5 0\n", "1e400 0 0.5 0\n");
    expect("a.pyp:6: 'abc'", "1 0 0.5 0\n", "abc 0 0.5 0\n");
    expect("a.pyp:6: vertex is too far away", "1 0 0.5 0\n", "1e300 0 0.5 0\n");
    expect("a.pyp:6: has 3 numbers, it must have 4", "1 0 0.5 0\n", "1 0 0.5\n");
    expect("a.pyp:6: has more than 4 numbers", "1 0 0.5 0\n", "1 0 0.5 0 0\n");
    expect("a.pyp:10: vertex is 3, it must be a whole number from 0 to 2", "2 0 1 0", "2 3 1 0");
    expect("a.pyp:10: vertex is 0.5", "2 0 1 0", "2 0.5 1 0");
    expect("a.pyp:10: tile step is 1e+09", "2 0 1 0", "2 0 1e9 0");
    expect("a.pyp:12: vertex 2 has two ways on", "1 2 0 0", "2 2 0 1");
    expect("a.pyp:12: vertex 1 has two ways to it", "1 2 0 0", "1 1 0 0");
    expect("a.pyp:10: vertex 0 leads to itself", "2 0 1 0", "0 0 0 0");
    expect("a.pyp:2: names 4 vertices, *Q holds 3", "3 2 0.25 3", "3 2 0.25 4");
    expect("a.pyp:2: period is 0 x 2", "3 2 0.25 3", "0 2 0.25 3");
    expect("has 2 '*pattern' rows", "3 2 0.25 3", "3 2 0.25 3\n1 1 1 1");
}

TEST(Pyp, AnotherKindOfFileIsSaidToBeOne) {
    const TempFolder folder;
    const auto expect = [&](const std::string& text, const std::string& whole) {
        expect_error(ErrorCode::BadFile, text, [&] { read(folder.write("a.pyp", whole)); });
    };
    expect("a.pyp:2: is not a .pyp file", "\nv 1 2 3\n");
    expect("a.pyp:1: is not a .pyp file", std::string("BCC\x44\0\0\0\0", 8));
    expect("has 0 '*pattern' rows", "");
    expect("has 0 '*pattern' rows", "*Q\n0 0 0 0\n*E\n0 0 1 0\n");
    expect("holds no vertices", "*pattern\n1 1 1 0\n*E\n0 0 1 0\n");
    expect("holds no edges", "*pattern\n1 1 1 1\n*Q\n0 0 0 0\n");
    expect_error(ErrorCode::BadFile, "is a directory", [&] { read(folder.path()); });
}

TEST(Pyp, TruncationsAndFlippedBitsNeverCrash) {
    // text truncated after a row may still be a pattern: only a crash or a foreign exception fails
    const TempFolder folder;
    for (std::size_t n = 0; n < kStraight.size(); ++n) {
        const std::string path = folder.write("a.pyp", kStraight.substr(0, n));
        const auto e = testing::error_of([&] { read(path); });
        if (n < kStraight.find("*E") + 12) {
            EXPECT_TRUE(e.has_value()) << n << " bytes";
        }
    }
    testing::flip_every_bit(folder, "a.pyp", kStraight, read);
}

TEST(Pyp, RepeatsOutOfRangeAreErrors) {
    const TempFolder folder;
    const std::string path = folder.write("a.pyp", kStraight);
    const auto expect = [&](const std::string& text, int x, int y) {
        expect_error(ErrorCode::InvalidArgument, text,
                     [&] { static_cast<void>(read_pyp(path, {.repeat_x = x, .repeat_y = y})); });
    };
    expect("repeat is 0 x 1", 0, 1);
    expect("repeat is 1 x -2", 1, -2);
    expect("pass the limit of 2147483648 points", 2000000000, 2000000000);
}

TEST(Pyp, UnknownSectionsAndAMissingRadiusAreNoted) {
    const TempFolder folder;
    std::string whole = kStraight + "*colour\nred\n";
    whole.replace(whole.find("0.25"), 4, "0");
    const Geometry g = read_pyp(folder.write("a.pyp", whole), {.repeat_y = 3});
    EXPECT_TRUE(has_note(g, "section 'colour' is not known"));
    EXPECT_TRUE(has_note(g, "estimated"));
    EXPECT_NEAR(g.curves[0].default_radius, 1.0f, 0.01f) << "yarns are 2 apart";
}

} // namespace
} // namespace heddle
