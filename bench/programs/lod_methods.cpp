#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/sggx/mixture_error.h>
#include <heddle/sggx/moment_lobes.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/sggx/test_reduce.h>
#include <heddle/sggx/wasserstein.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

// heddle_lod_methods FILE.vdb [PARENTS = 2000] [LEVELS = 5]: for each level and method the error of
// K = 3 lobes against all finest lobes below, averaged over PARENTS random parents, as markdown.
// Every method builds each level from its own lobes of the level below.

namespace heddle {
namespace {

constexpr int kKeep = 3;

/// Lobes of the voxels of one level, in Morton order of the voxels.
struct Level {
    std::vector<std::uint64_t> code;        ///< per voxel
    std::vector<std::uint32_t> first_child; ///< per voxel, and the end: index in the level below
    std::vector<std::uint32_t> first_finest;
};

struct Finest {
    std::vector<std::uint64_t> code;
    std::vector<std::vector<DirectionSums>> lobes; ///< per voxel
};

using VoxelLobes = std::vector<std::vector<DirectionSums>>; ///< per voxel of a level

std::uint64_t morton(Vec3i voxel) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::uint64_t>(voxel[axis] + (1 << 20));
        for (int bit = 0; bit < 21; ++bit) code |= (i >> bit & 1) << (3 * bit + axis);
    }
    return code;
}

