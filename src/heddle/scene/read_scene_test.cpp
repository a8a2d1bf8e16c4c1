#include <heddle/scatter/scatter_material.h>
#include <heddle/scene/test_scene.h>

#include <gtest/gtest.h>

#include <numbers>

namespace heddle {
namespace {

using testing::read_text;
using testing::TempFolder;

/// The example in docs/scene.md.
std::string example() {
    const std::string page = testing::slurp(HEDDLE_SOURCE_DIR "/docs/scene.md");
    const std::size_t begin = page.find("```toml\n") + 8;
    return page.substr(begin, page.find("```", begin) - begin);
}

void write_inputs(const TempFolder& folder) {
    for (const char* name : {"sky.exr", "sweater.vdb", "sweater.bcc"}) {
        static_cast<void>(folder.write(name, "there"));
    }
}

class ReadScene : public ::testing::Test {
protected:
    TempFolder folder_;
};

/// A scene of one object with these keys.
SceneObject object_of(const TempFolder& folder, const std::string& keys) {
    return read_text(folder, "[object.a]\ngenerate = { kind = \"plain\" }\n" + keys).objects.at(0);
}

ScatterMaterial material_of(const TempFolder& folder, const std::string& keys) {
    return read_text(folder, "[material.m]\n" + keys).materials.at("m");
}

void expect_near(Vec3d a, Vec3d b) {
    EXPECT_NEAR(length(a - b), 0.0, 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST_F(ReadScene, TheExampleOfTheManualIsReadWhole) {
    write_inputs(folder_);
    static_cast<void>(folder_.write("lights.toml", "[[light]]\nkind = \"constant\"\n"));
    const Scene s = read_text(folder_, example());
    ASSERT_EQ(s.lights.size(), 6u);
    EXPECT_EQ(s.lights[0].kind, SceneLight::Kind::Constant) << "what is included comes first";
    EXPECT_EQ(s.lights[1].image, folder_.file("sky.exr"));
    EXPECT_EQ(s.lights[1].color, (Vec3f{2, 2, 2})) << "strength multiplies";
    EXPECT_EQ(s.lights[1].turn_deg, 90.0);
    EXPECT_NEAR(s.lights[3].direction.z, -std::numbers::sqrt2 / 2, 1e-15) << "made unit";
    EXPECT_EQ(s.lights[4].position, (Vec3d{5, -5, 10}));
    EXPECT_EQ(s.lights[5].edge_u, (Vec3d{0, 2, 0}));
    EXPECT_EQ(s.lights[5].color, (Vec3f{20, 20, 20}));
    ASSERT_TRUE(s.camera.has_value());
    EXPECT_EQ(s.camera->eye, (Vec3d{0, -20, 6}));
    EXPECT_EQ(s.camera->view_angle_deg, 30.0);
    EXPECT_EQ(s.camera->lens_radius, 0.1);
    EXPECT_EQ(s.width, 640);
    EXPECT_EQ(s.height, 480);
    EXPECT_EQ(s.integrator.samples, 64);
    EXPECT_EQ(s.integrator.level, -1);
    EXPECT_EQ(s.integrator.transport, "");
    EXPECT_EQ(s.materials.size(), 5u);
    ASSERT_EQ(s.objects.size(), 2u);
    EXPECT_EQ(s.objects[0].name, "swatch") << "a file's objects come by name";
    EXPECT_EQ(s.objects[1].volume, folder_.file("sweater.vdb"));
    EXPECT_EQ(s.objects[1].geometry, folder_.file("sweater.bcc"));
    EXPECT_EQ(s.objects[1].yarn, "cotton");
    EXPECT_EQ(s.objects[1].fibers, 120);
    EXPECT_EQ(s.objects[1].materials.at("*"), "cotton");
    ASSERT_TRUE(s.objects[0].generate.has_value());
    EXPECT_EQ(s.objects[0].generate->kind, GenerateKind::Satin);
    EXPECT_EQ(s.objects[0].generate->seed, 3u);
    ASSERT_EQ(s.objects[0].instances.size(), 2u);
    EXPECT_EQ(s.objects[0].instances[1].offset, (Vec3d{3, 0, 0}));
}

TEST_F(ReadScene, TransformsScaleThenRotateThenTranslate) {
    const SceneObject a =
        object_of(folder_, "translate = [10, 0, 0]\nrotate = [0, 0, 2, 90]\nscale = [2, 3, 4]\n");
    ASSERT_EQ(a.instances.size(), 1u);
    expect_near(a.instances[0].point({1, 0, 0}), {10, 2, 0});
    expect_near(a.instances[0].point({0, 1, 1}), {7, 0, 4});
    EXPECT_EQ(a.instances[0].x, (Vec3d{0, 2, 0})) << "quarter turns are exact";
    const SceneObject oblique = object_of(folder_, "rotate = [1, 1, 1, 120]\n");
    expect_near(oblique.instances[0].point({1, 0, 0}), {0, 1, 0});
    const SceneObject matrix =
        object_of(folder_, "matrix = [1, 2, 0, 5,  0, 1, 0, 6,  0, 0, 1, 7]\n");
    expect_near(matrix.instances[0].point({0, 1, 0}), {7, 7, 7});
    EXPECT_EQ(object_of(folder_, "").instances.at(0), Affine{});
}

TEST_F(ReadScene, MaterialsKeepTheirModelsNumbersWithAnglesInRadians) {
    const ScatterMaterial lobe =
        material_of(folder_, "model = \"lobe_fiber\"\nwidth_r = 90\ncolor_tt = [0.1, 0.2, 0.3]\n");
    EXPECT_EQ(lobe.model, ScatterModel::LobeFiber);
    EXPECT_FLOAT_EQ(lobe.width_r, std::numbers::pi_v<float> / 2);
    EXPECT_FLOAT_EQ(lobe.color_tt.z, 0.3f);
    EXPECT_EQ(material_of(folder_, "model = \"fiber\"\nalbedo = 0.5\n").model,
              ScatterModel::LambertFiber);
    EXPECT_EQ(material_of(folder_, "model = \"microflake\"\n").model,
              ScatterModel::MicroflakeSpecular);
    EXPECT_EQ(material_of(folder_, "model = \"microflake\"\nflake = \"diffuse\"\n").model,
              ScatterModel::MicroflakeDiffuse);
    EXPECT_EQ(material_of(folder_, "model = \"surface\"\nmetalness = 1\n").metalness, 1.0f);
}

TEST_F(ReadScene, HairTakesMelaninOrColorOrAbsorption) {
    const ScatterMaterial dark = material_of(folder_, "model = \"hair\"\nmelanin = [2, 1]\n");
    EXPECT_FLOAT_EQ(dark.absorption.x, 2 * 0.419f + 0.187f);
    EXPECT_FLOAT_EQ(dark.absorption.z, 2 * 1.37f + 1.05f);
    const ScatterMaterial red =
        material_of(folder_, "model = \"hair\"\nwidth_n = 0.5\ncolor = [1, 0.5, 0.1]\n");
    EXPECT_EQ(red.absorption.x, 0.0f) << "white absorbs nothing";
    const double b = 0.5;
    const double fit = 5.969 - .215 * b + 2.532 * b * b - 10.73 * b * b * b +
                       5.574 * b * b * b * b + .245 * b * b * b * b * b;
    EXPECT_NEAR(static_cast<double>(red.absorption.z), std::pow(std::log(0.1) / fit, 2), 1e-5);
    EXPECT_EQ(material_of(folder_, "model = \"hair\"\nabsorption = 3\n").absorption,
              (Vec3f{3, 3, 3}));
}

TEST_F(ReadScene, PathsAreRelativeToTheFileTheyStandIn) {
    std::filesystem::create_directory(folder_.file("sub"));
    static_cast<void>(folder_.write("sub/a.vdb", ""));
    static_cast<void>(folder_.write("sub/part.toml", "[object.a]\nvolume = \"a.vdb\"\n"));
    const Scene s = read_text(folder_, "include = [\"sub/part.toml\"]\n");
    EXPECT_EQ(s.objects.at(0).volume, folder_.file("sub/a.vdb"));
    EXPECT_FALSE(s.camera.has_value());
    EXPECT_EQ(s.width, 512);
}

TEST_F(ReadScene, AFileIncludedTwiceIsReadOnce) {
    static_cast<void>(folder_.write("m.toml", "[material.m]\nmodel = \"fiber\"\n"));
    static_cast<void>(folder_.write("a.toml", "include = [\"m.toml\"]\n"));
    const Scene s = read_text(folder_, "include = [\"a.toml\", \"m.toml\", \"./m.toml\"]\n");
    EXPECT_EQ(s.materials.size(), 1u);
}

} // namespace
} // namespace heddle
