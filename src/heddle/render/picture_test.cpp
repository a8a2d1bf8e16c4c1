#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/render/render.h>
#include <heddle/render/volume/test_volume.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numbers>

namespace heddle {
namespace {

using namespace heddle::testing;

PathSample sample_of(Vec3f radiance, float transmittance = 0.0f) {
    PathSample sample;
    sample.radiance = radiance;
    sample.transmittance = transmittance;
    return sample;
}

PathSample hit_of(Vec3f axis, float depth) {
    PathSample sample = sample_of({1, 1, 1});
    sample.first = {true, depth, axis, {0.5f, 0.25f, 0.125f}, 2.0f, 3};
    return sample;
}

std::map<std::string, float> first_pixel(const Picture& picture) {
    std::map<std::string, float> out;
    for (const PictureChannel& c : channels_of(picture, true)) out[c.name] = c.values.at(0);
    return out;
}

TEST(Picture, ChannelsAreMeansOfTheSamples) {
    Picture picture(1, 1);
    picture.pixels[0].add(hit_of({0, 0, 1}, 4.0f));
    picture.pixels[0].add(hit_of({0, 0, 1}, 6.0f));
    picture.pixels[0].add(sample_of({4, 1, 7}, 1.0f));
    auto pixel = first_pixel(picture);
    EXPECT_EQ(pixel.size(), 16u);
    EXPECT_FLOAT_EQ(pixel["R"], 2.0f);
    EXPECT_FLOAT_EQ(pixel["G"], 1.0f);
    EXPECT_FLOAT_EQ(pixel["B"], 3.0f);
    EXPECT_FLOAT_EQ(pixel["transmittance"], 1.0f / 3.0f);
    EXPECT_FLOAT_EQ(pixel["A"], 2.0f / 3.0f);
    EXPECT_FLOAT_EQ(pixel["depth"], 5.0f); // of those that met something
    EXPECT_FLOAT_EQ(pixel["level"], 2.0f);
    EXPECT_FLOAT_EQ(pixel["albedo.G"], 0.25f);
    EXPECT_EQ(pixel["material"], 3.0f);
    EXPECT_EQ(pixel["samples"], 3.0f);
    EXPECT_EQ(channels_of(picture, false).size(), 4u);
}

TEST(Picture, AnEmptyPixelIsBlackAndHasNoMaterial) {
    auto pixel = first_pixel(Picture(1, 1));
    EXPECT_EQ(pixel["R"], 0.0f);
    EXPECT_EQ(pixel["depth"], 0.0f);
    EXPECT_EQ(pixel["material"], -1.0f);
    for (const auto& [name, value] : pixel) EXPECT_TRUE(std::isfinite(value)) << name;
}

// Tangents have no sign: a fan about x whose ends come first, drawn with either sign.
TEST(Picture, TheMeanAxisIsThatOfAxesWithoutSign) {
    Picture picture(1, 1);
    for (const int i : {-8, 8, -7, 7, -6, 6, -5, 5, -4, 4, -3, 3, -2, 2, -1, 1, 0}) {
        const double angle = 0.17 * i;
        const double sign = i % 3 == 0 ? -1.0 : 1.0;
        picture.pixels[0].add(
            hit_of(to_float(Vec3d{std::cos(angle), std::sin(angle), 0.0} * sign), 1.0f));
    }
    auto pixel = first_pixel(picture);
    EXPECT_NEAR(std::fabs(pixel["axis.X"]), 1.0f, 1e-3f);
    EXPECT_NEAR(pixel["axis.Y"], 0.0f, 1e-3f);
}

TEST(Picture, TheMeanOfNormalsKeepsTheirSide) {
    Picture picture(1, 1);
    for (const float x : {-0.5f, 0.5f, 0.2f, -0.2f}) {
        picture.pixels[0].add(hit_of(normalize(Vec3f{x, 0, -1}), 1.0f));
    }
    EXPECT_NEAR(first_pixel(picture)["axis.Z"], -1.0f, 1e-4f);
}

TEST(Picture, NoiseIsTheErrorOfTheMean) {
    Picture picture(64, 64);
    EXPECT_EQ(picture.noise(), 0.0);
    StreamRandom random{3};
    MeanOf errors;
    for (PixelSums& p : picture.pixels) {
        for (int s = 0; s < 64; ++s) {
            const float x = random.uniform();
            p.add(sample_of({x, x, x}));
        }
        errors.add((p.red / 64.0 - 0.5) * (p.red / 64.0 - 0.5));
    }
    EXPECT_NEAR(picture.noise(), std::sqrt(1.0 / 12.0 / 64.0), 5e-4);
    EXPECT_NEAR(picture.noise(), std::sqrt(errors.mean()), 2e-3);
    auto pixel = first_pixel(picture);
    EXPECT_NEAR(pixel["variance"], 1.0 / 12.0 / 64.0, 4e-4);
}

TEST(Picture, ASampleThatIsNoNumberLeavesThePixelFinite) {
    Picture picture(1, 1);
    picture.pixels[0].add(sample_of({1, 1, 1}));
    picture.pixels[0].add(sample_of({std::numeric_limits<float>::quiet_NaN(), 1, 1}));
    picture.pixels[0].add(sample_of({std::numeric_limits<float>::infinity(), 1, 1}));
    EXPECT_TRUE(std::isfinite(first_pixel(picture)["R"]));
}

TEST(Picture, BytesFollowTheSrgbCurve) {
    Picture picture(5, 1);
    const float grey[] = {0.0f, 0.002f, 0.2158605f, 1.0f, 40.0f};
    for (std::size_t i = 0; i < 5; ++i) picture.pixels[i].add(sample_of(Vec3f{1, 1, 1} * grey[i]));
    const std::vector<std::uint8_t> bytes = to_srgb8(picture, 0.0);
    ASSERT_EQ(bytes.size(), 20u);
    EXPECT_EQ(bytes[0], 0);
    EXPECT_EQ(bytes[4], 7); // 12.92 x 0.002 x 255
    EXPECT_EQ(bytes[8], 128);
    EXPECT_EQ(bytes[12], 255);
    EXPECT_EQ(bytes[16], 255);
    EXPECT_EQ(bytes[19], 255);
    EXPECT_EQ(to_srgb8(picture, -1.0)[12], 188);
    picture.pixels[0].red = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(to_srgb8(picture, 0.0)[0], 0);
}

class RenderPass : public ::testing::Test {
protected:
    RenderPass() : camera_(parameters(), 33, 18) {
        VoxelMap voxels;
        StreamRandom random{3};
        add_random(voxels, random, {-3, -3, -3}, 6, 200, 0.8);
        scene_.volumes.push_back(volume_of(voxels));
        scene_.materials.resize(1);
        scene_.materials[0].model = ScatterModel::LambertFiber;
        scene_.lights = LightSet({Light{}}, 5.0);
    }
    ~RenderPass() override { set_thread_count(0); }
    static CameraParameters parameters() {
        CameraParameters parameters;
        parameters.eye = {1, 2, 12};
        return parameters;
    }
    void pass(Picture& picture, std::uint32_t samples) {
        Progress progress;
        render_pass(scene_, camera_, {}, 7, samples, picture, progress);
    }
    [[nodiscard]] static std::vector<float> all_of(const Picture& picture) {
        std::vector<float> out;
        for (const PictureChannel& c : channels_of(picture, true)) {
            out.insert(out.end(), c.values.begin(), c.values.end());
        }
        return out;
    }
    PathScene scene_;
    Camera camera_;
};

TEST_F(RenderPass, OneThreadAndManyGiveTheSameBits) {
    Picture one(33, 18), many(33, 18);
    set_thread_count(1);
    pass(one, 4);
    set_thread_count(4);
    pass(many, 4);
    EXPECT_EQ(all_of(one), all_of(many));
    EXPECT_GT(one.noise(), 0.0);
}

TEST_F(RenderPass, PassesAddUpToOneInOneGo) {
    Picture whole(33, 18), parts(33, 18);
    pass(whole, 4);
    pass(parts, 1);
    pass(parts, 4);
    EXPECT_EQ(all_of(whole), all_of(parts));
    EXPECT_EQ(parts.pixels.back().samples, 4u);
}

TEST_F(RenderPass, ACancelledPassLeavesThePictureAsItWas) {
    Picture picture(1025, 18); // more tiles than threads
    pass(picture, 2);
    const std::vector<float> before = all_of(picture);
    struct Stop final : Progress {
        void advance(std::int64_t) override { cancel(); }
    } progress;
    try {
        render_pass(scene_, camera_, {}, 7, 64, picture, progress);
        FAIL() << "was not cancelled";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::Cancelled);
    }
    EXPECT_EQ(all_of(picture), before);
}

} // namespace
} // namespace heddle
