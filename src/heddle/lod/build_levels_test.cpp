#include <heddle/base/parallel.h>
#include <heddle/lod/build_levels.h>
#include <heddle/lod/rebuild_levels.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxelize/test_bundle.h>
#include <heddle/voxelize/test_swatch.h>

#include <algorithm>
#include <set>

namespace heddle {
namespace {

using namespace heddle::test;
using LevelContent = std::map<Key, Content>;

VoxelLevels build(const Geometry& geometry, const VoxelizeOptions& options, LodOptions lod = {}) {
    LevelBuilder builder(lod);
    Progress silent;
    const VoxelizePlan plan = plan_voxelize(geometry, options, silent, &builder);
    auto finest = voxelize(geometry, options, plan, silent, &builder);
    return builder.finish(std::move(finest));
}

VoxelizeOptions with_sums(std::int64_t voxels) {
    VoxelizeOptions options;
    options.voxels = voxels;
    options.keep_sums = true;
    options.spool_dir = testing::TempDir();
    return options;
}

std::vector<LevelContent> contents_of(const VoxelLevels& levels) {
    std::vector<LevelContent> out;
    for (const auto& level : levels) out.push_back(content_of(*level));
    return out;
}

Key parent_of(Vec3i at, int level) {
    return {at.x >> level, at.y >> level, at.z >> level};
}

/// The expected contents of a voxel of a level, pooled directly from level 0.
struct Truth {
    std::array<std::set<std::pair<int, int>>, 3> columns;
    std::int64_t hits = 0;
    std::array<double, 6> moment{};
    double weight = 0.0;
};

std::map<Key, Truth> pool(const VoxelLevel& finest, int level) {
    const int n = finest.info().lattice.subvoxels;
    std::map<Key, Truth> truths;
    for_each_voxel(finest, [&](const BlockVoxel& v) {
        Truth& t = truths[parent_of(v.at, level)];
        t.hits += (std::int64_t{v.coverage().occupancy} * n * n * n + 32767) / 65535;
        for (int axis = 0; axis < 3; ++axis) {
            const int p = axis == 0 ? 1 : 0;
            const int q = axis == 2 ? 1 : 2;
            for (int bit = 0; bit < n * n; ++bit) {
                if ((v.columns()[static_cast<std::size_t>(axis)] >> bit & 1) == 0) continue;
                t.columns[static_cast<std::size_t>(axis)].emplace(v.at[p] * n + bit % n,
                                                                  v.at[q] * n + bit / n);
            }
        }
        for (const LobeMoment& m : v.moments()) {
            for (std::size_t k = 0; k < 6; ++k) t.moment[k] += static_cast<double>(m.moment[k]);
            t.weight += static_cast<double>(m.weight);
        }
    });
    return truths;
}

/// Largest difference between the pooled second moment and that of the stored mixture.
double moment_error(const Truth& truth, const Content& stored) {
    std::array<double, 6> sum{};
    double total = 0.0;
    for (const Lobe& lobe : stored.lobes) {
        const SymmetricMatrix M = second_moment_of(unpack(lobe.sggx));
        const double w = lobe.weight;
        const float entries[6]{M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
        for (std::size_t k = 0; k < 6; ++k) sum[k] += w * static_cast<double>(entries[k]);
        total += w;
    }
    double worst = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
        worst = std::max(worst, std::abs(sum[k] / total - truth.moment[k] / truth.weight));
    }
    return worst;
}

TEST(BuildLevels, CoverageAndOccupancyAreTheUnionOfAllColumnsBelow) {
    VoxelizeOptions options = with_sums(150);
    options.voxel_size = {0.04, 0.06, 0.09};
    options.voxels = 0;
    const VoxelLevels levels = build(swatch(), options);
    ASSERT_GE(levels.size(), 7u);
    const std::int64_t n = levels[0]->info().lattice.subvoxels;
    for (std::size_t l = 1; l < levels.size(); ++l) {
        const std::map<Key, Truth> truths = pool(*levels[0], static_cast<int>(l));
        const LevelContent content = content_of(*levels[l]);
        ASSERT_EQ(content.size(), truths.size()) << "level " << l;
        const std::int64_t edge = n << l;
        for (const auto& [at, truth] : truths) {
            ASSERT_TRUE(content.contains(at));
            const Coverage& c = content.at(at).coverage;
            const auto columns = [&](std::size_t axis) {
                return fraction16(static_cast<std::int64_t>(truth.columns[axis].size()),
                                  edge * edge);
            };
            const Coverage expected{columns(0), columns(1), columns(2),
                                    fraction16(truth.hits, edge * edge * edge)};
            ASSERT_EQ(c, expected) << "level " << l;
        }
    }
}

TEST(BuildLevels, TheStoredMixtureHasThePooledSecondMoment) {
    const VoxelLevels levels = build(swatch(), with_sums(100));
    for (std::size_t l = 0; l < levels.size(); ++l) {
        std::vector<double> errors;
        const LevelContent content = content_of(*levels[l]);
        for (const auto& [at, truth] : pool(*levels[0], static_cast<int>(l))) {
            errors.push_back(moment_error(truth, content.at(at)));
        }
        std::sort(errors.begin(), errors.end());
        EXPECT_LT(errors.back(), 0.01) << "level " << l;
        EXPECT_LT(errors[errors.size() / 2], 0.003) << "level " << l;
    }
}

TEST(BuildLevels, CorrelationIsThatOfTheUnionWithTheNextVoxel) {
    VoxelizeOptions options = with_sums(60);
    options.correlation = true;
    const VoxelLevels levels = build(swatch(), options);
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const std::map<Key, Truth> truths = pool(*levels[0], static_cast<int>(l));
        const double edge = static_cast<double>(8 << l);
        int between = 0;
        for (const auto& [at, content] : content_of(*levels[l])) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                auto [x, y, z] = at;
                (axis == 0 ? x : axis == 1 ? y : z) += 1;
                const auto next = truths.find({x, y, z});
                int expected = 0;
                if (next != truths.end()) {
                    auto both = truths.at(at).columns[axis];
                    const auto first = static_cast<double>(both.size()) / (edge * edge);
                    const auto& other = next->second.columns[axis];
                    const auto second = static_cast<double>(other.size()) / (edge * edge);
                    both.insert(other.begin(), other.end());
                    const double u = static_cast<double>(both.size()) / (edge * edge);
                    const double apart = first + second - first * second;
                    const double room = apart - std::max(first, second);
                    const double rho = std::clamp((apart - u) / room, 0.0, 1.0);
                    expected = room > 0.0 ? static_cast<int>(rho * 255.0 + 0.5) : 255;
                    between += expected > 0 && expected < 255;
                }
                ASSERT_EQ(content.correlation[axis], expected) << "level " << l << " axis " << axis;
            }
        }
        EXPECT_GT(between, l + 1 < levels.size() ? 3 : -1) << "level " << l;
    }
}

