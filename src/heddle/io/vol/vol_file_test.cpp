#include <heddle/io/vol/vol_file.h>

#include <heddle/io/vol/test_vol.h>

#include <cmath>
#include <limits>

namespace heddle {
namespace {

using namespace heddle::testing;

constexpr Vec3f kLo{0.0f, 0.0f, 0.0f};
constexpr Vec3f kHi{1.0f, 2.0f, 3.0f};

/// Opens a file and reads all its samples.
void read_all(const std::string& path) {
    const VolFile file(path);
    std::vector<float> densities;
    std::vector<Vec3f> directions;
    if (file.header().holds_density()) file.read_densities({}, file.header().size, densities);
    if (file.header().may_hold_directions()) {
        file.read_directions({}, file.header().size, directions);
    }
}

TEST(VolFile, BytesAreFractionsInTheFilesOrder) {
    const TempFolder folder;
    const Vec3i n{2, 3, 4};
    const std::string path = folder.write(
        "a.vol", vol_header(3, n, 1, kLo, kHi) + vol_samples(n, [](int x, int y, int z) {
                     return std::string(1, static_cast<char>(100 * x + 10 * y + z));
                 }));
    const VolFile file(path);
    EXPECT_EQ(file.header().size, n);
    EXPECT_EQ(file.header().bounds.hi, (Vec3d{1.0, 2.0, 3.0}));
    std::vector<float> d;
    file.read_densities({1, 1, 2}, {2, 3, 4}, d);
    const std::vector<float> expected{112.0f / 255.0f, 122.0f / 255.0f, 113.0f / 255.0f,
                                      123.0f / 255.0f};
    EXPECT_EQ(d, expected);
}

TEST(VolFile, ABoxOfAWideFileIsReadRowByRowAndIsTheSame) {
    const TempFolder folder;
    const Vec3i n{9000, 3, 2}; // 9000 x 3 floats are too many to be read in one piece
    const std::string path = folder.write(
        "wide.vol", vol_header(1, n, 1, kLo, kHi) + vol_samples(n, [](int x, int y, int z) {
                        return bytes(static_cast<float>(x + 9000 * y + 27000 * z) / 60000.0f);
                    }));
    std::vector<float> d;
    VolFile(path).read_densities({8000, 1, 0}, {8002, 3, 2}, d);
    const std::vector<int> at{17000, 17001, 26000, 26001, 44000, 44001, 53000, 53001};
    ASSERT_EQ(d.size(), at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
        EXPECT_EQ(d[i], static_cast<float>(at[i]) / 60000.0f);
    }
}

TEST(VolFile, QuantizedDirectionsAreAnglesAnd255IsNone) {
    const TempFolder folder;
    const Vec3i n{2, 2, 2};
    std::string samples;
    const std::vector<std::pair<int, int>> codes{{0, 0},   {255, 255}, {255, 7},  {85, 0},
                                                 {170, 0}, {85, 51},   {51, 204}, {85, 255}};
    for (const auto& [theta, phi] : codes) {
        samples += {static_cast<char>(theta), static_cast<char>(phi)};
    }
    const std::string path = folder.write("d.vol", vol_header(4, n, 3, kLo, kHi) + samples);
    std::vector<Vec3f> d;
    VolFile(path).read_directions({}, n, d);
    EXPECT_EQ(d[0], (Vec3f{0.0f, 0.0f, 1.0f}));
    EXPECT_EQ(d[1], Vec3f{});
    EXPECT_EQ(d[2], Vec3f{});
    const double pi = std::acos(-1.0);
    for (std::size_t i = 3; i < 8; ++i) {
        const double theta = codes[i].first * pi / 255.0;
        const double phi = codes[i].second * 2.0 * pi / 255.0;
        EXPECT_NEAR(d[i].x, std::sin(theta) * std::cos(phi), 1e-6);
        EXPECT_NEAR(d[i].y, std::sin(theta) * std::sin(phi), 1e-6);
        EXPECT_NEAR(d[i].z, std::cos(theta), 1e-6);
    }
}

TEST(VolFile, FloatDirectionsAreMadeUnitAndZeroStaysZero) {
    const TempFolder folder;
    const Vec3i n{2, 2, 2};
    std::string samples =
        bytes(3.0f, 0.0f, 4.0f, 0.0f, 0.0f, 0.0f, 1e-30f, 0.0f, 0.0f, 0.0f, 1e30f, 0.0f);
    samples += std::string(4 * 12, '\0');
    const std::string path = folder.write("d.vol", vol_header(1, n, 3, kLo, kHi) + samples);
    std::vector<Vec3f> d;
    VolFile(path).read_directions({}, n, d);
    EXPECT_NEAR(d[0].x, 0.6f, 1e-6f);
    EXPECT_NEAR(d[0].z, 0.8f, 1e-6f);
    EXPECT_EQ(d[1], Vec3f{});
    EXPECT_EQ(d[2], (Vec3f{1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(d[3], (Vec3f{0.0f, 1.0f, 0.0f}));
}

TEST(VolFile, EveryTruncationAndAnyByteMoreIsRefused) {
    const TempFolder folder;
    for (const std::string& whole :
         {vol_header(1, {2, 2, 3}, 1, kLo, kHi) + std::string(12 * 4, '\0'),
          vol_header(1, {2, 2, 3}, 3, kLo, kHi) + std::string(12 * 12, '\0'),
          vol_header(3, {2, 2, 3}, 3, kLo, kHi) + std::string(12 * 3, '\0'),
          dense_vol({2, 2, 3}, kLo), direction_vol({2, 2, 3}, kLo, 9, 9)}) {
        expect_truncations_fail(folder, "a.vol", whole, read_all);
        const std::string more = folder.write("more.vol", whole + '\0');
        expect_error(ErrorCode::BadFile, "1 bytes follow", [&] { read_all(more); });
        flip_every_bit(folder, "bad.vol", whole, read_all);
    }
}

TEST(VolFile, AWrongHeaderSaysByteAndWhatIsAllowed) {
    const TempFolder folder;
    const auto refused = [&](ErrorCode code, const std::string& text, const std::string& header) {
        const std::string path = folder.write("bad.vol", header + std::string(8, '\0'));
        expect_error(code, text, [&] { read_all(path); });
    };
    const Vec3i n{2, 2, 2};
    std::string other = vol_header(3, n, 1, kLo, kHi);
    other[0] = 'P';
    refused(ErrorCode::BadFile, "byte 0: does not begin with 'VOL'", other);
    other[0] = 'V';
    other[3] = 4;
    refused(ErrorCode::Unsupported, "byte 3: version 4", other);
    refused(ErrorCode::Unsupported, "byte 4: encoding 2", vol_header(2, n, 1, kLo, kHi));
    refused(ErrorCode::BadFile, "byte 12: 1 samples along y",
            vol_header(3, {2, 1, 2}, 1, kLo, kHi));
    refused(ErrorCode::BadFile, "byte 16: -2 samples", vol_header(3, {2, 2, -2}, 1, kLo, kHi));
    refused(ErrorCode::BadFile, "byte 20: 6 channels", vol_header(3, n, 6, kLo, kHi));
    refused(ErrorCode::BadFile, "byte 20: 1 channels", vol_header(4, n, 1, kLo, kHi));
    refused(ErrorCode::BadFile, "byte 28: bounds", vol_header(3, n, 1, kLo, {1.0f, 0.0f, 1.0f}));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    refused(ErrorCode::BadFile, "byte 24: bounds", vol_header(3, n, 1, {nan, 0.0f, 0.0f}, kHi));
    refused(ErrorCode::BadFile, "byte 32: bounds", vol_header(3, n, 1, kLo, {1.0f, 1.0f, inf}));
}

TEST(VolFile, SizesWhoseProductPasses64BitsAreRefused) {
    const TempFolder folder;
    const int big = 1 << 30;
    for (const Vec3i n : {Vec3i{big, big, big}, Vec3i{big, 16, 2}, Vec3i{2, big, big}}) {
        const std::string path =
            folder.write("big.vol", vol_header(1, n, 3, kLo, kHi) + std::string(100, '\0'));
        expect_error(ErrorCode::BadFile, "100 bytes are left", [&] { read_all(path); });
    }
}

TEST(VolFile, ValuesThatAreNoDensityOrDirectionAreRefusedWithTheirByte) {
    const TempFolder folder;
    const Vec3i n{2, 2, 2};
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), -0.1f, 1.5f}) {
        std::string samples = bytes(0.0f, 0.5f, 1.0f, bad) + std::string(16, '\0');
        const std::string path = folder.write("a.vol", vol_header(1, n, 1, kLo, kHi) + samples);
        expect_error(ErrorCode::BadFile, "byte 60: density", [&] { read_all(path); });
    }
    const std::string path =
        folder.write("d.vol", vol_header(1, n, 3, kLo, kHi) +
                                  bytes(0.0f, 0.0f, 0.0f, 1.0f, std::nanf(""), 0.0f) +
                                  std::string(6 * 12, '\0'));
    expect_error(ErrorCode::BadFile, "byte 60: direction", [&] { read_all(path); });
}

} // namespace
} // namespace heddle
