#include <heddle/stage/stage.h>

#include <heddle/io/image/image.h>
#include <heddle/stage/scene_hash.h>
#include <heddle/stage/test_stage.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using namespace heddle::testing;

int all_read(Stage& stage) {
    while (stage.load_next_level()) {
    }
    return finest_read(stage);
}

TEST(Stage, ADistantCameraReadsCoarseLevelsAlone) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    Progress progress;
    for (const auto& [voxels, finest] :
         {std::pair{0.3, 0}, {1.3, 0}, {2.6, 1}, {10.5, 3}, {99.0, 4}}) {
        scene.camera = camera_at(scene, voxels);
        Stage stage(scene, {}, progress);
        const int read = all_read(stage);
        EXPECT_LE(read, finest) << voxels; // what the middle of the picture asks for
        EXPECT_GE(read, finest - 1) << voxels;
    }
}

TEST(Stage, AnOffsetReadsTheLevelsThatItAsksFor) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    scene.camera = camera_at(scene, 10.5);
    Progress progress;
    Stage plain(scene, {}, progress), finer(scene, {false, -2.0f}, progress);
    EXPECT_EQ(all_read(finer), all_read(plain) - 2);
}

TEST(Stage, NoRayAsksForALevelThatWillNotBeRead) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    Progress progress;
    StreamRandom random{5};
    for (int i = 0; i < 60; ++i) {
        SceneCamera camera;
        const auto draw = [&](double most) { return most * static_cast<double>(random.uniform()); };
        camera.eye = {draw(30.0) - 15.0, draw(30.0) - 15.0, 0.5 + draw(30.0)};
        camera.target = {draw(2.0) - 1.0, draw(2.0) - 1.0, 0.0};
        camera.view_angle_deg = 5.0 + draw(120.0);
        camera.lens_radius = i % 4 == 0 ? 0.3 : 0.0;
        scene.width = i % 3 == 0 ? 64 : 12;
        scene.camera = camera;
        Stage stage(scene, {}, progress);
        const int read = all_read(stage);
        for (int p = 0; p < 400; ++p) {
            const Ray ray = stage.camera().ray(static_cast<float>(draw(scene.width)),
                                               static_cast<float>(draw(scene.height)),
                                               {random.uniform(), random.uniform()});
            const double t = (0.4 - ray.origin.z) / static_cast<double>(ray.direction.z);
            const Vec3d at = ray.at(t);
            if (!(t > 0.0) || std::fabs(at.x) > 1.6 || std::fabs(at.y) > 1.6) continue;
            const double level =
                std::log2(static_cast<double>(ray.width_at(static_cast<float>(t))) / 0.1);
            ASSERT_GE(std::clamp(std::floor(level + 1e-6), 0.0, 4.0), read);
        }
    }
}

TEST(Stage, LevelsComeCoarsestFirst) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    scene.camera = camera_at(scene, 0.5);
    Progress progress;
    Stage stage(scene, {false, 0.0f, 100}, progress);
    EXPECT_EQ(finest_read(stage), 2); // 64 voxels
    EXPECT_TRUE(stage.load_next_level());
    EXPECT_EQ(finest_read(stage), 1);
    EXPECT_TRUE(stage.load_next_level());
    EXPECT_EQ(finest_read(stage), 0);
    EXPECT_FALSE(stage.load_next_level());
}

TEST(Stage, AVolumeThatDoesNotSayWhereItsMatterIsIsNoted) {
    const TempFolder folder;
    struct Notes : Progress {
        std::vector<std::string> sentences;
        void note(std::string_view sentence) override { sentences.emplace_back(sentence); }
    } notes;
    Scene scene = slab_scene(folder);
    const Stage automatic(scene, {}, notes);
    ASSERT_EQ(notes.sentences.size(), 1u);
    EXPECT_NE(notes.sentences[0].find("voxelize it again"), std::string::npos);
    scene.integrator.transport = "product";
    const Stage chosen(scene, {}, notes);
    EXPECT_EQ(notes.sentences.size(), 1u);
}

TEST(Stage, AForcedLevelIsReadAndNoneFiner) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    scene.camera = camera_at(scene, 0.5);
    scene.integrator.level = 2;
    Progress progress;
    Stage stage(scene, {}, progress);
    EXPECT_EQ(all_read(stage), 2);
    scene.integrator.level = 5;
    const auto error = error_of([&] { Stage(scene, {}, progress); });
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), ErrorCode::BadFile);
    EXPECT_NE(std::string(error->what()).find("slab.vdb: has no level 5 (levels 0 to 4)"),
              std::string::npos)
        << error->what();
}

TEST(Stage, AVolumeWithoutVoxelsIsRefused) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    MemoryLevel none;
    none.info().materials.resize(1);
    Progress progress;
    write_vdb(none, folder.file("slab.vdb"), progress);
    const auto error = error_of([&] { Stage(scene, {}, progress); });
    ASSERT_TRUE(error.has_value());
    EXPECT_NE(std::string(error->what()).find("has no voxels"), std::string::npos) << error->what();
}

