#include <heddle/viewer/session/session.h>

#include <heddle/io/vdb/read_vdb.h>
#include <heddle/opengl/context.h>
#include <heddle/voxelize/test_voxelize.h>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

namespace heddle::viewer {
namespace {

constexpr std::int32_t kSize = 64;

Geometry fiber() {
    CurveSet set;
    heddle::test::add_curve(set, {{-2, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    set.default_radius = 0.2f;
    return heddle::test::geometry_of(set);
}

class SessionTest : public ::testing::Test {
protected:
    SessionTest() {
        folder_ = std::filesystem::path(::testing::TempDir()) /
                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
        std::filesystem::create_directories(folder_);
        subject_.name = "fiber";
        subject_.geometry = fiber();
        subject_.folder = folder_.string();
        settings_.orbit.from = {0.0, 0.0, 1.0};
        settings_.orbit.height = 3.0;
    }
    ~SessionTest() override { std::filesystem::remove_all(folder_); }

    /// Works until nothing is left to do, for at most a minute.
    static bool settle(Session& session) {
        for (int i = 0; i < 6000 && session.busy(); ++i) {
            (void)session.work(0.05);
            if (session.job() != nullptr) {
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            }
        }
        return !session.busy();
    }
    static double darkness(const Session& session) {
        double sum = 0.0;
        const std::vector<float> pixels = session.picture().fine().read();
        for (std::size_t i = 3; i < pixels.size(); i += 4) sum += static_cast<double>(pixels[i]);
        return sum / static_cast<double>(kSize * kSize);
    }

    opengl::Context context_;
    std::filesystem::path folder_;
    ViewedObject subject_;
    Settings settings_;
};

TEST_F(SessionTest, ShowsTheYarnAndWhatItsEditsChange) {
    Session session(context_, subject_, settings_, kSize, kSize);
    ASSERT_TRUE(settle(session));
    const double thin = darkness(session);
    EXPECT_NEAR(thin, 2.0 * 0.4 / 9.0, 0.02); // 2 long, 0.4 wide, in a picture of 3 x 3
    Settings next = session.settings();
    next.yarns[0].radius = 2.0;
    session.set(next);
    EXPECT_TRUE(session.busy());
    ASSERT_TRUE(settle(session));
    EXPECT_NEAR(darkness(session), 2.0 * thin, 0.03);
    session.set(session.settings());
    EXPECT_FALSE(session.busy()) << "the same settings change nothing";
}

TEST_F(SessionTest, VoxelizesWhatIsSeenByBothBackendsAndSavesIt) {
    for (const bool raster : {false, true}) {
        Session session(context_, subject_, settings_, kSize, kSize);
        Settings next = session.settings();
        next.voxels = {.raster = raster, .edge_px = 2.0};
        next.orbit.target = {1.0, 0.0, 0.0}; // the picture ends at x = -0.5
        session.set(next);
        session.voxelize();
        ASSERT_TRUE(settle(session)) << session.message();
        ASSERT_TRUE(session.has_voxels()) << session.message();
        const VoxelLevelInfo& info = session.subject().levels->front()->info();
        EXPECT_NEAR(info.lattice.voxel_size.x, 2.0 * 3.0 / kSize, 1e-12);
        session.save_scene();
        ASSERT_TRUE(settle(session));
        EXPECT_EQ(session.message().rfind("saved ", 0), 0u) << session.message();
        const std::vector<VoxelLevelInfo> saved = read_infos((folder_ / "fiber_view.vdb").string());
        EXPECT_EQ(saved.front().voxel_count, info.voxel_count);
        EXPECT_GT(info.voxel_count, 0);
        EXPECT_TRUE(std::filesystem::exists(folder_ / "fiber_view.toml"));
    }
}

TEST_F(SessionTest, OpensAVolumeAloneOrBesideItsCurves) {
    {
        Session session(context_, subject_, settings_, kSize, kSize);
        session.voxelize();
        ASSERT_TRUE(settle(session)) << session.message();
        session.save_voxels();
        ASSERT_TRUE(settle(session)) << session.message();
    }
    ViewedObject volume;
    volume.name = "volume";
    volume.levels =
        std::make_shared<VoxelLevels>(read_levels((folder_ / "fiber_view.vdb").string()));
    EXPECT_NEAR(bounds_of(volume).lo.x, -1.0, 8.0 * 2.0 * 3.0 / kSize); // a leaf
    Settings framed;
    framed.framed = true;
    Session alone(context_, volume, framed, kSize, kSize);
    EXPECT_EQ(alone.settings().show, Show::Voxels);
    ASSERT_TRUE(settle(alone));
    EXPECT_GT(darkness(alone), 0.02);
    alone.voxelize();
    EXPECT_EQ(alone.job(), nullptr) << "there are no curves";
    alone.pick_block(kSize * 0.5, kSize * 0.5);
    EXPECT_TRUE(alone.settings().volume.white_block.has_value());
    alone.pick_block(kSize * 0.5, kSize * 0.5);
    EXPECT_FALSE(alone.settings().volume.white_block.has_value()) << "a second time: none";

    subject_.levels = volume.levels;
    Session beside(context_, subject_, settings_, kSize, kSize);
    EXPECT_EQ(beside.settings().show, Show::Slices);
    ASSERT_TRUE(settle(beside));
    const double without = darkness(beside);
    Settings blocks = beside.settings();
    blocks.volume.blocks = true;
    beside.set(blocks);
    ASSERT_TRUE(settle(beside));
    EXPECT_GT(darkness(beside), without + 0.005) << "edges of blocks are drawn over slices";
}

TEST_F(SessionTest, SavesAPictureThatIsWhole) {
    Session session(context_, subject_, settings_, kSize, kSize);
    session.save_picture();
    EXPECT_FALSE(std::filesystem::exists(folder_ / "fiber_view.png")) << "it is not there yet";
    ASSERT_TRUE(settle(session));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "fiber_view.png")) << session.message();
    std::filesystem::remove(folder_ / "fiber_view.png");
    session.save_picture();
    EXPECT_TRUE(std::filesystem::exists(folder_ / "fiber_view.png")) << "it was";
}

TEST_F(SessionTest, WhatFailsIsALineAndLeavesTheRest) {
    Session session(context_, subject_, settings_, kSize, kSize);
    session.save_voxels();
    EXPECT_NE(session.message().find("voxelize first"), std::string::npos);
    Settings next = session.settings();
    next.orbit.target = {0.0, 90.0, 0.0};
    session.set(next);
    session.voxelize();
    EXPECT_EQ(session.job(), nullptr);
    EXPECT_NE(session.message().find("nothing is seen"), std::string::npos);
    next.voxels.only_seen = false;
    next.voxels.edge_px = 1e-9; // more voxels than possible
    session.set(next);
    session.voxelize();
    ASSERT_TRUE(settle(session));
    EXPECT_FALSE(session.has_voxels());
    EXPECT_NE(session.message().find("voxel"), std::string::npos) << session.message();
    std::filesystem::remove_all(folder_);
    session.save_picture();
    EXPECT_NE(session.message().find("fiber_view.png"), std::string::npos) << session.message();
    EXPECT_EQ(session.message().rfind("saved", 0), std::string::npos) << session.message();
}

TEST_F(SessionTest, AJobThatIsStoppedLeavesNothing) {
    Session session(context_, subject_, settings_, kSize, kSize);
    Settings next = session.settings();
    next.voxels.edge_px = 0.02;
    session.set(next);
    session.voxelize();
    ASSERT_NE(session.job(), nullptr);
    session.stop_job();
    EXPECT_EQ(session.job(), nullptr);
    EXPECT_FALSE(session.has_voxels());
    EXPECT_EQ(session.message(), "stopped");
}

} // namespace
} // namespace heddle::viewer