/// The stored lobe as sums; its weight times the occupancy replaces its directed area.
DirectionSums sums_of(const Lobe& lobe, const Coverage& coverage, bool normals) {
    DirectionSums s{.material = lobe.material, .normals = normals};
    s.weight = static_cast<std::int64_t>(lobe.weight) * std::max<int>(coverage.occupancy, 1) << 16;
    const SymmetricMatrix M = second_moment_of(unpack(lobe.sggx));
    const float entry[6] = {M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
    for (int k = 0; k < 6; ++k) {
        s.moment[k] = static_cast<std::int64_t>(static_cast<double>(entry[k]) *
                                                static_cast<double>(s.weight));
    }
    return s;
}

Finest load(const std::string& path) {
    const std::unique_ptr<MemoryLevel> grid = read_vdb(path);
    std::vector<std::pair<std::uint64_t, std::vector<DirectionSums>>> voxels;
    for_each_voxel(*grid, [&](const BlockVoxel& v) {
        std::vector<DirectionSums> lobes;
        for (const Lobe& lobe : v.lobes()) {
            const Material& material = grid->info().materials[lobe.material];
            lobes.push_back(sums_of(lobe, v.coverage(), material.kind == MaterialKind::Surface));
        }
        voxels.emplace_back(morton(v.at), std::move(lobes));
    });
    std::sort(voxels.begin(), voxels.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    Finest finest;
    for (auto& [code, lobes] : voxels) {
        finest.code.push_back(code);
        finest.lobes.push_back(std::move(lobes));
    }
    return finest;
}

Level next_level(const std::vector<std::uint64_t>& code,
                 const std::vector<std::uint32_t>* first_finest) {
    Level level;
    const auto start = [&](std::size_t i) {
        level.first_child.push_back(static_cast<std::uint32_t>(i));
        level.first_finest.push_back(first_finest != nullptr ? (*first_finest)[i]
                                                             : static_cast<std::uint32_t>(i));
    };
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (i > 0 && code[i] >> 3 == code[i - 1] >> 3) continue;
        level.code.push_back(code[i] >> 3);
        start(i);
    }
    start(code.size());
    return level;
}

/// MomentLobes with another distance for two lobes of one material.
template <typename Distance>
class OtherLobes {
public:
    OtherLobes(std::span<DirectionSums> lobes, Distance distance)
        : lobes_(lobes), distance_(distance) {
        for (const DirectionSums& s : lobes) total_ += static_cast<float>(s.weight);
        for (std::size_t i = 0; i < lobes.size(); ++i) update(i);
    }
    [[nodiscard]] float distance(int a, int b) const {
        const auto i = static_cast<std::size_t>(a);
        const auto j = static_cast<std::size_t>(b);
        const float d = distance_(mean_[i], share_[i], mean_[j], share_[j]);
        return lobes_[i].material == lobes_[j].material ? d : detail::keep_apart(d);
    }
    void merge(int into, int from) {
        const auto i = static_cast<std::size_t>(into);
        lobes_[i] = merged(lobes_[i], lobes_[static_cast<std::size_t>(from)]);
        update(i);
    }

private:
    void update(std::size_t i) {
        mean_[i] = detail::mean_moment(lobes_[i]);
        share_[i] = static_cast<float>(lobes_[i].weight) / total_;
    }
    std::span<DirectionSums> lobes_;
    Distance distance_;
    float total_ = 0.0f;
    SymmetricMatrix mean_[kMaxPool];
    float share_[kMaxPool]{};
};

using Pool = std::vector<DirectionSums>;
using Matrix = SymmetricMatrix;

template <typename Distance>
void reduce_with(Pool& pool, Distance distance) {
    if (static_cast<int>(pool.size()) <= kKeep) return;
    OtherLobes<Distance> lobes(pool, distance);
    LobeMerge merges[kMaxPool];
    const int made = agglomerate(static_cast<int>(pool.size()), kKeep, lobes, merges);
    pool.resize(static_cast<std::size_t>(compact_lobes(std::span(pool), merges, made)));
}

float harmonic(float a, float b) {
    return a * b / (a + b);
}

Matrix mix(const Matrix& A, float a, const Matrix& B, float b) {
    const float p = a / (a + b);
    const float q = b / (a + b);
    return {A.xx * p + B.xx * q, A.yy * p + B.yy * q, A.zz * p + B.zz * q,
            A.xy * p + B.xy * q, A.xz * p + B.xz * q, A.yz * p + B.yz * q};
}

/// The difference of a moment from that of a single direction.
float spread(const Matrix& M) {
    return std::sqrt(std::max(0.0f, 1.0f - detail::square_distance(M, {})) + 1e-6f);
}

void reduce_moments(Pool& pool, float same) {
    LobeMerge merges[kMaxPool];
    pool.resize(static_cast<std::size_t>(test::reduce_lobes(pool, kKeep, merges, same)));
}

struct Method {
    const char* name;
    void (*reduce)(Pool& pool, std::uint64_t seed);
};

const Method kMethods[] = {
    {"wasserstein",
     [](Pool& pool, std::uint64_t seed) {
         LobeMerge merges[kMaxPool];
         pool.resize(static_cast<std::size_t>(
             test::reduce_lobes_by_wasserstein(pool, kKeep, seed, merges)));
     }},
    {"single",
     [](Pool& pool, std::uint64_t) {
         for (; pool.size() > 1; pool.pop_back()) pool[0] = merged(pool[0], pool.back());
     }},
    {"moments", [](Pool& pool, std::uint64_t) { reduce_moments(pool, kSameLobe); }},
    {"moments, same 0", [](Pool& pool, std::uint64_t) { reduce_moments(pool, 0.0f); }},
    {"moments, same 3e-4", [](Pool& pool, std::uint64_t) { reduce_moments(pool, 3e-4f); }},
    {"moments, same 1e-3", [](Pool& pool, std::uint64_t) { reduce_moments(pool, 1e-3f); }},
    {"dM^2, no weights",
     [](Pool& pool, std::uint64_t) {
         reduce_with(pool, [](const Matrix& A, float, const Matrix& B, float) {
             return detail::square_distance(A, B);
         });
     }},
    {"w dM",
     [](Pool& pool, std::uint64_t) {
         reduce_with(pool, [](const Matrix& A, float a, const Matrix& B, float b) {
             return harmonic(a, b) * std::sqrt(detail::square_distance(A, B));
         });
     }},
    {"w dS^2",
     [](Pool& pool, std::uint64_t) {
         reduce_with(pool, [](const Matrix& A, float a, const Matrix& B, float b) {
             return harmonic(a, b) * detail::square_distance(fit_sggx(A), fit_sggx(B));
         });
     }},
    {"increase of spread", [](Pool& pool, std::uint64_t) {
         reduce_with(pool, [](const Matrix& A, float a, const Matrix& B, float b) {
             const float after = (a + b) * spread(mix(A, a, B, b));
             return std::max(0.0f, after - a * spread(A) - b * spread(B));
         });
     }}};

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Reduces the lobes of the children of every voxel.
/// @param seconds  receives the time of reducing, summed over all threads
VoxelLobes
build(const Level& level, const VoxelLobes& below, const Method& method, double& seconds) {
    VoxelLobes lobes(level.code.size());
    constexpr std::size_t kGrain = 64;
    seconds = reduce_chunks(
        lobes.size(), kGrain, 0.0,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                for (std::size_t c = level.first_child[i]; c < level.first_child[i + 1]; ++c) {
                    lobes[i].insert(lobes[i].end(), below[c].begin(), below[c].end());
                }
            }
            const double t = now();
            for (std::size_t i = begin; i < end; ++i) {
                method.reduce(lobes[i], hash64(1, level.code[i]));
            }
            return now() - t;
        },
        [](double a, double b) { return a + b; });
    return lobes;
}

