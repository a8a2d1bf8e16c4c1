#include <heddle/stage/checkpoint.h>

#include <heddle/io/file/test_files.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::testing;

constexpr std::uint64_t kScene = 42;

Picture small_picture() {
    Picture picture(5, 3);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        PathSample sample;
        sample.radiance = Vec3f{0.1f, 0.2f, 0.3f} * static_cast<float>(i);
        sample.first = {i % 2 == 0, 3.0f, {0, 0, 1}, {1, 1, 1}, 1.0f, 2};
        picture.pixels[i].add(sample);
    }
    return picture;
}

std::vector<float> all_of(const Picture& picture) {
    std::vector<float> out;
    for (const PictureChannel& c : channels_of(picture, true)) {
        out.insert(out.end(), c.values.begin(), c.values.end());
    }
    return out;
}

std::string refused(const std::string& path, std::uint64_t scene = kScene, int w = 5, int h = 3) {
    const auto error = error_of([&] { static_cast<void>(read_checkpoint(path, scene, w, h)); });
    if (!error) return "";
    EXPECT_EQ(error->code(), ErrorCode::BadFile) << error->what();
    return error->what();
}

TEST(Checkpoint, ComesBackAsItWas) {
    const TempFolder folder;
    const std::string path = folder.file("a.checkpoint");
    write_checkpoint(path, kScene, small_picture());
    const Picture back = read_checkpoint(path, kScene, 5, 3);
    EXPECT_EQ(all_of(back), all_of(small_picture()));
    EXPECT_EQ(back.pixels[3].samples, 1u);
}

TEST(Checkpoint, OfAnotherSceneOrSizeIsRefused) {
    const TempFolder folder;
    const std::string path = folder.file("a.checkpoint");
    write_checkpoint(path, kScene, small_picture());
    EXPECT_NE(refused(path, 43).find("another scene"), std::string::npos);
    EXPECT_NE(refused(path, kScene, 3, 5).find("5 x 3"), std::string::npos);
    const auto missing =
        error_of([&] { static_cast<void>(read_checkpoint(folder.file("none"), kScene, 5, 3)); });
    ASSERT_TRUE(missing.has_value());
    EXPECT_EQ(missing->code(), ErrorCode::NotFound);
}

TEST(Checkpoint, CutAtAnyByteItIsRefused) {
    const TempFolder folder;
    const std::string path = folder.file("a.checkpoint");
    write_checkpoint(path, kScene, small_picture());
    const std::string whole = slurp(path);
    for (std::size_t n = 0; n < whole.size(); ++n) {
        EXPECT_NE(refused(folder.write("cut", whole.substr(0, n))), "") << n;
    }
    EXPECT_NE(refused(folder.write("long", whole + "x")), "");
}

TEST(Checkpoint, WithAnyBitFlippedItIsRefused) {
    const TempFolder folder;
    const std::string path = folder.file("a.checkpoint");
    write_checkpoint(path, kScene, small_picture());
    const std::string whole = slurp(path);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string bytes = whole;
        bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
        EXPECT_NE(refused(folder.write("flipped", bytes)), "") << i;
    }
}

} // namespace
} // namespace heddle
