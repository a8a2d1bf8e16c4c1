#include <heddle/io/curve/curve_files.h>

#include <heddle/io/file/test_files.h>

#include <limits>

namespace heddle {
namespace {

using testing::bytes;
using testing::expect_error;
using testing::has_note;
using testing::TempFolder;

constexpr std::uint32_t kAll = 31;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string header(std::uint32_t strands,
                   std::uint32_t points,
                   std::uint32_t arrays,
                   std::uint32_t segments = 0,
                   float thickness = 0.5f) {
    return "HAIR" + bytes(strands, points, arrays, segments, thickness, 0.0f, 0.25f, 0.5f, 2.0f) +
           std::string(88, 'i');
}

std::string floats(int n, float first = 0.0f) {
    std::string out;
    for (int i = 0; i < n; ++i) out += bytes(first + static_cast<float>(i));
    return out;
}

/// Two strands of 3 and 2 points, with every array.
std::string full_file() {
    return header(2, 5, kAll) + bytes(std::uint16_t{2}, std::uint16_t{1}) + floats(15) +
           bytes(0.0f, 0.2f, 0.4f, 0.6f, 0.8f) + floats(5) +
           bytes(1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 9.0f, -9.0f, 0.5f, 0.2f,
                 0.4f, 0.6f);
}

void read(const std::string& path) {
    static_cast<void>(read_hair(path));
}

TEST(Hair, EveryArrayArrives) {
    const TempFolder folder;
    const Geometry g = read_hair(folder.write("groom.hair", full_file()));
    const CurveSet& set = g.curves.at(0);
    EXPECT_EQ(set.basis, Basis::Linear);
    EXPECT_EQ(set.first, (std::vector<std::uint64_t>{0, 3, 5}));
    EXPECT_EQ(set.points[4], (Vec3f{12, 13, 14}));
    EXPECT_EQ(set.radius, (std::vector<float>{0.0f, 0.1f, 0.2f, 0.3f, 0.4f}))
        << "half of the thickness";
    EXPECT_EQ(set.color,
              (std::vector<std::uint32_t>{0x0000ff, 0x00ff00, 0xff0000, 0x8000ff, 0x996633}));
    EXPECT_EQ(g.materials.at(0).albedo, (Vec3f{1, 1, 1})) << "the points' colours stand alone";
    EXPECT_EQ(g.materials[0].name, "hair");
    EXPECT_TRUE(has_note(g, "transparency is not used"));
}

TEST(Hair, EverySubsetOfOptionalArraysReads) {
    const TempFolder folder;
    for (std::uint32_t arrays = 0; arrays < 32; ++arrays) {
        std::string whole = header(2, 6, arrays, 2);
        if (arrays & 1) whole += bytes(std::uint16_t{3}, std::uint16_t{1});
        if (arrays & 2) whole += floats(18);
        if (arrays & 4) whole += floats(6);
        if (arrays & 8) whole += floats(6);
        if (arrays & 16) whole += floats(18);
        const std::string path = folder.write("a.hair", whole);
        if ((arrays & 2) == 0) {
            expect_error(ErrorCode::BadFile, "holds no points array", [&] { read(path); });
            continue;
        }
        const Geometry g = read_hair(path);
        const CurveSet& set = g.curves[0];
        EXPECT_EQ(set.first[1], (arrays & 1) ? 4u : 3u);
        EXPECT_EQ(set.radius.size(), (arrays & 4) ? 6u : 0u);
        EXPECT_EQ(set.color.size(), (arrays & 16) ? 6u : 0u);
        if ((arrays & 4) == 0) {
            EXPECT_EQ(set.default_radius, 0.25f) << "half of the default";
        }
        if ((arrays & 16) == 0) {
            EXPECT_EQ(g.materials[0].albedo, (Vec3f{0.25f, 0.5f, 1.0f})) << "the default, clamped";
        }
    }
}

TEST(Hair, RadiusComesFromOptionThenFileThenDefault) {
    const TempFolder folder;
    const std::string path = folder.write("a.hair", full_file());
    const Geometry option = read_hair(path, {.radius = 3.0f});
    EXPECT_EQ(option.curves[0].default_radius, 3.0f);
    EXPECT_TRUE(option.curves[0].radius.empty());
    for (const float useless : {0.0f, -1.0f, kNan}) {
        const Geometry g = read_hair(folder.write(
            "b.hair", header(1, 2, 2, 1, useless) + bytes(0.f, 0.f, 0.f, 8.f, 0.f, 0.f)));
        EXPECT_FLOAT_EQ(g.curves[0].default_radius, 0.002f);
        EXPECT_TRUE(has_note(g, "default for hair"));
    }
    const Geometry zeros =
        read_hair(folder.write("c.hair", header(1, 2, 6, 1) + floats(6) + bytes(0.0f, 0.0f)));
    EXPECT_TRUE(zeros.curves[0].radius.empty());
    EXPECT_TRUE(has_note(zeros, "default for hair"));
}

TEST(Hair, StrandsOfOnePointAreDroppedFromEveryArray) {
    const TempFolder folder;
    const Geometry g =
        read_hair(folder.write("a.hair", header(4, 7, 1 | 2 | 4 | 16) +
                                             bytes(std::uint16_t{0}, std::uint16_t{2},
                                                   std::uint16_t{0}, std::uint16_t{1}) +
                                             floats(21) + floats(7) + std::string(84, '\0')));
    const CurveSet& set = g.curves[0];
    EXPECT_EQ(set.first, (std::vector<std::uint64_t>{0, 3, 5}));
    EXPECT_EQ(set.points[0], (Vec3f{3, 4, 5}));
    EXPECT_EQ(set.points[3], (Vec3f{15, 16, 17}));
    EXPECT_EQ(set.radius, (std::vector<float>{0.5f, 1.0f, 1.5f, 2.5f, 3.0f}));
    EXPECT_EQ(set.color.size(), 5u);
    EXPECT_TRUE(has_note(g, "2 of 4 strands have one point"));
    expect_error(ErrorCode::BadFile, "none of its 2 strands",
                 [&] { read(folder.write("b.hair", header(2, 2, 2, 0) + floats(6))); });
}

TEST(Hair, CountsThatDoNotFitAreErrors) {
    const TempFolder folder;
    const auto expect = [&](const std::string& text, const std::string& whole) {
        expect_error(ErrorCode::BadFile, text, [&] { read(folder.write("a.hair", whole)); });
    };
    constexpr std::uint32_t kHuge = ~std::uint32_t{0};
    expect("holds no strands", header(0, 5, 2, 4) + floats(15));
    expect("holds no points", header(1, 0, 2, 4));
    expect("1 strands of 3 segments do not make 5 points", header(1, 5, 2, 3) + floats(15));
    expect("4294967295 strands of 0 segments", header(kHuge, 5, 2, 0) + floats(15));
    expect("'points' needs 4294967295", header(kHuge, kHuge, 2, 0) + floats(15));
    expect("'segments' needs 4294967295 x 2", header(kHuge, 5, 3) + floats(15));
    expect("byte 128: the strands have 4 points, the header says 5",
           header(1, 5, 3) + bytes(std::uint16_t{3}) + floats(15));
    expect("does not start with 'HAIR'", "a text file with the wrong suffix");
}

TEST(Hair, NotANumberIsAnErrorInEveryArrayThatIsUsed) {
    const TempFolder folder;
    const auto expect = [&](std::size_t at, float bad, const std::string& text) {
        std::string whole = full_file();
        whole.replace(at, 4, bytes(bad));
        expect_error(ErrorCode::BadFile, text, [&] { read(folder.write("a.hair", whole)); });
    };
    const std::size_t points = 132;
    const std::size_t thickness = points + 60;
    expect(points + 12 * 4 + 8, kNan, "byte 188: point 1 of curve 1 has z = nan");
    expect(thickness + 4, kNan, "byte 196: thickness of point 1 is nan");
    expect(thickness + 4, -0.5f, "thickness of point 1 is -0.5, it must be finite and >= 0");
    expect(thickness + 40 + 12, kNan, "byte 244: colour of point 1 is not finite");
}

TEST(Hair, TrailingBytesAndUnknownArraysAreNoted) {
    const TempFolder folder;
    const Geometry g =
        read_hair(folder.write("a.hair", header(1, 2, 2 | 32, 1) + floats(6) + floats(4)));
    EXPECT_TRUE(has_note(g, "bits 32"));
    EXPECT_TRUE(has_note(g, "16 bytes after"));
}

TEST(Hair, EveryTruncationIsAnErrorAndNoFlippedBitCrashes) {
    const TempFolder folder;
    testing::expect_truncations_fail(folder, "a.hair", full_file(), read);
    testing::flip_every_bit(folder, "a.hair", full_file(), read);
}

TEST(Hair, WritingAndReadingKeepsEverything) {
    const TempFolder folder;
    CurveSet set;
    set.basis = Basis::Linear;
    set.points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {5, 5, 5}, {6, 5, 5}};
    set.first = {0, 3, 5};
    set.default_radius = 0.125f;
    write_hair(set, folder.file("a.hair"), {0.5f, 0.25f, 0.0f});
    const Geometry plain = read_hair(folder.file("a.hair"));
    EXPECT_EQ(plain.curves[0].points, set.points);
    EXPECT_EQ(plain.curves[0].first, set.first);
    EXPECT_EQ(plain.curves[0].default_radius, 0.125f);
    EXPECT_EQ(plain.materials[0].albedo, (Vec3f{0.5f, 0.25f, 0.0f}));

