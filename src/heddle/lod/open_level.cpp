#include <heddle/lod/open_level.h>

#include <heddle/base/random.h>
#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/footprint.h>
#include <heddle/voxel/leaf_voxels.h>
#include <heddle/voxel/occupancy.h>
#include <heddle/voxel/parent_slab.h>

#include <bit>
#include <cmath>

namespace heddle {
namespace {

/// Number of steps that leaves an error of 3e-5 in a moment; packing leaves one of 1e-3.
constexpr int kMomentSteps = 3;

void set_sums(DirectionSums& sums, const SymmetricMatrix& M, double weight) {
    sums.weight = std::max<std::int64_t>(1, std::llround(weight));
    const float entries[6]{M.xx, M.yy, M.zz, M.xy, M.xz, M.yz};
    for (int k = 0; k < 6; ++k) {
        sums.moment[k] = std::llround(static_cast<double>(entries[k]) * weight);
    }
}

MapSums sums_of(const LobeMaps& maps, const PackedSggx& tangents, std::int64_t weight) {
    MapSums sums;
    for (std::size_t i = 0; i < 3; ++i) sums.albedo[i] = maps.albedo[i] * weight;
    sums.roughness = maps.roughness * weight;
    sums.metalness = maps.metalness * weight;
    sums.anisotropy = maps.anisotropy * weight;
    if (tangents == PackedSggx{}) return sums;
    DirectionSums moment;
    set_sums(moment, second_moment_of<kMomentSteps>(unpack(tangents)), static_cast<double>(weight));
    std::copy_n(moment.moment, 6, sums.tangent.begin());
    return sums;
}

void open_lobes(const BlockVoxel& voxel, const LevelOptions& options, OpenLevel& out) {
    constexpr double kOneVoxel = 67108864.0; // 64 units^2 at a depth of 1; the true unit is unknown
    const VoxelBlock& stored = voxel.block;
    double per_weight = 0.0;
    if (stored.moments.empty()) {
        for (const Lobe& lobe : voxel.lobes()) per_weight += lobe.weight;
        per_weight =
            kOneVoxel * mean_depth(voxel.coverage(), options.lattice.subvoxels) / per_weight;
    }
    const std::size_t end = voxel.lobe + voxel.lobe_count();
    for (std::size_t i = voxel.lobe; i < end; ++i) {
        const Lobe& lobe = stored.lobes[i];
        DirectionSums& sums = out.lobes.emplace_back();
        sums.material = lobe.material;
        sums.normals = options.normals.has(lobe.material);
        if (stored.moments.empty()) {
            set_sums(sums, second_moment_of<kMomentSteps>(unpack(lobe.sggx)),
                     per_weight * lobe.weight);
        } else {
            std::copy_n(stored.moments[i].moment.begin(), 6, sums.moment);
            sums.weight = stored.moments[i].weight;
        }
        if (!options.merge.with_maps) continue;
        if (!stored.map_sums.empty()) {
            out.maps.push_back(stored.map_sums[i]);
        } else {
            out.maps.push_back(sums_of(stored.maps.empty() ? LobeMaps{} : stored.maps[i],
                                       stored.tangents.empty() ? PackedSggx{} : stored.tangents[i],
                                       sums.weight));
        }
    }
}

/// Sets the numbers of a parent's up to eight children; -1: no such child.
/// @return  false: there are no children
bool find_children(const OpenLevel& below, Vec3i parent, std::array<int, 8>& child) {
    bool any = false;
    for (int c = 0; c < 8; ++c) {
        const Vec3i at{2 * parent.x + (c >> 2), 2 * parent.y + (c >> 1 & 1),
                       2 * parent.z + (c & 1)};
        const std::uint16_t slot = below.slot[below.cell(at)];
        child[static_cast<std::size_t>(c)] = slot == OpenLevel::kNone ? -1 : slot;
        any = any || slot != OpenLevel::kNone;
    }
    return any;
}

void join_columns(const OpenLevel& below, const std::array<int, 8>& child, OpenLevel& out) {
    const std::size_t words = below.words();
    const std::size_t voxel = out.voxels.size() - 1;
    out.columns.resize(3 * (voxel + 1) * out.words());
    for (int c = 0; c < 8; ++c) {
        const int from = child[static_cast<std::size_t>(c)];
        if (from < 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const auto place = static_cast<std::size_t>(quarter({c >> 2, c >> 1 & 1, c & 1}, axis));
            const std::uint64_t* in = below.words_of(static_cast<std::size_t>(from), axis).data();
            std::uint64_t* to = out.words_of(voxel, axis).data() + place * words;
            for (std::size_t i = 0; i < words; ++i) to[i] |= in[i];
        }
    }
}

void merge_lobes(const OpenLevel& below,
                 const std::array<int, 8>& child,
                 const LevelOptions& options,
                 std::uint64_t seed,
                 LobePool& pool,
                 OpenLevel& out) {
    std::array<int, 9> first{};
    pool.count = 0;
    for (std::size_t c = 0; c < 8; ++c) {
        first[c] = pool.count;
        if (child[c] < 0) continue;
        const OpenVoxel& from = below.voxels[static_cast<std::size_t>(child[c])];
        for (std::size_t i = from.first_lobe; i < from.first_lobe + from.lobe_count; ++i) {
            pool.add(below.lobes[i], options.merge.with_maps ? &below.maps[i] : nullptr);
        }
    }
    first[8] = pool.count;
    OpenVoxel& voxel = out.voxels.back();
    voxel.order = merge_children(pool, first, options.merge, seed);
    voxel.first_lobe = static_cast<std::uint32_t>(out.lobes.size());
    voxel.lobe_count = static_cast<std::uint8_t>(pool.count);
    const auto count = static_cast<std::ptrdiff_t>(pool.count);
    out.lobes.insert(out.lobes.end(), pool.sums.begin(), pool.sums.begin() + count);
    if (options.merge.with_maps) {
        out.maps.insert(out.maps.end(), pool.maps.begin(), pool.maps.begin() + count);
    }
}

std::uint16_t to_fixed16(double x) {
    return static_cast<std::uint16_t>(std::clamp(x, 0.0, 1.0) * 65535.0 + 0.5);
}

} // namespace

double mean_depth(const Coverage& c, int subvoxels) {
    const double least = 0.5 / (static_cast<double>(subvoxels) * subvoxels);
    const auto open = [&](std::uint16_t of) {
        return std::max(1.0 - static_cast<double>(of) / 65535.0, least);
    };
    return std::log(open(c.x) * open(c.y) * open(c.z)) * (-1.0 / 3.0);
}

void OpenLevel::reset(int level_in, Vec3i block) {
    level = level_in;
    origin = block * edge();
    const auto n = static_cast<std::size_t>(edge());
    slot.assign(n * n * n, kNone);
    voxels.clear();
    columns.clear();
    lobes.clear();
    maps.clear();
}

std::uint64_t seed_of(const LevelOptions& options, int level, Vec3i index) {
    const auto u = [](std::int32_t i) { return static_cast<std::uint64_t>(i); };
    return hash64(options.seed + static_cast<std::uint64_t>(level),
                  hash64(1, u(index.x), u(index.y)), u(index.z));
}

void join_seen(OpenVoxel& parent, CoverageRule rule, const std::array<const OpenVoxel*, 8>& child) {
    const bool product = rule == CoverageRule::Product;
    for (int octant = 0; octant < 8; ++octant) {
        const OpenVoxel* const c = child[static_cast<std::size_t>(octant)];
        if (c == nullptr) continue;
        parent.hits += c->hits;
        parent.cells |= cells_in_parent(c->cells, octant);
    }
    if (rule == CoverageRule::Union) return;
    for (int axis = 0; axis < 3; ++axis) {
        const int along = 4 >> axis;
        double sum = 0.0;
        for (int c = 0; c < 8; ++c) {
            if ((c & along) != 0) continue;
            const OpenVoxel* a = child[static_cast<std::size_t>(c)];
            const OpenVoxel* b = child[static_cast<std::size_t>(c | along)];
            const double none = product ? 1.0 : 0.0;
            const double near = a == nullptr ? none : a->seen[axis];
            const double far = b == nullptr ? none : b->seen[axis];
            sum += product ? near * far : 0.5 * (near + far);
        }
        parent.seen[axis] = 0.25 * sum;
    }
}

void join_slabs(OpenVoxel& parent,
                const DirectionSums& first_lobe,
                const LevelOptions& options,
                const std::array<const OpenVoxel*, 8>& child) {
    if (!options.fields.slabs || !options.normals.has(first_lobe.material)) return;
    ParentNormal main;
    for (const OpenVoxel* of : child) {
        if (of != nullptr && of->slab.there) main.add(slab_normal(of->slab.planes), of->hits);
    }
    parent.slab = OpenSlab({0, 255, main.normal()}, options.lattice.voxel_size);
    ParentSlab joined{parent.slab.gradient};
    for (int c = 0; c < 8; ++c) {
        const OpenVoxel* const of = child[static_cast<std::size_t>(c)];
        if (of != nullptr && of->slab.there) joined.add(c, of->slab.gradient, of->slab.planes);
    }
    parent.slab.planes = joined.slab(parent.slab.planes.normal);
}

void open_block(const VoxelBlock& stored,
                Vec3i block,
                const LevelOptions& options,
                OpenLevel& out) {
    out.reset(0, block);
    const std::int64_t n = options.lattice.subvoxels;
    const CoverageRule rule = options.coverage;
    for_each_voxel(stored, [&](const BlockVoxel& from) {
        out.slot[out.cell(from.at - out.origin)] = static_cast<std::uint16_t>(out.voxels.size());
        const Coverage& c = from.coverage();
        OpenVoxel& voxel = out.voxels.emplace_back();
        voxel.hits = (std::int64_t{c.occupancy} * n * n * n + 32767) / 65535;
        voxel.cells = from.occupancy();
        const std::array<std::uint16_t, 3> covered{c.x, c.y, c.z};
        for (int a = 0; a < 3; ++a) {
            const double seen = covered[static_cast<std::size_t>(a)] / 65535.0;
            voxel.seen[a] = rule == CoverageRule::Product ? 1.0 - seen : seen;
        }
        voxel.first_lobe = static_cast<std::uint32_t>(out.lobes.size());
        voxel.lobe_count = stored.lobe_count[from.voxel];
        open_lobes(from, options, out);
        const Lobe& first = from.lobes().front();
        if (options.fields.slabs && options.normals.has(first.material)) {
            voxel.slab = OpenSlab(from.slab(), options.lattice.voxel_size);
        }
        if (rule == CoverageRule::Union) {
            const auto& columns = stored.columns[from.voxel];
            out.columns.insert(out.columns.end(), columns.begin(), columns.end());
        }
    });
}

void build_level(const OpenLevel& below,
                 const LevelOptions& options,
                 LobePool& pool,
                 OpenLevel& out) {
    const int edge = out.edge();
    for (int x = 0; x < edge; ++x) {
        for (int y = 0; y < edge; ++y) {
            for (int z = 0; z < edge; ++z) {
                std::array<int, 8> child;
                if (!find_children(below, {x, y, z}, child)) continue;
                out.slot[out.cell({x, y, z})] = static_cast<std::uint16_t>(out.voxels.size());
                OpenVoxel& voxel = out.voxels.emplace_back();
                std::array<const OpenVoxel*, 8> seen{};
                for (std::size_t c = 0; c < 8; ++c) {
                    if (child[c] >= 0) seen[c] = &below.voxels[static_cast<std::size_t>(child[c])];
                }
                join_seen(voxel, options.coverage, seen);
                if (options.coverage == CoverageRule::Union) join_columns(below, child, out);
                merge_lobes(below, child, options,
                            seed_of(options, out.level, out.origin + Vec3i{x, y, z}), pool, out);
                join_slabs(voxel, out.lobes[voxel.first_lobe], options, seen);
            }
        }
    }
}

void append_coverage(const OpenVoxel& voxel,
                     const std::array<std::int64_t, 3>& covered,
                     int level,
                     const LevelOptions& options,
                     VoxelBlock& out) {
    const double n = std::ldexp(static_cast<double>(options.lattice.subvoxels), level);
    Coverage& c = out.coverage.emplace_back();
    c.occupancy = wide_fraction16(voxel.hits, n * n * n);
    if (options.fields.occupancy) out.occupancy.push_back(voxel.cells);
    if (options.fields.slabs) out.slabs.push_back(voxel.slab.planes);
    if (options.coverage == CoverageRule::Union) {
        c.x = wide_fraction16(covered[0], n * n);
        c.y = wide_fraction16(covered[1], n * n);
        c.z = wide_fraction16(covered[2], n * n);
        return;
    }
    const bool product = options.coverage == CoverageRule::Product;
    c.x = to_fixed16(product ? 1.0 - voxel.seen.x : voxel.seen.x);
    c.y = to_fixed16(product ? 1.0 - voxel.seen.y : voxel.seen.y);
    c.z = to_fixed16(product ? 1.0 - voxel.seen.z : voxel.seen.z);
}

HEDDLE_CLONES void append_footprints(const OpenLevel& level,
                                     std::size_t v,
                                     const LevelOptions& options,
                                     VoxelBlock& out) {
    std::array<std::uint64_t, 3>& bits = out.footprints.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
        Footprint face(level.level, options.lattice.subvoxels);
        const std::span<const std::uint64_t> words = level.words_of(v, axis);
        for (std::size_t i = 0; i < words.size(); ++i) face.add(i, words[i]);
        bits[static_cast<std::size_t>(axis)] = face.bits(options.fields.footprints);
    }
}