TEST(BuildLevels, EndWithAtMostTwoVoxelsAnAxis) {
    const VoxelLevels levels = build(swatch(), with_sums(150));
    const auto widest = [](const VoxelLevel& level) {
        Vec3i lo{1 << 30, 1 << 30, 1 << 30};
        Vec3i hi = lo * -1;
        for_each_voxel(level, [&](const BlockVoxel& v) {
            for (int a = 0; a < 3; ++a) {
                lo[a] = std::min(lo[a], v.at[a]);
                hi[a] = std::max(hi[a], v.at[a]);
            }
        });
        return std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z}) + 1;
    };
    EXPECT_LE(widest(*levels.back()), 2);
    EXPECT_GT(widest(*levels[levels.size() - 2]), 2);
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const VoxelLevelInfo& info = levels[l]->info();
        EXPECT_EQ(info.level, static_cast<int>(l));
        EXPECT_EQ(info.lattice.subvoxels, 8 << l);
        EXPECT_EQ(info.lod, "moments");
        EXPECT_EQ(static_cast<std::int64_t>(content_of(*levels[l]).size()), info.voxel_count);
    }
}

TEST(BuildLevels, ThreadsAndTheSpoolDoNotShow) {
    VoxelizeOptions options = with_sums(150);
    options.keep_sums = false;
    options.footprints = 8;
    set_thread_count(1);
    const std::vector<LevelContent> one = contents_of(build(swatch(), options));
    set_thread_count(5);
    LevelBuilder builder({});
    Progress silent;
    VoxelizePlan plan = plan_voxelize(swatch(), options, silent, &builder);
    plan.batches = 5;
    plan.spool = true;
    auto finest = voxelize(swatch(), options, plan, silent, &builder);
    const std::vector<LevelContent> spooled = contents_of(builder.finish(std::move(finest)));
    set_thread_count(0);
    EXPECT_EQ(one.size(), spooled.size());
    EXPECT_TRUE(one == spooled);
}