    set.radius = {0.1f, 0.05f, 0.0f, 0.2f, 0.3f};
    set.color = {0x010203, 0xfffefd, 0x808080, 0, 0xffffff};
    write_hair(set, folder.file("a.hair"));
    const CurveSet back = read_hair(folder.file("a.hair")).curves[0];
    EXPECT_EQ(back.radius, set.radius);
    EXPECT_EQ(back.color, set.color);
}

TEST(Hair, StrandsOfOneLengthNeedNoSegmentsArray) {
    const TempFolder folder;
    CurveSet set;
    set.basis = Basis::Linear;
    set.points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {5, 5, 5}};
    set.first = {0, 2, 4};
    write_hair(set, folder.file("a.hair"));
    EXPECT_EQ(std::filesystem::file_size(folder.file("a.hair")), 128u + 48u);
    EXPECT_EQ(read_hair(folder.file("a.hair")).curves[0].first, set.first);
}

TEST(Hair, WhatTheFormatCannotHoldIsNotWritten) {
    const TempFolder folder;
    CurveSet set;
    const auto expect = [&](const std::string& text) {
        expect_error(ErrorCode::InvalidArgument, text,
                     [&] { write_hair(set, folder.file("a.hair")); });
    };
    expect("no strands");
    set.points.resize(65537);
    set.first = {0, 65537};
    expect("these curves are cubic");
    set.basis = Basis::Linear;
    expect("has 65537 points");
    set.first = {0, 2, 4};
    set.points.resize(4);
    set.closed = {0, 1};
    expect("strand 1 is closed");
    EXPECT_EQ(folder.count_entries(), 0u);
}

} // namespace
} // namespace heddle
