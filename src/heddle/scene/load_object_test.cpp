#include <heddle/scene/load_object.h>

#include <heddle/io/geometry/read_geometry.h>
#include <heddle/scene/test_scene.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

using testing::expect_error;
using testing::TempFolder;

SceneObject generated(GenerateKind kind) {
    SceneObject object;
    object.name = "a";
    object.generate.emplace();
    object.generate->kind = kind;
    object.generate->nx = 8;
    object.generate->ny = 8;
    return object;
}

TEST(LoadObject, AGeneratorMakesWhatTheObjectNames) {
    const Geometry g = load_object_geometry(generated(GenerateKind::Plain));
    std::size_t yarns = 0;
    for (const CurveSet& set : g.curves) yarns += set.curve_count();
    EXPECT_EQ(yarns, 16u);
    EXPECT_EQ(g.yarn_of(g.curves.at(0)), nullptr);
}

TEST(LoadObject, YarnFibersAndRadiiAreApplied) {
    SceneObject object = generated(GenerateKind::Plain);
    object.yarn = "cotton";
    object.fibers = 60;
    object.yarn_radius = 0.25;
    object.fiber_radius = 0.0625;
    const Geometry g = load_object_geometry(object);
    const YarnType* yarn = g.yarn_of(g.curves.at(0));
    ASSERT_NE(yarn, nullptr);
    EXPECT_EQ(yarn->fiber_count(), 60);
    EXPECT_EQ(yarn->radius, 0.25f);
    EXPECT_EQ(yarn->fiber_radius, 0.0625f);
    ASSERT_EQ(g.materials.size(), 1u);
    EXPECT_EQ(g.materials[0].name, "cotton");
    EXPECT_EQ(g.materials[0].kind, MaterialKind::Fiber);
}

TEST(LoadObject, WithoutAYarnTheRadiusIsEveryCurves) {
    SceneObject object = generated(GenerateKind::Plain);
    object.yarn_radius = 0.25;
    EXPECT_EQ(load_object_geometry(object).curves.at(0).default_radius, 0.25f);
    object.fiber_radius = 0.125;
    EXPECT_EQ(load_object_geometry(object).curves.at(0).default_radius, 0.125f);
}

TEST(LoadObject, FilesAreReadByTheirSuffix) {
    const TempFolder folder;
    const Geometry made = load_object_geometry(generated(GenerateKind::Plain));
    SceneObject object;
    object.geometry = folder.file("a.bcc");
    write_bcc(made.curves[0], object.geometry);
    EXPECT_EQ(load_object_geometry(object).curves.at(0).points, made.curves[0].points);
    object.geometry = folder.write("a.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(load_object_geometry(object).meshes.at(0).triangles.size(), 1u);
    expect_error(ErrorCode::Unsupported, "no reader for the suffix '.abc'",
                 [] { static_cast<void>(read_geometry("a.abc")); });
}

TEST(LoadObject, WhatAnObjectHasNoUseForIsRefused) {
    SceneObject object;
    object.name = "a";
    object.volume = "a.vdb";
    expect_error(ErrorCode::InvalidArgument, "object 'a' has no geometry",
                 [&] { static_cast<void>(load_object_geometry(object)); });
    object = generated(GenerateKind::Grass);
    object.yarn = "wool";
    expect_error(ErrorCode::InvalidArgument, "its geometry has no curves",
                 [&] { static_cast<void>(load_object_geometry(object)); });
}

} // namespace
} // namespace heddle