TEST(BuildLevels, ARegionGivesTheVoxelsOfTheWhole) {
    VoxelizeOptions options = with_sums(150);
    const VoxelLevels whole = build(swatch(), options);
    const Vec3d h = whole[0]->info().lattice.voxel_size;
    options.voxel_size = h;
    options.voxels = 0;
    const VoxelizePlan plan = plan_voxelize(swatch(), options);
    const Vec3i mid{(plan.voxel_lo.x + plan.voxel_hi.x) / 2,
                    (plan.voxel_lo.y + plan.voxel_hi.y) / 2,
                    (plan.voxel_lo.z + plan.voxel_hi.z) / 2};
    const Vec3i lo = mid - Vec3i{37, 21, 5};
    const Vec3i hi = mid + Vec3i{41, 33, 50};
    options.bounds = Bounds{{(lo.x + 0.5) * h.x, (lo.y + 0.5) * h.y, (lo.z + 0.5) * h.z},
                            {(hi.x + 0.5) * h.x, (hi.y + 0.5) * h.y, (hi.z + 0.5) * h.z}};
    const VoxelLevels part = build(swatch(), options);
    ASSERT_GE(part.size(), 4u);
    for (std::size_t l = 0; l < 4; ++l) {
        const LevelContent all = content_of(*whole[l]);
        int compared = 0;
        for (const auto& [at, content] : content_of(*part[l])) {
            const auto [x, y, z] = at;
            const int k = static_cast<int>(l);
            const bool inside = x << k >= lo.x && y << k >= lo.y && z << k >= lo.z &&
                                (x + 1) << k <= hi.x && (y + 1) << k <= hi.y &&
                                (z + 1) << k <= hi.z;
            if (!inside) continue;
            ++compared;
            EXPECT_TRUE(all.at(at) == content) << "level " << l;
        }
        EXPECT_GT(compared, l < 3 ? 50 : 5) << "level " << l;
    }
}

TEST(BuildLevels, Level0AloneHasTheCorrelationItHasAmongAllLevels) {
    VoxelizeOptions options = with_sums(60);
    options.correlation = true;
    const VoxelLevels all = build(swatch(), options);
    LodOptions none;
    none.max_levels = 0;
    const VoxelLevels alone = build(swatch(), options, none);
    ASSERT_EQ(alone.size(), 1u);
    EXPECT_TRUE(alone[0]->info().fields.correlation);
    EXPECT_TRUE(alone[0]->info().lod.empty());
    EXPECT_TRUE(content_of(*alone[0]) == content_of(*all[0]));
}

/// Returns the cells of level 0 in the cells of a coarser level.
std::map<Key, std::uint64_t> pool_cells(const VoxelLevel& finest, int level) {
    std::map<Key, std::uint64_t> pooled;
    for_each_voxel(finest, [&](const BlockVoxel& v) {
        std::uint64_t& cells = pooled[parent_of(v.at, level)];
        const Vec3i first =
            (v.at - Vec3i{v.at.x >> level, v.at.y >> level, v.at.z >> level} * (1 << level)) * 4;
        for (int i = 0; i < 64; ++i) {
            if ((v.occupancy() >> i & 1) == 0) continue;
            const Vec3i at = first + Vec3i{i / 16, i / 4 % 4, i % 4};
            const int cell = ((at.x >> level) * 4 + (at.y >> level)) * 4 + (at.z >> level);
            cells |= std::uint64_t{1} << cell;
        }
    });
    return pooled;
}

TEST(BuildLevels, OccupancyIsTheUnionOfAllCellsBelow) {
    for (const LodMethod method : {LodMethod::Moments, LodMethod::Naive}) {
        const VoxelLevels levels = build(swatch(), with_sums(150), {.method = method});
        ASSERT_GE(levels.size(), 7u);
        for (std::size_t l = 1; l < levels.size(); ++l) {
            const std::map<Key, std::uint64_t> pooled = pool_cells(*levels[0], static_cast<int>(l));
            const LevelContent content = content_of(*levels[l]);
            ASSERT_EQ(content.size(), pooled.size()) << "level " << l;
            for (const auto& [at, cells] : pooled) {
                ASSERT_EQ(content.at(at).occupancy, cells) << "level " << l;
            }
        }
    }
}

TEST(BuildLevels, OccupancyIsRebuiltFromAFileWithoutSums) {
    VoxelizeOptions options = with_sums(100);
    options.keep_sums = false;
    const std::vector<LevelContent> before = contents_of(build(swatch(), options));
    LodOptions single;
    single.method = LodMethod::Single;
    Progress silent;
    VoxelLevels again = rebuild_levels(build(swatch(), options), single, false, silent);
    for (std::size_t l = 0; l < again.size(); ++l) {
        for (const auto& [at, content] : content_of(*again[l])) {
            ASSERT_EQ(content.occupancy, before[l].at(at).occupancy) << "level " << l;
        }
    }
    options.occupancy = false;
    again = rebuild_levels(build(swatch(), options), single, false, silent);
    for (const auto& level : again) {
        EXPECT_FALSE(level->info().fields.occupancy);
        for_each_voxel(*level, [](const BlockVoxel& v) { ASSERT_EQ(v.occupancy(), 0u); });
    }
}

