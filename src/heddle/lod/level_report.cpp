#include <heddle/lod/level_report.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/lod/parent_truth.h>
#include <heddle/sggx/merge_order.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/leaf_voxels.h>
#include <heddle/voxel/z_order.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace heddle {
namespace {

std::uint64_t hash_of(Vec3i i, std::uint64_t seed) {
    const auto word = [](std::int32_t v) { return static_cast<std::uint64_t>(v); };
    return hash64(hash64(seed, word(i.x), word(i.y)), word(i.z));
}

/// A chosen parent as one method's level stores it.
struct Taken {
    Coverage coverage;
    std::array<Lobe, kMaxLobes> lobes{};
    std::uint8_t count = 0;

    [[nodiscard]] bool same_lobes(const Taken& other) const {
        return count == other.count && lobes == other.lobes;
    }
};

struct TakenMethod {
    std::string name;
    std::vector<LevelErrors> levels;        ///< only the counts are set
    std::vector<std::vector<Taken>> parent; ///< [level - 1][number in Impl::parents]
};

/// The errors of one method for one parent.
struct ParentErrors {
    DirectionError direction;
    double lost = 0.0;
    std::array<double, 3> coverage{};
};

using Key = std::pair<std::uint64_t, Vec3i>;

/// Returns the `wanted` voxels with the smallest hashes, in Z-order.
std::vector<Vec3i> choose_voxels(const VoxelLevel& level, int wanted, std::uint64_t seed) {
    const auto n = static_cast<std::size_t>(wanted);
    const auto less = [](const Key& a, const Key& b) { return a.first < b.first; };
    std::vector<Key> all;
    const auto cut = [&] {
        if (all.size() <= n) return;
        std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n), all.end(),
                         less);
        all.resize(n);
    };
    VoxelBlock scratch;
    for (std::size_t b = 0; b < level.block_count(); ++b) {
        for (const VoxelLeaf& leaf : level.block(b, scratch).leaves) {
            for_each_active(leaf.active, [&](std::size_t x, int bit) {
                const Vec3i at = voxel_index(leaf.origin, x, bit);
                all.emplace_back(hash_of(at, seed), at);
            });
        }
        if (all.size() > 4 * n) cut();
    }
    cut();
    std::vector<Vec3i> out;
    for (const Key& key : all) out.push_back(key.second);
    std::sort(out.begin(), out.end(), z_order_less);
    return out;
}

Taken take_voxel(const VoxelIndex& level, Vec3i at) {
    Taken out;
    level.for_each_below(0, at, [&](const BlockVoxel& v) {
        out.coverage = v.coverage();
        out.count = v.block.lobe_count[v.voxel];
        std::copy(v.lobes().begin(), v.lobes().end(), out.lobes.begin());
    });
    return out;
}

/// Returns the errors of a voxel's lobes: of tangents and normals, averaged by weight.
ParentErrors
direction_errors(const Taken& taken, const ParentTruth& truth, const NormalMaterials& normals) {
    ParentErrors out;
    const double all = truth.weight();
    double kept = 0.0;
    for (const bool kind : {false, true}) {
        const auto& of = truth.of[kind ? 1 : 0];
        if (!of) continue;
        std::vector<MixtureLobe> lobes;
        for (std::size_t i = 0; i < taken.count; ++i) {
            const Lobe& lobe = taken.lobes[i];
            if (normals[lobe.material] != kind) continue;
            lobes.push_back({unpack(lobe.sggx), static_cast<double>(lobe.weight)});
        }
        if (lobes.empty()) continue;
        const DirectionError e = mixture_error(lobes, *of);
        out.direction.sigma += of->weight * e.sigma;
        out.direction.cells += of->weight * e.cells;
        out.direction.moment = std::max(out.direction.moment, e.moment);
        kept += of->weight;
    }
    if (kept > 0.0) {
        out.direction.sigma /= kept;
        out.direction.cells /= kept;
    }
    out.lost = all > 0.0 ? 1.0 - kept / all : 0.0;
    return out;
}

std::array<std::uint16_t, 3> faces_of(const Coverage& c) {
    return {c.x, c.y, c.z};
}