HEDDLE_CLONES std::int64_t count_bits(std::span<const std::uint64_t> words) {
    std::int64_t sum = 0;
    for (const std::uint64_t w : words) sum += std::popcount(w);
    return sum;
}

namespace {

void append_voxel(const OpenLevel& level,
                  std::size_t v,
                  const LevelOptions& options,
                  LobePool& pool,
                  RecentFits& fits,
                  VoxelBlock& out) {
    std::array<std::int64_t, 3> covered{};
    if (options.coverage == CoverageRule::Union) {
        for (int axis = 0; axis < 3; ++axis) {
            std::int64_t& count = covered[static_cast<std::size_t>(axis)];
            count = count_bits(level.words_of(v, axis));
        }
        if (options.fields.footprints != 0) append_footprints(level, v, options, out);
    }
    const OpenVoxel& voxel = level.voxels[v];
    append_coverage(voxel, covered, level.level, options, out);
    pool.count = 0;
    for (std::size_t i = voxel.first_lobe; i < voxel.first_lobe + voxel.lobe_count; ++i) {
        pool.add(level.lobes[i], options.merge.with_maps ? &level.maps[i] : nullptr);
    }
    append_lobes(pool, voxel.order, options.fields, fits, out);
}

/// Returns the end of the range of voxels, at most `edge`, that lie in the same leaf as voxel `i`.
constexpr int leaf_end(int i, int edge) {
    return std::min(edge, (i / 8 + 1) * 8);
}

} // namespace