TEST(BuildLevels, ARebuildWithMasksGivesTheSameBits) {
    VoxelizeOptions options = with_sums(120);
    options.footprints = 4;
    options.correlation = true;
    VoxelLevels first = build(swatch(), options);
    const std::vector<LevelContent> before = contents_of(first);
    Progress silent;
    first.resize(1);
    const VoxelLevels again = rebuild_levels(std::move(first), {}, true, silent);
    EXPECT_FALSE(again[1]->info().approximate);
    EXPECT_TRUE(before == contents_of(again));
}

TEST(BuildLevels, ARebuildWithoutMasksKeepsTheFilesCoverageAndSaysThatItIsApproximate) {
    VoxelizeOptions options = with_sums(120);
    options.keep_sums = false;
    options.footprints = 8;
    options.correlation = true;
    const std::vector<LevelContent> before = contents_of(build(swatch(), options));
    Progress silent;
    EXPECT_THROW(rebuild_levels(build(swatch(), options), {}, true, silent), Error);
    const VoxelLevels again = rebuild_levels(build(swatch(), options), {}, false, silent);
    ASSERT_EQ(again.size(), before.size());
    EXPECT_TRUE(again[1]->info().approximate);
    for (std::size_t l = 0; l < again.size(); ++l) {
        for (const auto& [at, content] : content_of(*again[l])) {
            const Content& first = before[l].at(at);
            EXPECT_EQ(content.coverage, first.coverage) << "level " << l;
            EXPECT_EQ(content.footprints, first.footprints) << "level " << l;
            EXPECT_EQ(content.correlation, first.correlation) << "level " << l;
        }
    }
}

TEST(BuildLevels, WhereALevelCannotHaveWhatNeighboursShareNoneHas) {
    VoxelizeOptions options = with_sums(60);
    options.footprints = 4;
    options.correlation = true;
    LodOptions naive;
    naive.method = LodMethod::Naive;
    Progress silent;
    VoxelLevels cut = build(swatch(), options); // fewer levels than will be built, and no masks
    cut.resize(2);
    for (VoxelBlock& block : *cut[0]->blocks_in_memory()) {
        block.columns = {};
        block.moments = {};
        block.map_sums = {};
    }
    VoxelLevelInfo info = cut[0]->info();
    info.fields.masks = false;
    cut[0]->set_info(info);
    const VoxelLevels levels[2] = {rebuild_levels(std::move(cut), {}, false, silent),
                                   rebuild_levels(build(swatch(), options), naive, true, silent)};
    for (const VoxelLevels& of : levels) {
        ASSERT_GT(of.size(), 4u);
        for (const auto& level : of) {
            EXPECT_EQ(level->info().fields.footprints, 0);
            EXPECT_FALSE(level->info().fields.correlation);
            for_each_voxel(*level, [&](const BlockVoxel& v) {
                ASSERT_EQ(v.footprints(), (std::array<std::uint64_t, 3>{}));
                ASSERT_EQ(v.correlation(), (std::array<std::uint8_t, 3>{}));
            });
        }
    }
}

TEST(BuildLevels, WithoutColumnsTransparenciesMultiplyAlongAndAverageAcross) {
    auto grid = std::make_unique<MemoryLevel>();
    grid->info().materials.resize(1);
    VoxelBlock& block = grid->blocks.emplace_back();
    VoxelLeaf leaf{.origin = {0, 0, 0}};
    leaf.active[0] = 1;                           // voxel (0, 0, 0)
    leaf.active[1] = std::uint64_t{1} << (1 * 8); // voxel (1, 1, 0)
    leaf.active[2] = 1;                           // so that there is a level above
    block.leaves.push_back(leaf);
    for (int v = 0; v < 3; ++v) {
        block.coverage.push_back({32768, 16384, 8192, 1000});
        block.lobe_count.push_back(1);
        block.lobes.push_back({pack({0.25f, 0.25f, 0.25f, 0, 0, 0}), 255, 0});
    }
    grid->info().voxel_count = grid->info().lobe_count = 3;
    VoxelLevels levels;
    levels.push_back(std::move(grid));
    Progress silent;
    const VoxelLevels built = rebuild_levels(std::move(levels), {}, false, silent);
    ASSERT_EQ(built.size(), 2u);
    const Content parent = content_of(*built[1]).at({0, 0, 0});
    // the two are not behind each other along any axis: each covers a quarter of every face
    EXPECT_NEAR(parent.coverage.x, 32768 / 2, 1);
    EXPECT_NEAR(parent.coverage.y, 16384 / 2, 1);
    EXPECT_NEAR(parent.coverage.z, 8192 / 2, 1);
    EXPECT_TRUE(built[1]->info().approximate);
}