/// Sets the means, medians and extremes over the parents.
void sum_up(const std::vector<ParentErrors>& parents, bool with_coverage, LevelErrors& out) {
    out.parents = static_cast<int>(parents.size());
    const double n = std::max(1.0, static_cast<double>(parents.size()));
    std::vector<double> moments;
    double coverage = 0.0;
    double worst = 0.0;
    for (const ParentErrors& e : parents) {
        out.sigma += e.direction.sigma / n;
        out.cells += e.direction.cells / n;
        out.lost += e.lost / n;
        moments.push_back(e.direction.moment);
        for (const double c : e.coverage) {
            coverage += c / (3.0 * n);
            worst = std::max(worst, c);
        }
    }
    std::sort(moments.begin(), moments.end());
    if (!moments.empty()) {
        out.moment = moments[moments.size() / 2];
        out.moment_worst = moments.back();
    }
    if (!with_coverage) return;
    out.coverage = coverage;
    out.coverage_worst = worst;
}

} // namespace

struct LevelReporter::Impl {
    Impl(const VoxelLevel& source, const VoxelLevels* levels, const LevelReportOptions& asked)
        : finest(source), file(levels), options(asked) {
        const std::vector<Material>& materials = source.info().materials;
        for (std::size_t m = 0; m < materials.size() && m < normals.size(); ++m) {
            normals[m] = materials[m].kind == MaterialKind::Surface;
        }
    }

    VoxelIndex finest;
    const VoxelLevels* file;
    LevelReportOptions options;
    NormalMaterials normals{};
    std::vector<std::vector<Vec3i>> parents; ///< [level - 1], in Z-order
    std::vector<TakenMethod> methods;

    /// Returns the reference of a parent: the sum of its children's if `below` is not empty.
    /// @param below  references of all voxels of the level below, or empty
    [[nodiscard]] ParentTruth
    truth_of(int level, Vec3i at, const std::vector<ParentTruth>& below) const {
        if (below.empty()) return pool_truth(finest, level, at, normals);
        const std::vector<Vec3i>& children = parents[static_cast<std::size_t>(level - 2)];
        const Vec3i corner = at * 2;
        ParentTruth sum;
        for (auto c = std::lower_bound(children.begin(), children.end(), corner, z_order_less);
             c != children.end() && Vec3i{c->x >> 1, c->y >> 1, c->z >> 1} == at; ++c) {
            sum.add(below[static_cast<std::size_t>(c - children.begin())]);
        }
        return sum;
    }

    /// Returns what a level's coverage is compared with.
    [[nodiscard]] CoverageTruth coverage_truth(int level) const {
        if (finest.source().info().fields.masks) {
            return level <= kMaxUnionLevel ? CoverageTruth::Union : CoverageTruth::None;
        }
        const bool there = file != nullptr && static_cast<std::size_t>(level) < file->size();
        return there ? CoverageTruth::File : CoverageTruth::None;
    }

    [[nodiscard]] std::vector<std::array<std::uint16_t, 3>> coverages(int level) const;
    [[nodiscard]] std::vector<std::vector<ParentErrors>>
    measure_level(int level, std::vector<ParentTruth>& truths, Progress& progress) const;
};

/// Returns the true coverage of a level's parents; empty if it is not known.
std::vector<std::array<std::uint16_t, 3>> LevelReporter::Impl::coverages(int level) const {
    const std::vector<Vec3i>& at = parents[static_cast<std::size_t>(level - 1)];
    const CoverageTruth from = coverage_truth(level);
    if (from == CoverageTruth::None) return {};
    std::vector<std::array<std::uint16_t, 3>> out(at.size());
    if (from == CoverageTruth::Union) {
        parallel_chunks(at.size(), 1, [&](std::size_t i, std::size_t) {
            out[i] = union_of_columns(finest, level, at[i]);
        });
    } else {
        const VoxelIndex stored(*(*file)[static_cast<std::size_t>(level)]);
        for (std::size_t i = 0; i < at.size(); ++i) {
            out[i] = faces_of(take_voxel(stored, at[i]).coverage);
        }
    }
    return out;
}

