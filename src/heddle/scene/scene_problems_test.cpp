#include <heddle/scene/test_scene.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace heddle {
namespace {

using testing::problems_of;
using testing::read_text;
using testing::TempFolder;

struct Case {
    std::string text;
    std::string expected; ///< expected in the message
};

void expect_all(const std::vector<Case>& cases) {
    const TempFolder folder;
    for (const Case& c : cases) {
        const std::string lines = problems_of(folder, c.text);
        EXPECT_NE(lines.find(c.expected), std::string::npos) << c.text << "\n-> " << lines;
        EXPECT_EQ(lines.find('\n'), std::string::npos) << "one problem alone: " << lines;
    }
}

/// An object without problems, then `keys`.
std::string object_with(const std::string& keys) {
    return "[object.a]\ngenerate = { kind = \"plain\" }\n" + keys + "\n";
}
std::string light(const std::string& kind, const std::string& keys) {
    return "[[light]]\nkind = \"" + kind + "\"\n" + keys + "\n";
}
std::string material(const std::string& model, const std::string& keys) {
    return "[material.m]\nmodel = \"" + model + "\"\n" + keys + "\n";
}

TEST(SceneProblems, UnknownKeysNameTheNearest) {
    expect_all({
        {"\ncamra = 1\n",
         "scene.toml:2: unknown key 'camra' in a scene file; did you mean 'camera'?"},
        {"[camera]\nviewangle = 30\n", "did you mean 'view_angle'?"},
        {"[camera]\nkind = \"orthographic\"\nview_angle = 30\n", "unknown key 'view_angle'"},
        {light("point", "position = [0, 0, 0]\nimage = \"a.png\""),
         "unknown key 'image' in a light of kind 'point'"},
        {material("fiber", "albdo = 0.5"),
         "scene.toml:3: unknown key 'albdo' in a material of model 'fiber'; did you mean 'albedo'?"},
        {object_with("rotat = [0, 0, 1, 5]"), "did you mean 'rotate'?"},
        {object_with("[[object.a.instance]]\nmatrx = 1"), "did you mean 'matrix'?"},
        {"[object.a]\ngenerate = { kind = \"plain\", nz = 3 }\n", "unknown key 'nz' in 'generate'"},
        {material("fibre", ""), "did you mean 'fiber'? known: fiber, lobe_fiber"},
        {light("spot", ""), "'kind' is 'spot'"},
        {object_with("yarn = \"coton\""), "did you mean 'cotton'?"},
    });
}

TEST(SceneProblems, ValuesOfTheWrongTypeOrOutOfRangeAreNamed) {
    expect_all({
        {"camera = 3\n", "'camera' is of type integer, it takes a table, [camera]"},
        {"[light]\nkind = \"constant\"\n", "it takes tables, each under [[light]]"},
        {"[camera]\neye = \"here\"\n", "'eye' is of type string, it takes 3 numbers"},
        {"[camera]\neye = [1, 2]\n", "'eye' has 2 numbers, it takes 3"},
        {"[camera]\neye = [nan, 0, 0]\n", "'eye' holds nan, allowed: finite numbers"},
        {"[camera]\ntarget = [0, inf, 0]\n", "'target' holds inf"},
        {"[camera]\nview_angle = 179\n", "'view_angle' holds 179, allowed: above 0, below 179"},
        {"[camera]\nview_angle = 0\n", "'view_angle' holds 0"},
        {"[camera]\nlens_radius = -1\n", "allowed: 0 or more"},
        {"[camera]\nkind = \"orthographic\"\nview_height = 0\n", "'view_height' holds 0"},
        {"[film]\nsize = [0, 10]\n", "'size' holds 0, allowed: 1 or more, at most 65536"},
        {"[film]\nsize = [10.5, 10]\n", "fraction of a pixel"},
        {"[film]\nsize = [65536, 65536]\n", "the limit is 2^28 px"},
        {"[integrator]\nsamples = 0\n", "'samples' is 0, allowed: 1 to"},
        {"[integrator]\nsamples = 1.5\n", "it takes 1 whole number"},
        {"[integrator]\nlevel = -2\n", "'level' is -2, allowed: -1 to 40"},
        {"[integrator]\nseed = -1\n", "'seed' is -1"},
        {material("surface", "roughness = 1.5"),
         "'roughness' holds 1.5, allowed: 0 or more, at most 1"},
        {material("surface", "albedo = [0.1, true, 0.1]"), "'albedo' is of type boolean"},
        {material("lobe_fiber", "width_r = 0"), "allowed: above 0, at most 180"},
        {material("hair", "color = [0, 0.5, 0.5]"), "'color' holds 0"},
        {material("hair", "melanin = [1, 1]\nabsorption = 1"), "keep one"},
        {object_with("yarn_radius = -0.1"), "'yarn_radius' holds -0.1, allowed: above 0"},
        {object_with("yarn = \"cotton\"\nfibers = 0"), "'fibers' is 0"},
        {object_with("materials = { \"*\" = 3 }"), "'*' is of type integer"},
        {"[object]\na = 3\n", "'a' is of type integer, it takes a table"},
        {"include = \"a.toml\"\n", "'include' is of type string, it takes texts in brackets"},
    });
}

TEST(SceneProblems, WhatCannotBeRenderedIsRefused) {
    expect_all({
        {"[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\n", "'eye' and 'target' are one point"},
        {"[camera]\neye = [0, 5, 0]\n", "'up' is parallel to the view"},
        {"[camera]\nup = [0, 0, 0]\n", "scene.toml:2: 'up' has no length"},
        {light("constant", "color = 0"), "scene.toml:3: the light has no energy"},
        {light("constant", "strength = 0"), "the light has no energy"},
        {light("constant", "color = [-1, 0, 0]"), "'color' holds -1, allowed: 0 or more"},
        {light("constant", "color = 1e38\nstrength = 1e30"), "'color' times 'strength' is 1e+68"},
        {light("directional", ""), "needs 'direction'"},
        {light("directional", "direction = [0, 0, 0]"), "'direction' has no length"},
        {light("point", ""), "needs 'position'"},
        {light("environment", ""), "needs 'image'"},
        {light("area", "position = [0, 0, 0]\nedge_u = [1, 0, 0]\nedge_v = [-2, 0, 0]"),
         "'edge_u' and 'edge_v' are parallel"},
        {"[[light]]\ncolor = 1\n", "a light needs 'kind'"},
        {"[material.m]\n", "material 'm' needs 'model'"},
        {"[object.a]\n", "scene.toml:1: the object has neither volume nor geometry nor generate"},
        {"[object.a]\ngeometry = \"scene.toml\"\n",
         "no reader for the suffix '.toml'; known: .bcc"},
        {"[object.a]\ngenerate = { nx = 3 }\n", "'generate' needs 'kind'"},
        {"[object.a]\ngenerate = { kind = \"hair\", shape = \"folded\" }\n", "scene.toml:2: "},
        {object_with("fibers = 5"), "'fibers' is of no use without 'yarn'"},
        {object_with("materials = { \"*\" = \"wol\" }\n[material.wool]\nmodel = \"fiber\""),
         "scene.toml:3: no material 'wol' in the scene; did you mean 'wool'?"},
    });
}

TEST(SceneProblems, LobesThatSendOutMoreThanComesInAreRefused) {
    const std::string fix = "; lower one of them; where TT is given of what enters, color_tt is "
                            "(1 - color_r) TT";
    expect_all({
        {material("lobe_fiber", "color_r = [0.5, 0.6, 0.25]\ncolor_tt = [0.5, 0.75, 0.75]"),
         "scene.toml:4: 'color_r' and 'color_tt' sum to 1.35 in green (0.6 + 0.75), allowed: at "
         "most 1" +
             fix},
        {material("lobe_fiber", "color_tt = 0.999\ncolor_r = [0.989, 0.959, 0.874]"),
         "scene.toml:3: 'color_r' and 'color_tt' sum to 1.988 in red (0.989 + 0.999)"},
        {material("lobe_fiber", "color_r = [0, 0, 0.4]\ncolor_tt = 0.6002"),
         "sum to 1.0002 in blue"},
        // with the defaults, which are 0.1 and 0.6
        {material("lobe_fiber", "color_tt = [0, 0, 1]"), "scene.toml:3: 'color_r' and 'color_tt' "
                                                         "sum to 1.1 in blue (0.1 + 1)"},
        {material("lobe_fiber", "color_r = 0.5"), "scene.toml:3: 'color_r' and 'color_tt' sum to "
                                                  "1.1 in red (0.5 + 0.6)"},
        {material("lobe_fiber", "color_r = 1.5\ncolor_tt = 1"), "'color_r' holds 1.5"},
        {material("lobe_fiber", "color_r = 1\ncolor_tt = \"1\""), "'color_tt' is of type"},
    });
    const TempFolder folder;
    static_cast<void>(folder.write("m.toml", material("lobe_fiber", "color_r = 0.5")));
    EXPECT_NE(problems_of(folder, "include = [\"m.toml\"]\n").find("m.toml:3: 'color_r' and"),
              std::string::npos);
    for (const char* keys :
         {"", "color_r = 0.4", "color_tt = 0.9", "color_r = 1\ncolor_tt = 0",
          "color_r = 0.05\ncolor_tt = [0.95, 0.83, 0.62]", "color_r = 0.4\ncolor_tt = 0.60009"}) {
        EXPECT_NO_THROW(static_cast<void>(read_text(folder, material("lobe_fiber", keys)))) << keys;
    }
}

TEST(SceneProblems, TransformsThatFlattenAreRefused) {
    expect_all({
        {object_with("scale = 0"), "scene.toml:3: 'scale' has a zero"},
        {object_with("scale = [1, 0, 1]"), "'scale' has a zero"},
        {object_with("rotate = [0, 0, 0, 30]"), "the axis of 'rotate' has no length"},
        {object_with("matrix = [1, 0, 0, 0,  0, 1, 0, 0,  1, 1, 0, 0]"),
         "the transform is singular: its determinant is 0"},
        {object_with("matrix = [1, 2, 3, 0,  4, 5, 6, 0,  7, 8, 9, 0]"), "singular"},
        {object_with("matrix = [1, 0, 0]"), "'matrix' has 3 numbers, it takes 12"},
        {object_with("translate = [nan, 0, 0]"), "'translate' holds nan"},
        {object_with("scale = 2\nmatrix = [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0]"),
         "'scale' stands beside 'matrix'"},
        {object_with("scale = 2\n[[object.a.instance]]\nscale = 3"), "stands beside instances"},
        {object_with("instance = []"), "'instance' holds no table"},
    });
}

TEST(SceneProblems, MissingFilesAreNamed) {
    expect_all({
        {"[object.a]\nvolume = \"no.vdb\"\n", "scene.toml:2: 'volume': no file 'no.vdb'"},
        {"[object.a]\ngeometry = \"no.bcc\"\n", "'geometry': no file 'no.bcc'"},
        {object_with("yarn = \"no.toml\""), "'yarn': no file 'no.toml'"},
        {light("environment", "image = \"no.exr\""), "'image': no file 'no.exr'"},
        {"include = [\"no.toml\"]\n", "scene.toml:1: cannot include: no.toml: "},
        {"include = [\".\"]\n", "scene.toml:1: cannot include: "},
    });
    testing::expect_error(ErrorCode::NotFound, "/no/scene.toml",
                          [] { static_cast<void>(read_scene("/no/scene.toml")); });
}

TEST(SceneProblems, IncludesInACircleAreFound) {
    const TempFolder folder;
    static_cast<void>(folder.write("a.toml", "include = [\"b.toml\"]\n"));
    static_cast<void>(folder.write("b.toml", "\ninclude = [\"./scene.toml\"]\n"));
    const std::string lines = problems_of(folder, "include = [\"a.toml\"]\n");
    EXPECT_EQ(lines,
              "b.toml:2: 'scene.toml' includes itself, directly or by others; break the cycle");
    EXPECT_NE(problems_of(folder, "include = [\"scene.toml\"]\n").find("itself"),
              std::string::npos);
}

TEST(SceneProblems, ANameGivenTwiceSaysWhereTheFirstWas) {
    const TempFolder folder;
    static_cast<void>(folder.write(
        "m.toml", "[film]\nsize = [2, 2]\n[material.m]\nmodel = \"fiber\"\n" + object_with("")));
    const std::string lines =
        problems_of(folder, "include = [\"m.toml\"]\n[film]\nsize = [3, 3]\n" +
                                material("hair", "") + object_with(""));
    EXPECT_EQ(lines,
              "scene.toml:2: [film] is defined at m.toml:1 already; drop or rename one of them\n"
              "scene.toml:4: material 'm' is defined at m.toml:3 already; drop or rename one of "
              "them\n"
              "scene.toml:7: object 'a' is defined at m.toml:5 already; drop or rename one of "
              "them");
    const std::string same =
        problems_of(folder, material("hair", "") + "[ material . m ]\nmodel = \"fiber\"\n");
    EXPECT_EQ(
        same,
        "scene.toml:4: [material.m] is defined at scene.toml:1 already; drop or rename one of them");
}

TEST(SceneProblems, AllProblemsOfAFileAndItsIncludesComeAtOnceInOrder) {
    const TempFolder folder;
    static_cast<void>(folder.write("lights.toml", light("constant", "color = 0\nsize = 3")));
    static_cast<void>(folder.write("broken.toml", "a = \n"));
    const std::string lines = problems_of(
        folder, "include = [\"lights.toml\", \"broken.toml\"]\n[object.z]\n[film]\nsize = [0, 0]\n"
                "samples = 3\n[camera]\nview_angle = nan\n[integrator]\nsamples = -4\n");
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n') + 1, 8) << lines;
    const char* const order[] = {"lights.toml:3: the light has no energy",
                                 "lights.toml:4: unknown key 'size'",
                                 "broken.toml:1: is no TOML",
                                 "scene.toml:2: the object has neither",
                                 "scene.toml:4: 'size' holds 0",
                                 "scene.toml:5: unknown key 'samples'",
                                 "scene.toml:7: 'view_angle' holds",
                                 "scene.toml:9: 'samples' is -4"};
    std::size_t at = 0;
    for (const char* text : order) {
        const std::size_t found = lines.find(text);
        ASSERT_NE(found, std::string::npos) << text << "\n" << lines;
        EXPECT_GE(found, at) << lines;
        at = found;
    }
}

TEST(SceneProblems, TextThatTheParserCannotTakeIsStopped) {
    const std::string bracket = "scene.toml:1: no name follows the bracket";
    expect_all({
        {"[[[", bracket},
        {"[[[a]]]", bracket},
        {"[ {", bracket},
        {"  [\n", bracket},
        {"[[\n", bracket},
        {"[+1]", bracket},
        {"\xEF\xBB\xBF[[[", bracket},
        {"[", bracket},
        {"a = [ }", "scene.toml:1: '}' closes nothing that is open"},
        {"\na = { b = [ } ]", "scene.toml:2: '}' closes nothing"},
        {"a = [ \xE2\x80\xA8 ]", "not ASCII stands outside of quotes"},
    });
}

TEST(SceneProblems, BracketsInTextsCommentsAndListsAreNoHeaders) {
    const TempFolder folder;
    const Scene s = read_text(folder, R"(include = [ # }
]
[material."}["]
model = 'fiber'
[material.m]
model = 'fiber'
albedo = [
  0.1, # ]
 0.2, 0.3
]
[object.a]
generate = { kind = "plain" }
materials = { "]\"}" = '''m''', 'mä' = """
}[""" }
)");
    EXPECT_EQ(s.materials.at("m").albedo, (Vec3f{0.1f, 0.2f, 0.3f}));
    EXPECT_EQ(s.objects.at(0).materials.at("]\"}"), "m");
    EXPECT_EQ(s.objects.at(0).materials.at("mä"), "}[");
}

TEST(SceneProblems, DamagedFilesGiveAnErrorOrASceneAndNeverCrash) {
    const TempFolder folder;
    const std::string whole = "include = []\n[camera]\neye = [0, 1, 2]\n" +
                              light("point", "position = [1, 2, 3]") +
                              material("hair", "eta = 1.5") +
                              object_with("materials = { \"*\" = \"m\" }\n[[object.a.instance]]\n"
                                          "rotate = [0, 0, 1, 45]");
    for (std::size_t n = 0; n < whole.size(); ++n) {
        static_cast<void>(problems_of(folder, whole.substr(0, n)));
    }
    testing::flip_every_bit(folder, "scene.toml", whole,
                            [](const std::string& path) { static_cast<void>(read_scene(path)); });
}

} // namespace
} // namespace heddle
