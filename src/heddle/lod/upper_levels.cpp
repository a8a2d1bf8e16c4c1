#include <heddle/lod/upper_levels.h>

#include <heddle/base/trig.h>
#include <heddle/voxel/footprint.h>

namespace heddle {
namespace {

Vec3i parent_index(Vec3i i) {
    return {floor_div(i.x, 2), floor_div(i.y, 2), floor_div(i.z, 2)};
}

std::size_t octant(Vec3i i) {
    return static_cast<std::size_t>((i.x & 1) << 2 | (i.y & 1) << 1 | (i.z & 1));
}

/// Returns the union of two ascending lists of runs.
UpperVoxel::Runs join(UpperVoxel::Runs a, UpperVoxel::Runs b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    UpperVoxel::Runs out;
    out.reserve(a.size() + b.size());
    auto i = a.begin();
    auto j = b.begin();
    while (i != a.end() || j != b.end()) {
        if (j == b.end() || (i != a.end() && i->first < j->first)) {
            out.push_back(std::move(*i++));
        } else if (i == a.end() || j->first < i->first) {
            out.push_back(std::move(*j++));
        } else {
            for (std::size_t k = 0; k < UpperVoxel::kRunWords; ++k) {
                (*i->second)[k] |= (*j->second)[k];
            }
            out.push_back(std::move(*i++));
            ++j;
        }
    }
    return out;
}

UpperVoxel::Runs copy(const UpperVoxel::Runs& runs) {
    UpperVoxel::Runs out;
    for (const auto& [at, run] : runs) {
        out.emplace_back(at, std::make_unique<UpperVoxel::Run::element_type>(*run));
    }
    return out;
}

/// Returns the children's runs, side by side across the axis and OR-ed along it.
UpperVoxel::Runs
join_children(std::array<std::unique_ptr<UpperVoxel>, 8>& child, int axis, int level) {
    const std::uint64_t per_quarter = std::uint64_t{1} << (2 * (level - 1 - kBlockLevel));
    UpperVoxel::Runs out;
    for (int place = 0; place < 4; ++place) { // in this order the list is ascending
        UpperVoxel::Runs here;
        for (int c = 0; c < 8; ++c) {
            UpperVoxel* from = child[static_cast<std::size_t>(c)].get();
            if (from == nullptr || quarter({c >> 2, c >> 1 & 1, c & 1}, axis) != place) continue;
            here = join(std::move(here), std::move(from->columns[static_cast<std::size_t>(axis)]));
        }
        for (auto& [at, run] : here) {
            out.emplace_back(at + static_cast<std::uint64_t>(place) * per_quarter, std::move(run));
        }
    }
    return out;
}

/// Stores one voxel as a leaf of its own, which is joined with others later.
void store_voxel(const UpperVoxel& upper,
                 const LobePool& pool,
                 int level,
                 Vec3i index,
                 const LevelOptions& options,
                 VoxelBlock& out) {
    VoxelLeaf& leaf = out.leaves.emplace_back();
    leaf.origin = {index.x & ~7, index.y & ~7, index.z & ~7};
    const Vec3i at = index - leaf.origin;
    leaf.active[static_cast<std::size_t>(at.x)] = std::uint64_t{1} << (at.y * 8 + at.z);
    std::array<std::int64_t, 3> covered{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const auto& [place, run] : upper.columns[axis]) {
            covered[axis] += count_bits(*run);
        }
    }
    append_coverage(upper.voxel, covered, level, options, out);
    if (options.fields.footprints != 0) {
        std::array<std::uint64_t, 3>& bits = out.footprints.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Footprint face(level, options.lattice.subvoxels);
            for (const auto& [place, run] : upper.columns[axis]) {
                for (std::size_t k = 0; k < run->size(); ++k) {
                    face.add(place * UpperVoxel::kRunWords + k, (*run)[k]);
                }
            }
            bits[axis] = face.bits(options.fields.footprints);
        }
    }
    RecentFits fits;
    append_lobes(pool, upper.voxel.order, options.fields, fits, out);
}

} // namespace

std::unique_ptr<UpperVoxel> take_upper(const OpenLevel& level) {
    if (level.voxels.empty()) return nullptr;
    auto out = std::make_unique<UpperVoxel>();
    out->voxel = level.voxels[0];
    out->lobes = level.lobes;
    out->maps = level.maps;
    if (level.columns.empty()) return out;
    for (int axis = 0; axis < 3; ++axis) {
        auto run = std::make_unique<UpperVoxel::Run::element_type>();
        const std::span<const std::uint64_t> words = level.words_of(0, axis);
        std::copy(words.begin(), words.end(), run->begin());
        out->columns[static_cast<std::size_t>(axis)].emplace_back(0, std::move(run));
    }
    return out;
}