MixtureLobe fitted(const DirectionSums& s) {
    return {fit_sggx(detail::mean_moment(s)), static_cast<double>(s.weight)};
}

/// All lobes of these voxels; tangents and normals together, since no input has both.
DirectionTruth add_up(std::span<const std::vector<DirectionSums>> voxels) {
    DirectionTruth truth;
    std::size_t count = 0;
    for (const auto& v : voxels) count += v.size();
    const int points = static_cast<int>(std::clamp<std::size_t>(65536 / count, 128, kLobePoints));
    for (const auto& v : voxels) {
        for (const DirectionSums& s : v) truth.add(fitted(s), points);
    }
    return truth;
}

struct Sum {
    double sigma = 0.0;
    double cells = 0.0;
    double lobes = 0.0;
};

std::vector<std::size_t> choose(std::size_t count, std::size_t wanted, std::uint64_t seed) {
    std::vector<std::size_t> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = i;
    CounterRandom random{seed, 1};
    const std::size_t taken = std::min(count, wanted);
    for (std::size_t i = 0; i < taken; ++i) std::swap(all[i], all[i + random.next() % (count - i)]);
    all.resize(taken);
    return all;
}

/// The errors of each method's lobes at the chosen voxels, averaged.
std::vector<Sum> measure(const Finest& finest,
                         const Level& level,
                         const std::vector<VoxelLobes>& built,
                         const std::vector<std::size_t>& chosen) {
    const auto add = [](std::vector<Sum> a, const std::vector<Sum>& b) {
        for (std::size_t m = 0; m < a.size(); ++m) {
            a[m] = {a[m].sigma + b[m].sigma, a[m].cells + b[m].cells, a[m].lobes + b[m].lobes};
        }
        return a;
    };
    return reduce_chunks(
        chosen.size(), 1, std::vector<Sum>(built.size()),
        [&](std::size_t at, std::size_t) {
            const std::size_t voxel = chosen[at];
            const std::span<const Pool> all(finest.lobes);
            const DirectionTruth truth =
                add_up(all.subspan(level.first_finest[voxel],
                                   level.first_finest[voxel + 1] - level.first_finest[voxel]));
            const double scale = 1.0 / static_cast<double>(chosen.size());
            std::vector<Sum> sums;
            for (const VoxelLobes& method : built) {
                std::vector<MixtureLobe> mixture;
                for (const DirectionSums& s : method[voxel]) mixture.push_back(fitted(s));
                const DirectionError e = mixture_error(mixture, truth);
                sums.push_back({e.sigma * scale, e.cells * scale,
                                static_cast<double>(mixture.size()) * scale});
            }
            return sums;
        },
        add);
}

void run(const std::string& path, std::size_t parents, int levels) {
    const Finest finest = load(path);
    std::printf(
        "\n## %s: %zu voxels\n\n"
        "| level | parents | method | sigma error | / wasserstein | L1 error | / wasserstein "
        "| lobes | us a parent | times faster |\n|---|---|---|---|---|---|---|---|---|---|\n",
        std::filesystem::path(path).filename().c_str(), finest.code.size());
    std::vector<VoxelLobes> built(std::size(kMethods), finest.lobes);
    Level level;
    for (int number = 1; number <= levels; ++number) {
        level = number == 1 ? next_level(finest.code, nullptr)
                            : next_level(level.code, &level.first_finest);
        std::vector<double> seconds(std::size(kMethods));
        for (std::size_t m = 0; m < std::size(kMethods); ++m) {
            built[m] = build(level, built[m], kMethods[m], seconds[m]);
        }
        const std::vector<std::size_t> chosen =
            choose(level.code.size(), parents, static_cast<std::uint64_t>(number));
        const std::vector<Sum> sums = measure(finest, level, built, chosen);
        for (std::size_t m = 0; m < sums.size(); ++m) {
            std::printf(
                "| %d | %zu of %zu | %s | %.5f | %.2f | %.4f | %.2f | %.2f | %.2f | %.0f |\n",
                number, chosen.size(), level.code.size(), kMethods[m].name, sums[m].sigma,
                sums[m].sigma / sums[0].sigma, sums[m].cells, sums[m].cells / sums[0].cells,
                sums[m].lobes, seconds[m] * 1e6 / static_cast<double>(level.code.size()),
                seconds[0] / seconds[m]);
        }
        std::fflush(stdout);
    }
}

} // namespace
} // namespace heddle

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: heddle_lod_methods FILE.vdb [PARENTS] [LEVELS]\n");
        return 2;
    }
    try {
        heddle::run(argv[1], argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2000,
                    argc > 3 ? std::atoi(argv[3]) : 5);
    } catch (const heddle::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