TEST(Stage, WithoutACameraAllOfTheObjectIsSeen) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    const Affine lying{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}}; // flat in x and z
    const Affine upright{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {}};
    Progress progress;
    for (const Affine& instance : {Affine{}, lying, upright}) {
        scene.objects[0].instances = {instance};
        const Stage stage(scene, {}, progress);
        StreamRandom random{1};
        const auto passes = [&](int x, int y) {
            const Ray ray =
                stage.camera().ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, {});
            return stage.scene().volumes[0].transmittance(ray, Transport::Product, {}, random);
        };
        int met = 0;
        for (int y = 0; y < scene.height; ++y) {
            for (int x = 0; x < scene.width; ++x) {
                const bool hit = passes(x, y) < 0.99f;
                met += hit ? 1 : 0;
                const bool edge = x == 0 || y == 0 || x == scene.width - 1 || y == scene.height - 1;
                EXPECT_FALSE(edge && hit) << x << ' ' << y;
            }
        }
        EXPECT_GT(met, 24 * 16 / 12);
    }
}

TEST(Stage, FramesTheSameAtEveryForcedLevel) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    Progress progress;
    const Vec3d eye = Stage(scene, {}, progress).camera_parameters().eye;
    for (scene.integrator.level = 0; scene.integrator.level < 5; ++scene.integrator.level) {
        EXPECT_EQ(Stage(scene, {}, progress).camera_parameters().eye, eye);
    }
}

TEST(Stage, MaterialsOfOneNameStayTwo) {
    const TempFolder folder;
    const Scene scene = slab_scene(folder, {named("", {1, 0, 0}), named("", {0, 0, 1})});
    Progress progress;
    const Stage stage(scene, {}, progress);
    ASSERT_EQ(stage.scene().materials.size(), 2u);
    EXPECT_EQ(stage.scene().materials[0].albedo, (Vec3f{1, 0, 0}));
    EXPECT_EQ(stage.scene().materials[1].albedo, (Vec3f{0, 0, 1}));
}

TEST(Stage, ANamedMaterialStandsForAllThatUseIt) {
    const TempFolder folder;
    Scene scene = slab_scene(folder, {named("a"), named("b")});
    scene.materials["silk"].albedo = {0.1f, 0.2f, 0.3f};
    scene.objects[0].materials["*"] = "silk";
    Progress progress;
    const Stage stage(scene, {}, progress);
    ASSERT_EQ(stage.scene().materials.size(), 1u);
    EXPECT_EQ(stage.scene().materials[0].albedo.z, 0.3f);
}

TEST(Stage, AnEnvironmentThatIsNotTwiceAsWideAsHighIsRefused) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    SceneLight& light = scene.lights.emplace_back();
    light.kind = SceneLight::Kind::Environment;
    light.image = folder.file("sky.png");
    Progress progress;
    for (const int width : {3, 4}) {
        write_png(light.image, width, 2, 3,
                  std::vector<std::uint8_t>(static_cast<std::size_t>(width) * 6, 200));
        const auto error = error_of([&] { Stage(scene, {}, progress); });
        EXPECT_EQ(error.has_value(), width == 3);
        if (error) {
            EXPECT_NE(std::string(error->what()).find("sky.png: is 3 x 2 pixels"),
                      std::string::npos)
                << error->what();
        }
    }
}

TEST(SceneHash, ChangesWithAllThatThePictureDependsOn) {
    const TempFolder folder;
    Scene scene = slab_scene(folder);
    std::vector<std::uint64_t> seen{hash_of_scene(scene, {}, false)};
    EXPECT_EQ(hash_of_scene(scene, {}, false), seen[0]);
    const auto expect_new = [&](const Scene& s, const PathOptions& o, bool geometry) {
        seen.push_back(hash_of_scene(s, o, geometry));
        for (std::size_t i = 0; i + 1 < seen.size(); ++i) EXPECT_NE(seen[i], seen.back());
    };
    expect_new(scene, {}, true);
    PathOptions options;
    options.level_offset = 0.5f;
    expect_new(scene, options, false);
    scene.objects[0].instances[0].offset.x = 1.0;
    expect_new(scene, {}, false);
    scene.materials["m"].roughness = 0.1f;
    expect_new(scene, {}, false);
    scene.materials["m"].roughness = 0.2f;
    expect_new(scene, {}, false);
    scene.lights.emplace_back();
    expect_new(scene, {}, false);
    scene.camera.emplace();
    expect_new(scene, {}, false);
    static_cast<void>(folder.write("slab.vdb", "another file"));
    expect_new(scene, {}, false);
}

} // namespace
} // namespace heddle