UpperLevels::UpperLevels(std::span<const Vec3i> blocks,
                         int top,
                         const LevelOptions& options,
                         Store store)
    : options_(options), store_(std::move(store)), blocks_(blocks.begin(), blocks.end()) {
    std::vector<Vec3i> below = blocks_;
    std::vector<std::uint32_t>* parents = &parent_of_block_;
    std::vector<std::uint32_t> of_nodes;
    for (int level = kBlockLevel + 1; level <= top; ++level) {
        std::vector<Vec3i> here; // the children of a voxel are consecutive in `below`
        std::vector<int> children;
        parents->clear();
        for (const Vec3i i : below) {
            const Vec3i parent = parent_index(i);
            if (here.empty() || !(here.back() == parent)) {
                here.push_back(parent);
                children.push_back(0);
            }
            ++children.back();
            parents->push_back(static_cast<std::uint32_t>(here.size() - 1));
        }
        if (parents == &of_nodes) {
            std::vector<Node>& nodes = levels_.back().nodes;
            for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n].parent = of_nodes[n];
        }
        parents = &of_nodes;
        NodeLevel& made = levels_.emplace_back();
        made.nodes = std::vector<Node>(here.size());
        for (std::size_t n = 0; n < here.size(); ++n) {
            made.nodes[n].index = here[n];
            made.nodes[n].waits = children[n];
        }
        below = std::move(here);
    }
}

std::size_t UpperLevels::count(int level) const {
    const auto at = static_cast<std::size_t>(level - kBlockLevel - 1);
    return level > kBlockLevel && at < levels_.size() ? levels_[at].nodes.size() : 0;
}

std::vector<Vec3i> UpperLevels::index_of(int level) const {
    std::vector<Vec3i> out;
    for (const Node& node : levels_[static_cast<std::size_t>(level - kBlockLevel - 1)].nodes) {
        out.push_back(node.index);
    }
    return out;
}

std::vector<std::array<UpperVoxel::Runs, 3>> UpperLevels::take_columns(int level) {
    std::vector<std::array<UpperVoxel::Runs, 3>> out;
    for (Node& node : levels_[static_cast<std::size_t>(level - kBlockLevel - 1)].nodes) {
        out.push_back(std::move(node.kept));
    }
    return out;
}

void UpperLevels::take(std::size_t rank, std::unique_ptr<UpperVoxel> voxel) {
    Vec3i index = blocks_[rank];
    std::size_t number = levels_.empty() ? 0 : parent_of_block_[rank];
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Node& node = levels_[l].nodes[number];
        node.child[octant(index)] = std::move(voxel);
        if (node.waits.fetch_sub(1) != 1) return; // another thread delivers the last child
        voxel = close(node, static_cast<int>(l) + kBlockLevel + 1, number);
        index = node.index;
        number = node.parent;
    }
}

std::unique_ptr<UpperVoxel> UpperLevels::close(Node& node, int level, std::size_t number) {
    auto out = std::make_unique<UpperVoxel>();
    auto pool = std::make_unique<LobePool>();
    std::array<int, 9> first{};
    std::array<const OpenVoxel*, 8> seen{};
    pool->count = 0;
    for (std::size_t c = 0; c < 8; ++c) {
        first[c] = pool->count;
        const UpperVoxel* child = node.child[c].get();
        if (child == nullptr) continue;
        seen[c] = &child->voxel;
        for (std::size_t i = 0; i < child->lobes.size(); ++i) {
            pool->add(child->lobes[i], options_.merge.with_maps ? &child->maps[i] : nullptr);
        }
    }
    first[8] = pool->count;
    if (pool->count == 0) return nullptr;
    join_seen(out->voxel, options_.coverage, seen);
    for (int axis = 0; axis < 3; ++axis) {
        out->columns[static_cast<std::size_t>(axis)] = join_children(node.child, axis, level);
    }
    out->voxel.order =
        merge_children(*pool, first, options_.merge, seed_of(options_, level, node.index));
    const auto count = static_cast<std::ptrdiff_t>(pool->count);
    out->lobes.assign(pool->sums.begin(), pool->sums.begin() + count);
    if (options_.merge.with_maps) out->maps.assign(pool->maps.begin(), pool->maps.begin() + count);
    join_slabs(out->voxel, out->lobes.front(), options_, seen);
    node.child = {};
    if (options_.fields.correlation) {
        for (std::size_t axis = 0; axis < 3; ++axis) node.kept[axis] = copy(out->columns[axis]);
    }
    VoxelBlock stored;
    store_voxel(*out, *pool, level, node.index, options_, stored);
    store_(level, number, stored);
    return out;
}

} // namespace heddle
