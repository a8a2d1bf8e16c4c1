#include <heddle/base/error.h>
#include <heddle/io/file/test_files.h>
#include <heddle/io/image/image.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace heddle {
namespace {

using testing::expect_error;

/// A segment: marker, length, bytes.
std::string segment(int marker, const std::string& held) {
    const std::size_t length = held.size() + 2;
    const std::string head{static_cast<char>(0xFF), static_cast<char>(marker),
                           static_cast<char>(length >> 8), static_cast<char>(length & 255)};
    return head + held;
}

/// Counts of codes of 1 to 16 bits, given as pairs of bits and count.
std::string counts(std::initializer_list<std::pair<int, int>> of) {
    std::string out(16, '\0');
    for (const auto& [bits, count] : of)
        out[static_cast<std::size_t>(bits - 1)] = static_cast<char>(count);
    return out;
}

/// A Huffman table with this number of symbols, which are all 0.
std::string table(int id, const std::string& of_bits, std::size_t symbols) {
    return static_cast<char>(id) + of_bits + std::string(symbols, '\0');
}

const std::string kStart = "\xFF\xD8";
const std::string kQuantizers = segment(0xDB, std::string(1, '\0') + std::string(64, '\1'));
const std::string kFrame = segment(0xC0, std::string("\x08\0\x08\0\x08\x01\x01\x11\0", 9));
const std::string kDc = segment(0xC4, table(0, counts({{1, 1}}), 1));
const std::string kAc = segment(0xC4, table(0x10, counts({{1, 1}}), 1));
// the block: no difference, no coefficients, then ones
const std::string kScan = segment(0xDA, std::string("\x01\x01\0\0\x3F\0", 6)) + "\x3F";
const std::string kEnd = "\xFF\xD9";

/// 8 x 8 px of grey 128, with these tables.
std::string jpeg(const std::string& tables) {
    return kStart + kQuantizers + kFrame + tables + kScan + kEnd;
}

Texture decode(const std::string& bytes) {
    return decode_image(std::as_bytes(std::span{bytes}), "a.jpg");
}

void expect_refused(const std::string& text, const std::string& bytes) {
    expect_error(ErrorCode::BadFile, text, [&] { (void)decode(bytes); });
}

void expect_grey(const std::string& bytes) {
    const Texture image = decode(bytes);
    EXPECT_EQ(image.width, 8);
    EXPECT_EQ(image.texels, std::vector<std::uint8_t>(64, 128));
}

TEST(JpegTables, SoundOnesAreReadWhereverTheyStand) {
    expect_grey(jpeg(kDc + kAc));
    expect_grey(kStart + kAc + kDc + kQuantizers + kFrame + kScan + kEnd);
    expect_grey(jpeg(segment(0xC4, kDc.substr(4) + kAc.substr(4)))); // both in one segment
    expect_grey(jpeg("\xFF\xFF" + kDc + kAc));                       // fill bytes
    expect_grey(jpeg(segment(0xC4, table(0, counts({{2, 1}, {16, 255}}), 256)) + kDc + kAc));
}

TEST(JpegTables, WhatLooksLikeOneInOtherSegmentsIsNone) {
    const std::string bad = segment(0xC4, table(0, counts({{8, 255}, {9, 255}}), 510));
    expect_grey(jpeg(segment(0xE1, bad) + segment(0xFE, bad) + kDc + kAc));
    expect_grey(jpeg(kDc + kAc) + bad); // after the end
}

TEST(JpegTables, MoreCodesThanATableHoldsAreRefused) {
    const std::string many = segment(0xC4, table(0, counts({{10, 255}, {11, 2}}), 257));
    expect_refused("a.jpg: byte 88: a Huffman table has 257 codes, allowed are 0 to 256",
                   jpeg(many + kAc));
    std::string all(16, '\xFF');
    all.replace(0, 8, 8, '\0');
    for (const std::string& head : {std::string(), kDc + kAc}) {
        expect_refused("a Huffman table has 2040 codes",
                       jpeg(head + segment(0xC4, table(0x11, all, 2040))));
        expect_refused("a Huffman table has 2040 codes",
                       jpeg(head + segment(0xC4, kDc.substr(4) + table(1, all, 0))));
    }
    expect_refused("a Huffman table has 2040 codes", // truncated
                   kStart + kQuantizers + kFrame +
                       segment(0xC4, table(0, all, 2040)).substr(0, 30));
    expect_refused("a Huffman table has 2040 codes",
                   "\xFF" + kStart + segment(0xC4, table(0, all, 0)));
}

TEST(JpegTables, MoreCodesOfALengthThanFitAreRefused) {
    expect_refused("a Huffman table has 3 codes of 1 bits, allowed are 2",
                   jpeg(segment(0xC4, table(0, counts({{1, 3}}), 3)) + kAc));
    expect_refused("a Huffman table has 5 codes of 3 bits, allowed are 4",
                   jpeg(kDc + segment(0xC4, table(0x10, counts({{1, 1}, {3, 5}}), 6))));
}

TEST(JpegTables, AScanThatTakesATableThatIsNotThereIsRefused) {
    expect_refused("a scan takes the DC Huffman table 0, which is not there", jpeg(kAc));
    expect_refused("a scan takes the AC Huffman table 0, which is not there", jpeg(kDc));
    expect_refused("a scan takes the DC Huffman table 0", jpeg(""));
}

TEST(JpegTables, DamagedFilesNeverCrash) {
    const std::string whole = jpeg(kDc + kAc);
    const auto attempt = [](const std::string& bytes) {
        const std::vector<char> exact(bytes.begin(), bytes.end()); // ends with its memory
        try {
            const Texture image = decode_image(std::as_bytes(std::span{exact}), "a.jpg");
            EXPECT_GT(image.texels.size(), 0u);
        } catch (const Error& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        }
    };
    for (std::size_t n = 0; n < whole.size(); ++n) attempt(whole.substr(0, n));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (int value = 0; value < 256; ++value) {
            std::string bytes = whole;
            bytes[i] = static_cast<char>(value);
            attempt(bytes);
        }
    }
}

} // namespace
} // namespace heddle
