// Prints, as markdown, the error of each level's lobes against all directions of finest geometry.

#include "directions.h"
#include "parents.h"

#include <heddle/base/error.h>
#include <heddle/geom/generate.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/gltf/read_gltf.h>
#include <heddle/io/mesh/read_mesh.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/io/yarn/yarn_file.h>
#include <heddle/lod/build_levels.h>
#include <heddle/voxelize/voxelize.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace heddle::bench {
namespace {

constexpr std::size_t kParents = 2000; ///< per level; all if it has fewer
constexpr double kSpacing = 0.5;       ///< distance of points on triangles, subvoxels

double seconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

std::string data_path(const std::string& name) {
    const char* folder = std::getenv("HEDDLE_TEST_DATA");
    return (folder != nullptr ? std::string(folder) : std::string(HEDDLE_DATA_DIR)) + "/" + name;
}

/// Cloth of the preset yarn with 150 fibers, without flyaways.
Geometry make_cloth(GenerateKind kind) {
    Geometry geometry = generate({.kind = kind, .nx = 12, .ny = 12});
    YarnType yarn = read_yarn("cotton").yarn;
    set_fiber_count(yarn, 150);
    yarn.flyaways = false;
    geometry.yarns.push_back(yarn);
    for (CurveSet& set : geometry.curves) set.yarn = 0;
    return geometry;
}

struct Object {
    const char* name;
    std::int64_t voxels; ///< along the longest axis, with all methods but wasserstein
    std::int64_t few;    ///< the same with wasserstein, which takes milliseconds per parent
    Geometry (*make)();
    const char* file; ///< input file in the data folder
};

constexpr Object kObjects[] = {
    {"cable", 192, 64, [] { return make_cloth(GenerateKind::Cable); }, nullptr},
    {"plain", 192, 64, [] { return make_cloth(GenerateKind::Plain); }, nullptr},
    {"hair", 192, 48, [] { return read_curves(data_path("hair/straight.hair")); },
     "hair/straight.hair"},
    {"smallpine", 192, 48, [] { return read_gltf(data_path("mesh/smallpine/scene.gltf")); },
     "mesh/smallpine/scene.gltf"},
    {"lamp", 128, 48,
     [] { return read_gltf(data_path("mesh/AnisotropyBarnLamp/AnisotropyBarnLamp.gltf")); },
     "mesh/AnisotropyBarnLamp/AnisotropyBarnLamp.gltf"},
};

constexpr LodMethod kMethods[] = {LodMethod::Moments, LodMethod::Single, LodMethod::Naive,
                                  LodMethod::Random, LodMethod::Interpolate};

/// The errors of all levels of one method.
using MethodErrors = std::map<LodMethod, std::vector<LevelErrors>>;

/// Voxelizes with levels, writes them to a file and reads them back.
VoxelLevels build(const Geometry& geometry, std::int64_t voxels, LodMethod method) {
    VoxelizeOptions options;
    options.voxels = voxels;
    options.keep_sums = true;
    LevelBuilder builder({.method = method});
    Progress silent;
    const VoxelizePlan plan = plan_voxelize(geometry, options, silent);
    const VoxelLevels levels = builder.finish(voxelize(geometry, options, plan, silent, &builder));
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / str("heddle_lod_exact_", getpid(), ".vdb");
    write_vdb(levels, path.string(), silent);
    VoxelLevels read = read_levels(path.string());
    std::filesystem::remove(path);
    return read;
}

/// Chosen voxels of each level with the directions of the geometry in them.
std::vector<Parents> find_truth(const Geometry& geometry, const VoxelLevels& levels) {
    std::vector<Parents> parents;
    std::size_t walked = 0; // levels with directions of their own; others sum their children
    for (const auto& level : levels) {
        if (parents.empty() || !parents.back().has_all()) ++walked;
        parents.emplace_back(*level, kParents);
        parents.back().pool(*levels.front());
    }
    const TakeDirections take = [&](std::span<const Directed> directions) {
        for (std::size_t l = 0; l < walked; ++l) parents[l].add(directions);
    };
    const Lattice& lattice = levels.front()->info().lattice;
    if (!geometry.curves.empty()) walk_fibers(geometry, lattice, 0, take);
    if (!geometry.meshes.empty()) walk_triangles(geometry, lattice, kSpacing, take);
    for (std::size_t l = walked; l < parents.size(); ++l) parents[l].add_below(parents[l - 1]);
    return parents;
}

void print_row(const char* object,
               std::size_t level,
               const Parents& parents,
               const char* method,
               const LevelErrors& e) {
    std::printf("| %s | %zu | %zu | %zu | %s | %.4f | %.4f | %.4f | %.4f | %.4f | %.4f |\n", object,
                level, parents.voxels_in_level(), e.count, method, e.moment_max, e.moment_median,
                e.pooled_max, e.pooled_median, e.sigma, e.cells);
    std::fflush(stdout);
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f %%", 100.0 * share);
    return text;
}

/// Compares the levels above 0 with their goals and prints each row that misses one.
class Verdict {
public:
    void check(const std::string& object, const MethodErrors& errors) {
        const std::vector<LevelErrors>& moments = errors.at(LodMethod::Moments);
        for (std::size_t l = 0; l < moments.size(); ++l) {
            const std::string place = str(object, ", level ", l);
            const std::string at = place + ": ";
            const LevelErrors& m = moments[l];
            if (m.count == 0) continue;
            less(at + str("moment error, max (", m.over, " of ", m.count, " voxels over it, ",
                          percent(m.over_share), " of the area),"),
                 m.moment_max, kMomentGoal);
            less(at + "moment error, median", m.moment_median, 0.003);
            less(at + "moment error against level 0's sums, max", m.pooled_max, kMomentGoal);
            less(at + "moment error against level 0's sums, median", m.pooled_median, 0.003);
            if (l == 0) continue;
            const auto compare = [&](LodMethod method, double factor) {
                if (!errors.contains(method)) return;
                const LevelErrors& other = errors.at(method)[l];
                const std::string than =
                    str(" of moments against ", factor, " x ", name_of(method));
                less(at + "sigma" + than, m.sigma, factor * other.sigma);
                less(at + "L1" + than, m.cells, factor * other.cells);
            };
            compare(LodMethod::Wasserstein, 1.02);
            if (errors.contains(LodMethod::Wasserstein)) {
                const LevelErrors& other = errors.at(LodMethod::Wasserstein)[l];
                sigma_.note(m.sigma / other.sigma, place);
                cells_.note(m.cells / other.cells, place);
            }
            if (!(errors.at(LodMethod::Single)[l].sigma > 0.02)) continue;
            compare(LodMethod::Single, 1.0);
            compare(LodMethod::Naive, 1.0);
        }
    }
    void print() const {
        std::printf("\n%d of %d comparisons passed.\n\n", checks_ - static_cast<int>(lines_.size()),
                    checks_);
        for (const std::string& line : lines_) std::printf("- %s\n", line.c_str());
        for (const auto& [what, ratio] : {std::pair{"sigma", sigma_}, std::pair{"L1", cells_}}) {
            std::printf("\n%s of moments, of wasserstein's: %.3f to %.3f (%s)\n", what, ratio.least,
                        ratio.most, ratio.where.c_str());
        }
    }

private:
    void less(const std::string& what, double value, double limit) {
        ++checks_;
        if (value <= limit) return;
        char text[64];
        std::snprintf(text, sizeof text, " %.5f, goal %.5f", value, limit);
        lines_.push_back(what + text);
    }