TEST(BuildLevels, CrossedBundlesKeepTwoLobesUpToTheTop) {
    CurveSet set;
    for (int i = 0; i < 40; ++i) {
        for (int j = 0; j < 10; ++j) { // one bundle above the other with a gap between
            const float u = 0.05f * static_cast<float>(i);
            const float w = 0.05f * static_cast<float>(j);
            add_curve(set, {{0.0f, u, w}, {2.0f, u, w}});
            add_curve(set, {{u, 0.0f, w + 0.7f}, {u, 2.0f, w + 0.7f}});
        }
    }
    set.basis = Basis::Linear;
    set.default_radius = 0.01f;
    for (const LodMethod method : {LodMethod::Moments, LodMethod::Wasserstein}) {
        LodOptions lod;
        lod.method = method;
        VoxelizeOptions options = with_sums(method == LodMethod::Moments ? 128 : 12);
        const VoxelLevels levels = build(geometry_of(set), options, lod);
        ASSERT_GE(levels.size(), 3u);
        for (std::size_t l = 1; l < levels.size(); ++l) {
            bool two = false;
            for_each_voxel(*levels[l], [&](const BlockVoxel& v) {
                two = two || v.lobes().size() > 1;
                const auto sigma = [&](Vec3f w) {
                    double sum = 0.0, total = 0.0;
                    for (const Lobe& lobe : v.lobes()) {
                        sum +=
                            lobe.weight * static_cast<double>(projected_area(unpack(lobe.sggx), w));
                        total += lobe.weight;
                    }
                    return sum / total;
                };
                double x = 0.0, y = 0.0, all = 0.0;
                for (const Lobe& lobe : v.lobes()) {
                    const SymmetricMatrix S = unpack(lobe.sggx);
                    (S.xx > S.yy ? x : y) += lobe.weight;
                    all += lobe.weight;
                }
                for (const Vec3f w : {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1},
                                      normalize(Vec3f{1, 1, 0}), normalize(Vec3f{1, -1, 1})}) {
                    const double truth = (x * static_cast<double>(std::abs(w.x)) +
                                          y * static_cast<double>(std::abs(w.y))) /
                                         all;
                    EXPECT_NEAR(sigma(w), truth, 0.02) << "level " << l;
                }
            });
            EXPECT_TRUE(two || l + 1 < levels.size()) << "one lobe at the top";
        }
    }
}

TEST(BuildLevels, EveryMethodBuildsEveryLevelAndBaselinesHaveOneLobe) {
    for (std::size_t m = 0; m < kLodMethodNames.size(); ++m) {
        LodOptions lod;
        lod.method = static_cast<LodMethod>(m);
        const VoxelLevels levels = build(swatch(), with_sums(16), lod);
        ASSERT_GE(levels.size(), 4u);
        const bool mixture = m <= static_cast<std::size_t>(LodMethod::Wasserstein);
        EXPECT_EQ(levels[1]->info().lod, kLodMethodNames[m]);
        std::size_t most = 0;
        for_each_voxel(*levels[3], [&](const BlockVoxel& v) {
            most = std::max(most, v.lobes().size());
            for (const Lobe& lobe : v.lobes()) EXPECT_TRUE(is_positive_definite(lobe.sggx));
        });
        EXPECT_EQ(most, mixture ? 3u : 1u) << kLodMethodNames[m];
    }
}

TEST(BuildLevels, MaterialsStayApartWhileThereAreLobesForThem) {
    const VoxelLevels levels = build(swatch(), with_sums(150));
    const std::size_t top = levels.size() - 1;
    for (std::size_t l = 1; l <= top; ++l) {
        std::map<Key, std::set<int>> below;
        for_each_voxel(*levels[l - 1], [&](const BlockVoxel& v) {
            for (const Lobe& lobe : v.lobes()) below[parent_of(v.at, 1)].insert(lobe.material);
        });
        for_each_voxel(*levels[l], [&](const BlockVoxel& v) {
            std::set<int> here;
            for (const Lobe& lobe : v.lobes()) here.insert(lobe.material);
            EXPECT_EQ(here, below.at({v.at.x, v.at.y, v.at.z})) << "level " << l;
        });
    }
}

} // namespace
} // namespace heddle
