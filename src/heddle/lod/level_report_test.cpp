#include <heddle/base/parallel.h>
#include <heddle/lod/build_levels.h>
#include <heddle/lod/level_report.h>
#include <heddle/lod/level_subset.h>
#include <heddle/lod/parent_truth.h>
#include <heddle/lod/rebuild_levels.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/test_grid.h>
#include <heddle/voxelize/test_swatch.h>

#include <set>

namespace heddle {
namespace {

using namespace heddle::test;

VoxelLevels voxelized(bool masks) {
    VoxelizeOptions options;
    options.voxels = 40;
    options.keep_sums = masks;
    options.spool_dir = ::testing::TempDir();
    LevelBuilder builder({});
    Progress silent;
    const VoxelizePlan plan = plan_voxelize(swatch(), options, silent, &builder);
    return builder.finish(voxelize(swatch(), options, plan, silent, &builder));
}

const VoxelLevels& file(bool masks) {
    static const std::array<VoxelLevels, 2> both{voxelized(false), voxelized(true)};
    return both[masks ? 1 : 0];
}

VoxelLevels rebuilt(const VoxelLevels& levels, LodMethod method) {
    LodOptions options;
    options.method = method;
    Progress silent;
    return rebuild_levels(share_levels(levels), options, false, silent);
}

std::vector<MethodErrors> report(const VoxelLevels& levels, int parents) {
    LevelReporter reporter(*levels[0], &levels, {.parents = parents, .seed = 3});
    reporter.take("file", levels);
    for (const LodMethod method :
         {LodMethod::Moments, LodMethod::Single, LodMethod::Naive, LodMethod::Random}) {
        reporter.take(name_of(method), rebuilt(levels, method));
    }
    Progress silent;
    return reporter.measure(silent);
}

/// Two voxels of one parent, each with a lobe of its own material, and a third, so that there is a
/// level above.
VoxelLevels pair_of(const Lobe& a, const Lobe& b, MaterialKind second) {
    auto grid = std::make_unique<MemoryLevel>();
    grid->info().materials.resize(2);
    grid->info().materials[0].kind = MaterialKind::Fiber;
    grid->info().materials[1].kind = second;
    const Coverage half{32768, 32768, 32768, 1000};
    grid->blocks = heddle::testing::make_blocks(
        {{{0, 0, 0}, {half, {a}}}, {{1, 0, 0}, {half, {b}}}, {{4, 0, 0}, {half, {a}}}});
    heddle::testing::count_voxels(*grid);
    VoxelLevels levels;
    levels.push_back(std::move(grid));
    return levels;
}

TEST(VoxelIndex, VisitsAllVoxelsBelowOneAndNoOther) {
    const VoxelLevel& finest = *file(false)[0];
    const VoxelIndex index(finest);
    for (const int level : {0, 1, 2, 3, 4, 6}) {
        std::map<Key, std::set<Key>> below;
        for_each_voxel(finest, [&](const BlockVoxel& v) {
            below[{v.at.x >> level, v.at.y >> level, v.at.z >> level}].emplace(v.at.x, v.at.y,
                                                                               v.at.z);
        });
        for (const auto& [parent, expected] : below) {
            std::set<Key> seen;
            const auto [x, y, z] = parent;
            index.for_each_below(level, {x, y, z}, [&](const BlockVoxel& v) {
                EXPECT_TRUE(seen.emplace(v.at.x, v.at.y, v.at.z).second);
            });
            ASSERT_EQ(seen, expected) << "level " << level;
        }
        int visits = 0;
        index.for_each_below(level, {1 << 20, 0, 0}, [&](const BlockVoxel&) { ++visits; });
        EXPECT_EQ(visits, 0);
    }
}

TEST(ParentTruth, IsTheSumOfTheChildrens) {
    double cells = 0.0;
    int parents = 0;
    const VoxelIndex finest(*file(true)[0]);
    for_each_voxel(*file(true)[3], [&](const BlockVoxel& v) {
        const ParentTruth whole = pool_truth(finest, 3, v.at, {});
        ParentTruth sum;
        for (int c = 0; c < 8; ++c) {
            sum.add(pool_truth(finest, 2, v.at * 2 + Vec3i{c >> 2, c >> 1 & 1, c & 1}, {}));
        }
        ASSERT_TRUE(whole.of[0] && sum.of[0] && !whole.of[1]);
        const DirectionError difference = direction_error(*whole.of[0], *sum.of[0]);
        EXPECT_LT(difference.sigma, 1e-12);
        EXPECT_LT(difference.moment, 1e-12);
        cells += difference.cells; // points of a lobe differ
        ++parents;
        EXPECT_NEAR(whole.weight(), sum.weight(), 1e-9 * whole.weight());
    });
    EXPECT_LT(cells / parents, 0.025);
}

TEST(LevelReport, TheUnionIsWhatBuiltLevelsHoldAndTheMeanIsNot) {
    LevelReporter reporter(*file(true)[0], nullptr, {});
    EXPECT_EQ(reporter.coverage_truth(), CoverageTruth::Union);
    for (const MethodErrors& method : report(file(true), 40)) {
        ASSERT_GE(method.levels.size(), 4u);
        for (const LevelErrors& level : method.levels) {
            ASSERT_TRUE(level.coverage && level.coverage_worst);
            EXPECT_EQ(*level.coverage_worst > 0.0, method.name == "naive") << method.name;
            EXPECT_LE(*level.coverage, *level.coverage_worst);
        }
    }
}

TEST(LevelReport, WithoutColumnsCoverageIsComparedWithTheFiles) {
    LevelReporter reporter(*file(false)[0], &file(false), {});
    EXPECT_EQ(reporter.coverage_truth(), CoverageTruth::File);
    LevelReporter lone(*file(false)[0], nullptr, {});
    EXPECT_EQ(lone.coverage_truth(), CoverageTruth::None);
    for (const MethodErrors& method : report(file(false), 10)) {
        for (const LevelErrors& level : method.levels) {
            EXPECT_EQ(level.coverage_worst.value() > 0.0, method.name == "naive") << method.name;
        }
    }
}

TEST(LevelReport, MeasuresTheSameParentsOfEveryMethodAndMixturesErrLeast) {
    const std::vector<MethodErrors> methods = report(file(true), 40);
    ASSERT_EQ(methods.size(), 5u);
    for (std::size_t l = 0; l < methods[0].levels.size(); ++l) {
        const LevelErrors& moments = methods[1].levels[l];
        EXPECT_EQ(moments.voxels, file(true)[l + 1]->info().voxel_count);
        EXPECT_EQ(moments.parents, std::min<std::int64_t>(40, moments.voxels));
        EXPECT_EQ(moments.sigma, methods[0].levels[l].sigma); // the file was built that way
        EXPECT_LT(moments.sigma, methods[2].levels[l].sigma); // single
        EXPECT_LT(moments.sigma, methods[3].levels[l].sigma); // naive
        EXPECT_LT(moments.moment, 0.003);
        EXPECT_LT(moments.moment_worst, 0.01);
        EXPECT_GT(moments.cells, 0.0);
        for (const MethodErrors& m : methods) EXPECT_EQ(m.levels[l].parents, moments.parents);
    }
}

TEST(LevelReport, ThreadsDoNotShow) {
    set_thread_count(1);
    const std::vector<MethodErrors> one = report(file(true), 8);
    set_thread_count(3);
    const std::vector<MethodErrors> three = report(file(true), 8);
    set_thread_count(0);
    for (std::size_t m = 0; m < one.size(); ++m) {
        for (std::size_t l = 0; l < one[m].levels.size(); ++l) {
            EXPECT_EQ(one[m].levels[l].sigma, three[m].levels[l].sigma);
            EXPECT_EQ(one[m].levels[l].cells, three[m].levels[l].cells);
        }
    }
}

TEST(LevelReport, PerpendicularNeedlesErrByTheAreaOfOneLobeForBoth) {
    const Lobe x{pack(fit_sggx({1, 0, 0, 0, 0, 0})), 255, 0};
    const Lobe y{pack(fit_sggx({0, 1, 0, 0, 0, 0})), 255, 0};
    const VoxelLevels levels = pair_of(x, y, MaterialKind::Fiber);
    LevelReporter reporter(*levels[0], nullptr, {});
    reporter.take("moments", rebuilt(levels, LodMethod::Moments));
    reporter.take("single", rebuilt(levels, LodMethod::Single));
    Progress silent;
    const std::vector<MethodErrors> methods = reporter.measure(silent);
    EXPECT_FALSE(methods[0].levels[0].coverage); // nothing to compare with
    EXPECT_LT(methods[0].levels[0].sigma, 0.002);
    // one of two parents holds the pair: a ring instead has an error of 0.042  [docs/sggx.md]
    EXPECT_NEAR(methods[1].levels[0].sigma, 0.042 / 2.0, 0.003);
    EXPECT_LT(methods[1].levels[0].moment_worst, 0.01);
}

TEST(LevelReport, AKindThatIsMergedAwayIsSaidToBeLost) {
    const Lobe x{heddle::testing::needle({1, 0, 0}), 255, 0};
    const Lobe y{heddle::testing::needle({0, 1, 0}), 255, 1};
    const VoxelLevels levels = pair_of(x, y, MaterialKind::Surface);
    LevelReporter reporter(*levels[0], nullptr, {});
    reporter.take("moments", rebuilt(levels, LodMethod::Moments));
    reporter.take("single", rebuilt(levels, LodMethod::Single));
    Progress silent;
    const std::vector<MethodErrors> methods = reporter.measure(silent);
    EXPECT_EQ(methods[0].levels[0].lost, 0.0);
    EXPECT_NEAR(methods[1].levels[0].lost, 0.25, 1e-6); // half of one of two parents
}

TEST(LevelReport, LevelsOfAnotherObjectAreRefused) {
    LevelReporter reporter(*file(true)[0], nullptr, {});
    reporter.take("file", file(true));
    const Lobe x{heddle::testing::needle({1, 0, 0}), 255, 0};
    EXPECT_THROW(
        reporter.take("other", rebuilt(pair_of(x, x, MaterialKind::Fiber), LodMethod::Moments)),
        Error);
}

TEST(ChooseBlocks, GivesAPartOfAboutTheSizeAskedForOrAll) {
    const VoxelLevel& finest = *file(false)[0];
    const std::int64_t all = finest.info().voxel_count;
    const std::vector<std::size_t> some = choose_blocks(finest, all / 3, 1);
    const LevelSubset part(finest, some);
    EXPECT_GE(part.info().voxel_count, all / 3);
    EXPECT_LT(part.info().voxel_count, all);
    EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
    EXPECT_NE(some, choose_blocks(finest, all / 3, 2));
    EXPECT_EQ(choose_blocks(finest, all, 1).size(), finest.block_count());
}

} // namespace
} // namespace heddle