void store_level(const OpenLevel& level,
                 const LevelOptions& options,
                 LobePool& pool,
                 RecentFits& fits,
                 VoxelBlock& out,
                 std::vector<std::uint64_t>* kept) {
    const int edge = level.edge();
    for (int lx = 0; lx < edge; lx += 8) {
        for (int ly = 0; ly < edge; ly += 8) {
            for (int lz = 0; lz < edge; lz += 8) {
                VoxelLeaf leaf;
                const Vec3i corner = level.origin + Vec3i{lx, ly, lz};
                leaf.origin = {corner.x & ~7, corner.y & ~7, corner.z & ~7};
                leaf.first_voxel = static_cast<std::uint32_t>(out.coverage.size());
                leaf.first_lobe = static_cast<std::uint32_t>(out.lobes.size());
                for (int x = lx; x < leaf_end(lx, edge); ++x) {
                    for (int y = ly; y < leaf_end(ly, edge); ++y) {
                        for (int z = lz; z < leaf_end(lz, edge); ++z) {
                            const std::uint16_t slot = level.slot[level.cell({x, y, z})];
                            if (slot == OpenLevel::kNone) continue;
                            const Vec3i at = level.origin + Vec3i{x, y, z} - leaf.origin;
                            leaf.active[static_cast<std::size_t>(at.x)] |= std::uint64_t{1}
                                                                           << (at.y * 8 + at.z);
                            append_voxel(level, slot, options, pool, fits, out);
                            if (kept != nullptr) level.append_words(slot, *kept);
                        }
                    }
                }
                if (out.coverage.size() > leaf.first_voxel) out.leaves.push_back(leaf);
            }
        }
    }
}

} // namespace heddle
