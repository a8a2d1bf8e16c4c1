#include <heddle/io/yarn/yarn_file.h>

#include <heddle/base/error.h>
#include <heddle/io/file/test_files.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace heddle {
namespace {

namespace fs = std::filesystem;

const std::string kFit = R"(ply_num: 3
fiber_num: 75

aabb_min: [-0.05,-0.05,-0.48]
z_step_num: 98
yarn_clock_wise: 0
fiber_clock_wise: 1
yarn_alpha: 0.45
alpha: 0.36
yarn_radius: 0.038
ellipse_long: 0.026
ellipse_short: 0.02
epsilon: 0
beta: 0.2
R_max: 1
use_migration: 1
s_i: 1.5
rho_min: 0.85
rho_max: 1
use_flyaways: 1
flyaway_hair_density: 30.5
flyaway_hair_ze: 0.002 0.063
flyaway_hair_r0: 0.02 0.005
flyaway_hair_re: 0.016 0.009
flyaway_hair_pe: 0.39 0.34
flyaway_loop_density: 19.1
flyaway_loop_r1: 0.024 0.005
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

/// The text of the Error, each line of which names the file; empty if there is none.
template <typename F>
std::string error_of(const std::string& path, const F& f) {
    try {
        static_cast<void>(f());
    } catch (const Error& e) {
        std::istringstream lines(e.what());
        for (std::string line; std::getline(lines, line);) EXPECT_HAS(line, path);
        return e.what();
    }
    return {};
}
std::string fit_error(const std::string& text) {
    return error_of("a.txt", [&] { return parse_yarn_fit(text, "a.txt"); });
}
std::string toml_error(const std::string& text) {
    return error_of("a.toml", [&] { return parse_yarn_toml(text, "a.toml"); });
}

TEST(YarnFile, FitGivesEveryParameter) {
    const YarnFile f = parse_yarn_fit(kFit, "dir/cotton9.txt");
    const YarnType& y = f.yarn;
    EXPECT_EQ(y.name, "cotton9");
    EXPECT_EQ(y.model, YarnModel::Procedural);
    EXPECT_EQ(y.fiber_count(), 225);
    EXPECT_EQ(y.model_radius, 0.038f);
    EXPECT_EQ(y.ply_offset, 0.019f);
    EXPECT_EQ(y.ply_pitch, 0.45f);
    EXPECT_EQ(y.fiber_pitch, 0.36f);
    EXPECT_FALSE(y.ply_clockwise);
    EXPECT_TRUE(y.fiber_clockwise);
    EXPECT_EQ(y.ellipse_long, 0.026f);
    EXPECT_EQ(y.ellipse_short, 0.02f);
    EXPECT_EQ(y.density_epsilon, 0.0f);
    EXPECT_EQ(y.density_beta, 0.2f);
    EXPECT_EQ(y.density_r_max, 1.0f);
    EXPECT_TRUE(y.migration);
    EXPECT_EQ(y.migration_frequency, 1.5f);
    EXPECT_EQ(y.migration_min, 0.85f);
    EXPECT_EQ(y.migration_max, 1.0f);
    EXPECT_TRUE(y.flyaways);
    EXPECT_EQ(y.hair_density, 30.5f);
    EXPECT_EQ(y.hair_ze.mean, 0.002f);
    EXPECT_EQ(y.hair_ze.sd, 0.063f);
    EXPECT_EQ(y.hair_r0.mean, 0.02f);
    EXPECT_EQ(y.hair_re.sd, 0.009f);
    EXPECT_EQ(y.hair_pe.mean, 0.39f);
    EXPECT_EQ(y.loop_density, 19.1f);
    EXPECT_EQ(y.loop_r1.mean, 0.024f);
    ASSERT_EQ(f.notes.size(), 1u);
    EXPECT_HAS(f.notes[0], "no fiber radius");
}

TEST(YarnFile, DefaultFiberRadiusFillsTheDocumentedPartOfAPly) {
    const YarnType y = parse_yarn_fit(kFit, "a.txt").yarn;
    const float fill = y.fiber_radius * y.fiber_radius * 75.0f / (y.ellipse_long * y.ellipse_short);
    EXPECT_NEAR(fill, kDefaultFill, 1e-4f);
}

TEST(YarnFile, FitProblemsNameLineKeyAndNearestKey) {
    EXPECT_HAS(fit_error(replaced(kFit, "ellipse_long", "elipse_long")),
               "a.txt:11: unknown key 'elipse_long'; did you mean 'ellipse_long'?");
    EXPECT_HAS(fit_error(replaced(kFit, "alpha: 0.45", "alpha: zero")), "a.txt:8: 'yarn_alpha'");
    EXPECT_HAS(fit_error(replaced(kFit, "alpha: 0.45", "alpha: 0")), "above 0");
    EXPECT_HAS(fit_error(kFit + "s_i: 2\n"), "a.txt:28: 's_i' stands on line 17 already");
    EXPECT_HAS(fit_error(replaced(kFit, "0.063", "-0.063")),
               "a.txt:22: 'flyaway_hair_ze' is -0.063");
    EXPECT_HAS(fit_error(replaced(kFit, " 0.063", "")), "has 1 numbers, it takes 2");
    const std::string two =
        fit_error(replaced(replaced(kFit, "75", "1e999"), "ply_num: 3", "ply_num: 0"));
    EXPECT_HAS(two, "a.txt:1: 'ply_num' is 0, it must be from 1 to 1e+06");
    EXPECT_HAS(two, "a.txt:2: 'fiber_num' is inf");
}

TEST(YarnFile, FitRefusesWhatIsNoNumberOrOutOfRange) {
    for (const char* bad : {"nan", "-nan", "inf", "-1", "1e300", "-1e300", "1e-300", "1e999",
                            "0x10", "", "1 2", "1,", "--1", "1..2", "one"}) {
        const std::string text = replaced(kFit, "yarn_radius: 0.038", str("yarn_radius: ", bad));
        if (std::string(bad) == "1,") {
            EXPECT_EQ(fit_error(text), ""); // separators may vary
        } else {
            EXPECT_HAS(fit_error(text), "a.txt:10: ");
        }
    }
    EXPECT_HAS(fit_error(replaced(kFit, "75", "74.5")), "whole number");
    EXPECT_HAS(fit_error(replaced(kFit, "75", "1000000")), "at most 1000000");
    EXPECT_HAS(fit_error(replaced(kFit, "rho_max: 1", "rho_max: 0.5")), "is above its largest");
    EXPECT_HAS(fit_error(""), "'ply_num' is missing");
    EXPECT_HAS(fit_error("\n\n"), "is missing");
    EXPECT_HAS(fit_error(std::string(1000, '\0')), "key: value");
    EXPECT_HAS(fit_error(std::string(100000, 'x') + ": 1"), "unknown key");
}

TEST(YarnFile, EveryTruncationOfAFitIsAnErrorOrAYarn) {
    std::size_t good = 0;
    for (std::size_t n = 0; n < kFit.size(); ++n) {
        if (fit_error(kFit.substr(0, n)).empty()) ++good;
    }
    EXPECT_LE(good, 7u); // only within the last number of the last line
}

TEST(YarnFile, EveryTruncationAndFlippedByteOfATomlIsAnErrorOrAYarn) {
    const std::string text = write_yarn_toml(read_yarn("wool").yarn);
    for (std::size_t n = 0; n < text.size(); ++n) {
        static_cast<void>(toml_error(text.substr(0, n)));
        std::string flipped = text;
        flipped[n] = static_cast<char>(flipped[n] ^ (1 << (n % 8)));
        static_cast<void>(toml_error(flipped));
    }
    EXPECT_HAS(toml_error(""), "'model' is missing");
}

bool same(const YarnType& a, const YarnType& b) {
    return write_yarn_toml(a) == write_yarn_toml(b);
}

TEST(YarnFile, PresetsSurviveTheTomlFormBitForBit) {
    for (const std::string& name : list_presets()) {
        const YarnFile f = read_yarn(name);
        EXPECT_TRUE(f.notes.empty());
        const YarnFile back = parse_yarn_toml(write_yarn_toml(f.yarn), "x.toml");
        EXPECT_TRUE(back.notes.empty());
        EXPECT_EQ(back.yarn.name, name);
        EXPECT_EQ(back.yarn.fiber_radius, f.yarn.fiber_radius);
        EXPECT_EQ(back.yarn.hair_ze.sd, f.yarn.hair_ze.sd);
        EXPECT_EQ(back.yarn.albedo, f.yarn.albedo);
        EXPECT_EQ(back.yarn.flyaways, f.yarn.flyaways);
        EXPECT_TRUE(same(f.yarn, back.yarn));
    }
    const YarnType fit = parse_yarn_fit(kFit, "a.txt").yarn;
    EXPECT_TRUE(same(fit, parse_yarn_toml(write_yarn_toml(fit), "a.toml").yarn));
}

/// The fields of the presets.
YarnType cotton() {
    YarnType y;
    y.name = "cotton";
    y.model = YarnModel::Procedural;
    y.albedo = {0.85f, 0.83f, 0.78f};
    y.plies = 3;
    y.fibers_per_ply = 60;
    y.fiber_clockwise = true;
    y.ply_pitch = 11.0f;
    y.fiber_pitch = 9.0f;
    y.ply_offset = 0.52f;
    y.ellipse_long = 0.56f;
    y.ellipse_short = 0.46f;
    y.density_beta = 0.25f;
    y.migration = true;
    y.migration_min = 0.9f;
    y.flyaways = true;
    y.hair_density = 0.6f;
    y.hair_ze = {0.1f, 1.2f};
    y.hair_r0 = {0.5f, 0.1f};
    y.hair_re = {0.3f, 0.2f};
    y.hair_pe = {0.4f, 0.35f};
    y.loop_density = 0.4f;
    y.loop_r1 = {0.58f, 0.08f};
    y.fiber_radius = 0.048f;
    return y;
}

YarnType silk() {
    YarnType y;
    y.name = "silk";
    y.model = YarnModel::Procedural;
    y.albedo = {0.88f, 0.82f, 0.74f};
    y.plies = 2;
    y.fibers_per_ply = 100;
    y.fiber_clockwise = true;
    y.ply_pitch = 16.0f;
    y.fiber_pitch = 24.0f;
    y.ply_offset = 0.5f;
    y.ellipse_long = 0.58f;
    y.ellipse_short = 0.5f;
    y.density_epsilon = 0.45f;
    y.density_beta = 0.1f;
    y.fiber_radius = 0.04f;
    return y;
}

YarnType wool() {
    YarnType y;
    y.name = "wool";
    y.model = YarnModel::Procedural;
    y.albedo = {0.72f, 0.62f, 0.48f};
    y.plies = 2;
    y.fibers_per_ply = 90;
    y.ply_clockwise = true;
    y.ply_pitch = 9.0f;
    y.fiber_pitch = 10.0f;
    y.ply_offset = 0.48f;
    y.ellipse_long = 0.68f;
    y.ellipse_short = 0.52f;
    y.density_epsilon = 0.15f;
    y.density_beta = 0.6f;
    y.migration = true;
    y.migration_frequency = 1.9f;
    y.migration_min = 0.75f;
    y.flyaways = true;
    y.hair_density = 3.0f;
    y.hair_ze = {0.3f, 1.6f};
    y.hair_r0 = {0.65f, 0.15f};
    y.hair_re = {0.6f, 0.4f};
    y.hair_pe = {0.5f, 0.5f};
    y.loop_density = 3.0f;
    y.loop_r1 = {0.85f, 0.22f};
    y.fiber_radius = 0.04f;
    return y;
}

TEST(YarnFile, PresetsHaveTheseNumbersToTheBit) {
    EXPECT_EQ(list_presets(), (std::vector<std::string>{"cotton", "silk", "wool"}));
    for (const YarnType& yarn : {cotton(), silk(), wool()}) {
        const YarnFile file = read_yarn(yarn.name);
        EXPECT_TRUE(same(file.yarn, yarn)) << yarn.name;
        EXPECT_TRUE(file.notes.empty());
    }
}

TEST(YarnFile, PresetsAreSoundYarns) {
    EXPECT_EQ(read_yarn("wool").yarn.plies, 2);
    EXPECT_EQ(read_yarn("cotton").yarn.plies, 3);
    EXPECT_FALSE(read_yarn("silk").yarn.flyaways);
    for (const std::string& name : list_presets()) {
        const YarnType y = read_yarn(name).yarn;
        const float fill = y.fiber_radius * y.fiber_radius * static_cast<float>(y.fibers_per_ply) /
                           (y.ellipse_long * y.ellipse_short);
        EXPECT_GT(fill, 0.35f) << name;
        EXPECT_LT(fill, 0.65f) << name;
        EXPECT_NEAR(y.ply_offset + y.ellipse_short, y.model_radius, 0.05f) << name;
    }
}

TEST(YarnFile, TomlProblemsNameLineKeyAndNearestKey) {
    EXPECT_HAS(toml_error("model = \"procedural\"\nplys = 3\n"),
               "a.toml:2: unknown key 'plys'; did you mean 'plies'?");
    EXPECT_HAS(toml_error("model = \"knitted\"\n"), "a.toml:1: 'model' must be");
    EXPECT_HAS(toml_error("model = 3\n"), "a.toml:1: 'model' must be");
    EXPECT_HAS(toml_error("model = \"solid\"\nplies = 3\n"), "belongs to the model \"procedural\"");
    EXPECT_HAS(toml_error("model = \"procedural\"\nplies = 3\nplies = 2\n"), "a.toml:3:");
    EXPECT_HAS(toml_error("model = \"procedural\"\nplies = \"3\"\n"), "a.toml:2: 'plies' needs");
    EXPECT_HAS(toml_error("model = \"procedural\"\nflyaways = 1\n"), "must be true or false");
    EXPECT_HAS(toml_error("model = \"procedural\"\nhair_ze = [1]\n"), "it takes 2");
    EXPECT_HAS(toml_error("model = \"procedural\"\nhair_ze = [1, \"a\"]\n"), "needs numbers");
    EXPECT_HAS(toml_error("model = \"procedural\"\n[plies]\nx = 1\n"), "a.toml:2: 'plies' needs");
    EXPECT_HAS(toml_error("model = \"procedural\"\nplies = {x = 1}\n"), "'plies' needs numbers");
    EXPECT_HAS(toml_error("model = \"solid\"\nalbedo = [0.5, 0.5, 1.5]\n"),
               "it must be from 0 to 1");
    for (const char* bad : {"nan", "-inf", "0", "-1", "1e39", "1e-60"}) {
        EXPECT_HAS(toml_error(str("model = \"procedural\"\nply_pitch = ", bad)), "a.toml:2:");
    }
    const std::string two = toml_error("model = \"procedural\"\nplies = 0\nellipse_long = -1\n");
    EXPECT_HAS(two, "'plies' is 0");
    EXPECT_HAS(two, "'ellipse_long' is -1");
    EXPECT_HAS(toml_error(std::string(5000, '[')), "a.toml:1: no name follows the bracket");
    EXPECT_HAS(toml_error("a = [ } ]"), "a.toml:1: '}' closes nothing that is open");
}

TEST(YarnFile, SliceImageIsLoadedRelativeToTheFile) {
    std::string asked;
    const LoadTexture load = [&](const std::string& path) {
        asked = path;
        Texture t;
        t.width = 2;
        t.height = 1;
        t.channels = 4;
        t.texels = {255, 255, 255, 255, 255, 255, 255, 0};
        return t;
    };
    const std::string text = "model = \"slice\"\nslice = \"img/a.png\"\ntwist = -2.5\n";
    const YarnFile f = parse_yarn_toml(text, "dir/y.toml", load);
    EXPECT_EQ(asked, "dir/img/a.png");
    EXPECT_EQ(f.yarn.twist, -2.5f);
    EXPECT_EQ(f.yarn.slice.width, 2);
    // 150 fibers of that radius fill half of the square of side 2
    EXPECT_NEAR(150.0f * 3.14159265f * f.yarn.fiber_radius * f.yarn.fiber_radius, 2.0f, 1e-3f);
    EXPECT_TRUE(same(f.yarn, parse_yarn_toml(write_yarn_toml(f.yarn), "dir/y.toml", load).yarn));
    EXPECT_HAS(toml_error(text), "no image can be loaded");
    EXPECT_HAS(toml_error("model = \"slice\"\n"), "'slice' is missing");
}

TEST(YarnFile, ASliceImageWithoutAlphaIsAProblemOfItsLine) {
    const LoadTexture load = [](const std::string&) {
        Texture t;
        t.width = 1;
        t.height = 1;
        t.channels = 3;
        t.texels = {255, 255, 255};
        return t;
    };
    try {
        (void)parse_yarn_toml("model = \"slice\"\nslice = \"a.png\"\n", "y.toml", load);
        FAIL();
    } catch (const Error& e) {
        EXPECT_HAS(std::string(e.what()), "y.toml:2: the image 'a.png' has 3 channels");
    }
}

TEST(YarnFile, FiberCountIsSplitOverPliesAndKeepsTheFill) {
    YarnType y = read_yarn("cotton").yarn;
    const auto area = [](const YarnType& t) {
        return static_cast<float>(t.fiber_count()) * t.fiber_radius * t.fiber_radius;
    };
    const float before = area(y);
    EXPECT_EQ(set_fiber_count(y, 450), "");
    EXPECT_EQ(y.fibers_per_ply, 150);
    EXPECT_NEAR(area(y), before, 1e-5f * before);
    EXPECT_HAS(set_fiber_count(y, 50), "51 are used");
    EXPECT_EQ(y.fiber_count(), 51);
    EXPECT_HAS(set_fiber_count(y, 1), "3 are used");
    EXPECT_NEAR(area(y), before, 1e-5f * before);
    for (const std::int64_t bad : {std::int64_t{0}, std::int64_t{-5}, std::int64_t{1} << 40}) {
        EXPECT_THROW(set_fiber_count(y, bad), Error);
    }
    YarnType solid;
    EXPECT_EQ(set_fiber_count(solid, 1), "");
    EXPECT_THROW(set_fiber_count(solid, 2), Error);
}

TEST(YarnFile, UnusablePathsAreErrors) {
    const testing::TempFolder folder;
    fs::create_directories(folder.file("folder.toml"));
    const auto error = [](const std::string& p) {
        return error_of(p, [&] { return read_yarn(p); });
    };
    EXPECT_HAS(error("wol"), "did you mean 'wool'?");
    EXPECT_HAS(error("no/such.toml"), "no yarn preset or file");
    EXPECT_HAS(error(""), "no yarn preset or file");
    EXPECT_HAS(error(folder.file("folder.toml")), "is a directory");
    EXPECT_HAS(error(folder.write("yarn.obj", kFit)), "'.obj'");
    EXPECT_HAS(error(folder.write("yarn.toml", kFit)), "yarn.toml:1:");
    EXPECT_HAS(error(folder.write("empty.txt", "")), "is missing");
    EXPECT_HAS(error(folder.write("empty.toml", "")), "'model' is missing");
    EXPECT_HAS(error(folder.write("large.txt", std::string((1 << 20) + 1, ' '))),
               "limit for this kind is 1048576");
    EXPECT_EQ(error(folder.write("good.txt", kFit)), "");
}

TEST(YarnFile, EveryPublishedFitIsRead) {
    const std::string folder = testing::find_data("params/zhao2016");
    if (folder.empty()) GTEST_SKIP() << "no Zhao 2016 fits; set HEDDLE_TEST_DATA";
    int read = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".txt") continue;
        const YarnFile f = read_yarn(entry.path().string());
        EXPECT_GE(f.yarn.plies, 2);
        EXPECT_TRUE(f.yarn.flyaways);
        EXPECT_EQ(f.notes.size(), 1u);
        const std::string text = testing::slurp(entry.path().string());
        for (std::size_t n = 0; n < text.size(); ++n) {
            static_cast<void>(fit_error(text.substr(0, n)));
        }
        ++read;
    }
    EXPECT_EQ(read, 7);
}

} // namespace
} // namespace heddle