    /// ratio of moments to wasserstein
    struct Ratio {
        double least = 1e9;
        double most = 0.0;
        std::string where;

        void note(double value, const std::string& at) {
            least = std::min(least, value);
            if (value <= most) return;
            most = value;
            where = at;
        }
    };

    int checks_ = 0;
    std::vector<std::string> lines_;
    Ratio sigma_, cells_;
};

void print_head() {
    std::printf(
        "| object | level | voxels | measured | method | moment max | median | sums: max | median | sigma | L1 |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
}

/// Measures an object with some methods and prints one row for each level and method.
void run(const Object& object,
         std::int64_t voxels,
         std::span<const LodMethod> methods,
         Verdict& verdict) {
    const Geometry geometry = object.make();
    std::vector<Parents> parents;
    MethodErrors errors[kKinds];
    const double start = seconds();
    std::string times;
    double lost = 0.0;
    for (const LodMethod method : methods) {
        const double begun = seconds();
        const VoxelLevels levels = build(geometry, voxels, method);
        times +=
            str(", ", name_of(method), " ", static_cast<int>(10.0 * (seconds() - begun)) / 10.0);
        if (parents.empty()) {
            const double walk = seconds();
            parents = find_truth(geometry, levels);
            times += str(", truth ", static_cast<int>(10.0 * (seconds() - walk)) / 10.0);
        }
        for (std::size_t l = 0; l < levels.size(); ++l) {
            const std::vector<Mixture> mixtures = decode(*levels[l], parents[l]);
            for (std::size_t kind = 0; kind < kKinds; ++kind) {
                errors[kind][method].push_back(
                    measure(mixtures, parents[l], static_cast<Kind>(kind)));
            }
        }
    }
    for (const Parents& p : parents) lost = std::max(lost, p.lost());
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
        if (errors[kind][methods[0]].back().count == 0) continue;
        const std::string name = str(object.name, " ", voxels, kind == 1 ? ", tangents" : "");
        for (std::size_t l = 0; l < parents.size(); ++l) {
            for (const LodMethod method : methods) {
                const bool any = l == 0; // it is the same for all methods
                print_row(name.c_str(), l, parents[l], any ? "-" : name_of(method),
                          errors[kind][method][l]);
                if (any) break;
            }
        }
        verdict.check(name, errors[kind]);
    }
    std::fprintf(stderr, "%s %lld: %.1f s%s; %.2e of the area in no voxel\n", object.name,
                 static_cast<long long>(voxels), seconds() - start, times.c_str(), lost);
}

/// Runs the objects that are named on the command line, or all.
void run_all(std::span<char* const> names, bool with_wasserstein, Verdict& verdict) {
    std::vector<LodMethod> methods(std::begin(kMethods), std::end(kMethods));
    if (with_wasserstein) methods.insert(methods.begin() + 1, LodMethod::Wasserstein);
    print_head();
    for (const Object& object : kObjects) {
        bool wanted = names.empty();
        for (const char* name : names) wanted = wanted || std::strcmp(name, object.name) == 0;
        if (!wanted) continue;
        if (object.file != nullptr && !std::filesystem::exists(data_path(object.file))) {
            std::fprintf(stderr, "%s: skipped, no '%s'; set HEDDLE_TEST_DATA\n", object.name,
                         data_path(object.file).c_str());
            continue;
        }
        run(object, with_wasserstein ? object.few : object.voxels, methods, verdict);
    }
    std::printf("\n");
}

} // namespace
} // namespace heddle::bench

/// heddle_lod_exact [OBJECT...]: both tables, of the named objects or of all.
int main(int argc, char** argv) try {
    using namespace heddle::bench;
    const std::span<char* const> names(argv + 1, static_cast<std::size_t>(argc - 1));
    Verdict verdict;
    std::printf("## Levels of fine voxels\n\n");
    run_all(names, false, verdict);
    std::printf("## Beside wasserstein, on coarser voxels\n\n");
    run_all(names, true, verdict);
    std::printf("## Goals\n");
    verdict.print();
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "heddle_lod_exact: %s\n", e.what());
    return 1;
}