/// Returns the errors by method and parent.
/// @param truths  in: references of all voxels of the level below, or empty; out: of the parents
std::vector<std::vector<ParentErrors>> LevelReporter::Impl::measure_level(
    int level, std::vector<ParentTruth>& truths, Progress& progress) const {
    const auto l = static_cast<std::size_t>(level - 1);
    const std::vector<Vec3i>& at = parents[l];
    const auto covered = coverages(level);
    const std::vector<ParentTruth> below = std::exchange(truths, {});
    truths.resize(at.size());
    std::vector<std::vector<ParentErrors>> errors(methods.size(),
                                                  std::vector<ParentErrors>(at.size()));
    parallel_chunks(at.size(), 1, [&](std::size_t i, std::size_t) {
        progress.check();
        truths[i] = truth_of(level, at[i], below);
        for (std::size_t m = 0; m < methods.size(); ++m) {
            const Taken& taken = methods[m].parent[l][i];
            std::size_t same = 0; // a method's lobes are often those of the file
            while (!methods[same].parent[l][i].same_lobes(taken)) ++same;
            ParentErrors& mine = errors[m][i];
            mine = same < m ? errors[same][i] : direction_errors(taken, truths[i], normals);
            for (std::size_t a = 0; a < 3 && !covered.empty(); ++a) {
                const int off = int{faces_of(taken.coverage)[a]} - int{covered[i][a]};
                mine.coverage[a] = std::abs(off) / 65535.0;
            }
        }
        progress.advance(1);
    });
    return errors;
}

LevelReporter::LevelReporter(const VoxelLevel& finest,
                             const VoxelLevels* file,
                             const LevelReportOptions& options)
    : impl_(std::make_unique<Impl>(finest, file, options)) {}

LevelReporter::~LevelReporter() = default;

CoverageTruth LevelReporter::coverage_truth() const {
    return impl_->coverage_truth(1);
}

void LevelReporter::take(const std::string& name, const VoxelLevels& levels) {
    Impl& s = *impl_;
    const bool first = s.methods.empty();
    TakenMethod taken{name, {}, {}};
    for (std::size_t l = 1; l < levels.size(); ++l) {
        const VoxelIndex index(*levels[l]);
        if (first) {
            s.parents.push_back(choose_voxels(*levels[l], s.options.parents, s.options.seed));
        }
        const VoxelLevelInfo& info = levels[l]->info();
        LevelErrors& row = taken.levels.emplace_back();
        row.level = static_cast<int>(l);
        row.voxels = info.voxel_count;
        row.lobes = info.lobe_count;
        std::vector<Taken>& here = taken.parent.emplace_back();
        for (const Vec3i& at : l <= s.parents.size() ? s.parents[l - 1] : std::vector<Vec3i>{}) {
            here.push_back(take_voxel(index, at));
            if (here.back().count > 0) continue;
            throw Error(ErrorCode::InvalidArgument,
                        str("lod report: the levels by '", name, "' lack voxel (", at.x, ", ", at.y,
                            ", ", at.z, ") of level ", l, " that others have"),
                        "build them over one finest level");
        }
    }
    if (levels.size() - 1 != s.parents.size()) {
        throw Error(ErrorCode::InvalidArgument,
                    str("lod report: '", name, "' has ", levels.size() - 1, " levels above 0, not ",
                        s.parents.size()),
                    "build as many for each method");
    }
    s.methods.push_back(std::move(taken));
}

std::vector<MethodErrors> LevelReporter::measure(Progress& progress) {
    Impl& s = *impl_;
    std::vector<MethodErrors> out;
    for (const TakenMethod& m : s.methods) out.push_back({m.name, m.levels});
    std::int64_t total = 0;
    for (const auto& at : s.parents) total += static_cast<std::int64_t>(at.size());
    progress.begin("measure", "parents", total);
    std::vector<ParentTruth> truths;
    for (std::size_t l = 0; l < s.parents.size() && !out.empty(); ++l) {
        const int level = static_cast<int>(l) + 1;
        const auto errors = s.measure_level(level, truths, progress);
        for (std::size_t m = 0; m < out.size(); ++m) {
            sum_up(errors[m], s.coverage_truth(level) != CoverageTruth::None, out[m].levels[l]);
        }
        const bool all = static_cast<std::int64_t>(s.parents[l].size()) == out[0].levels[l].voxels;
        if (!all) truths.clear(); // some children of the next level's voxels were not measured
    }
    return out;
}

std::vector<std::size_t>
choose_blocks(const VoxelLevel& source, std::int64_t voxels, std::uint64_t seed) {
    std::vector<std::pair<std::uint64_t, std::size_t>> all;
    VoxelBlock scratch;
    for (std::size_t b = 0; b < source.block_count(); ++b) all.emplace_back(hash64(seed, b), b);
    std::sort(all.begin(), all.end());
    std::vector<std::size_t> out;
    std::int64_t there = 0;
    for (const auto& [hash, b] : all) {
        if (there >= voxels) break;
        out.push_back(b);
        there += static_cast<std::int64_t>(source.block(b, scratch).coverage.size());
    }
    std::sort(out.begin(), out.end());
    return out;
}

} // namespace heddle
