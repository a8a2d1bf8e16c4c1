#include <heddle/io/curve/curve_files.h>

#include <heddle/io/file/test_files.h>

#include <limits>

namespace heddle {
namespace {

using testing::bytes;
using testing::expect_error;
using testing::has_note;
using testing::TempFolder;

std::string strand(std::int32_t n) {
    std::string out = bytes(n);
    for (int i = 0; i < n; ++i) out += bytes(0.0f, static_cast<float>(i), 1.0f);
    return out;
}

void read(const std::string& path) {
    static_cast<void>(read_usc(path));
}

TEST(Usc, StrandsArePolylinesWithTheDefaultRadius) {
    const TempFolder folder;
    const Geometry g = read_usc(folder.write("groom.data", bytes(2) + strand(2) + strand(5)));
    const CurveSet& set = g.curves.at(0);
    EXPECT_EQ(g.name, "groom");
    EXPECT_EQ(g.materials.at(0).name, "hair");
    EXPECT_EQ(set.basis, Basis::Linear);
    EXPECT_EQ(set.first, (std::vector<std::uint64_t>{0, 2, 7}));
    EXPECT_EQ(set.points[6], (Vec3f{0, 4, 1}));
    EXPECT_FLOAT_EQ(set.default_radius, 0.001f) << "1/4000 of 4";
    EXPECT_TRUE(has_note(g, "default for hair"));
    EXPECT_EQ(read_usc(folder.file("groom.data"), {.radius = 2.0f}).curves[0].default_radius, 2.0f);
}

TEST(Usc, StrandsOfOnePointAreDroppedWithANote) {
    const TempFolder folder;
    const Geometry g =
        read_usc(folder.write("a.data", bytes(4) + strand(1) + strand(3) + strand(0) + strand(2)));
    EXPECT_EQ(g.curves[0].first, (std::vector<std::uint64_t>{0, 3, 5}));
    EXPECT_EQ(g.curves[0].points.size(), 5u);
    EXPECT_TRUE(has_note(g, "2 of 4 strands"));
    expect_error(ErrorCode::BadFile, "none of its 1 strands",
                 [&] { read(folder.write("b.data", bytes(1) + strand(1))); });
}

TEST(Usc, CountsThatDoNotFitAreErrors) {
    const TempFolder folder;
    const auto expect = [&](const std::string& text, const std::string& whole) {
        expect_error(ErrorCode::BadFile, text, [&] { read(folder.write("a.data", whole)); });
    };
    expect("strand count is 0", bytes(0));
    expect("strand count is -3", bytes(-3));
    expect("'strands' needs 1000000 x 4", bytes(1000000) + strand(2));
    expect("'points of a strand' needs 2000000000 x 12", bytes(1, 2000000000));
    expect("strand 0 has -2 points", bytes(1, -2));
    expect("'strands' needs", "a text file with the wrong suffix");
    expect("byte 0: 'strand count' needs 4 bytes, 0 are left", "");
}

TEST(Usc, NanPointsAreErrorsAndTrailingBytesANote) {
    const TempFolder folder;
    std::string whole = bytes(2) + strand(2) + strand(2);
    EXPECT_TRUE(has_note(read_usc(folder.write("a.data", whole + "x")), "1 byte after"));
    whole.replace(4 + 28 + 4 + 12, 4, bytes(std::numeric_limits<float>::quiet_NaN()));
    expect_error(ErrorCode::BadFile, "byte 48: point 1 of curve 1 has x = nan",
                 [&] { read(folder.write("a.data", whole)); });
}

TEST(Usc, EveryTruncationIsAnErrorAndNoFlippedBitCrashes) {
    const TempFolder folder;
    const std::string whole = bytes(3) + strand(2) + strand(1) + strand(3);
    testing::expect_truncations_fail(folder, "a.data", whole, read);
    testing::flip_every_bit(folder, "a.data", whole, read);
}

} // namespace
} // namespace heddle
