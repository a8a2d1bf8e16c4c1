#include <heddle/render/volume/traversal_level.h>

#include <heddle/base/parallel.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle {
namespace {

/// Returns TraversalVoxel::depth per 16-bit coverage c, capped like the field `density`: -ln(1 - c)
/// with c <= 1 - 1 / (2 columns).
std::vector<std::uint16_t> depth_table(const Lattice& lattice) {
    const double columns = static_cast<double>(lattice.subvoxels) * lattice.subvoxels;
    const double cap = 1.0 - 0.5 / columns;
    std::vector<std::uint16_t> table(65536);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double depth = -std::log1p(-std::min(static_cast<double>(i) / 65535.0, cap));
        table[i] = static_cast<std::uint16_t>(
            std::min(std::round(depth / static_cast<double>(kDepthUnit)), 65535.0));
    }
    return table;
}

float coverage_of(std::uint16_t depth) {
    return -std::expm1(-kDepthUnit * static_cast<float>(depth));
}

/// Returns the volume of long cylinders as a share of the subvoxels that are hit, over all
/// directions: in each column along z that a cylinder covers, it enters one subvoxel more than it
/// fills.
/// @param edge  of a subvoxel
double share_of_hit(double radius, double edge) {
    const double disc = std::numbers::pi * radius * radius;
    return disc / (disc + 0.5 * std::numbers::pi * radius * edge);
}

/// Calls f(voxel, index) for the voxels of a leaf.
/// @param origin  of the leaf
template <typename F>
void for_each_voxel(const TraversalLeaf& leaf, Vec3i origin, const F& f) {
    auto v = static_cast<std::size_t>(leaf.first_voxel);
    for_each_active(leaf.mask.active,
                    [&](std::size_t x, int bit) { f(v++, voxel_index(origin, x, bit)); });
}

template <typename T>
void append_to(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

template <typename T>
std::int64_t bytes_of(const std::vector<T>& v) {
    return static_cast<std::int64_t>(v.capacity() * sizeof(T));
}

} // namespace

TraversalLevel::TraversalLevel(const VoxelLevel& source, const VoxelLevel* parents)
    : info_(source.info()) {
    const std::vector<std::uint16_t> table = depth_table(info_.lattice);
    voxels_.reserve(static_cast<std::size_t>(info_.voxel_count));
    lobes_.reserve(static_cast<std::size_t>(info_.lobe_count));
    for (const Material& m : info_.materials) fibers_only_ &= m.kind == MaterialKind::Fiber;
    IndexBox box;
    VoxelBlock scratch;
    std::vector<Vec3i> origins;
    std::vector<std::array<std::uint8_t, 3>> correlation;
    for (std::size_t b = 0; b < source.block_count(); ++b) {
        const VoxelBlock& block = source.block(b, scratch);
        append(block, table, box);
        for (const VoxelLeaf& leaf : block.leaves) origins.push_back(leaf.origin);
        append_to(correlation, block.correlation);
    }
    if (has_cells() && correlation.empty() && parents != nullptr) correlation = correlate(*parents);
    if (has_cells()) fit_cells(origins, correlation);
    if (box.empty()) return;
    lo_ = box.lo;
    hi_ = box.hi + Vec3i{1, 1, 1};
}

void TraversalLevel::append(const VoxelBlock& block,
                            const std::vector<std::uint16_t>& depth_of_coverage,
                            IndexBox& box) {
    const std::size_t first_voxel = voxels_.size();
    const std::size_t first_lobe = lobes_.size();
    for (const VoxelLeaf& from : block.leaves) {
        table_.add(from.origin);
        box.grow(box_of(from));
        leaves_.push_back({RankedMask(from.active), first_voxel + from.first_voxel,
                           first_lobe + from.first_lobe});
        const TraversalLeaf& leaf = leaves_.back();
        const std::size_t count = leaf.mask.count();
        std::uint32_t lobe = 0;
        for (std::size_t v = from.first_voxel; v < from.first_voxel + count; ++v) {
            const Coverage& c = block.coverage[v];
            occupancy_ += c.occupancy;
            const std::uint32_t lobes = block.lobe_count[v];
            voxels_.push_back(
                {{depth_of_coverage[c.x], depth_of_coverage[c.y], depth_of_coverage[c.z]},
                 static_cast<std::uint16_t>(lobe | (lobes - 1) << 12)});
            lobe += lobes;
        }
    }
    append_to(lobes_, block.lobes);
    append_to(maps_, block.maps);
    append_to(tangents_, block.tangents);
    if (fibers_only_) append_to(cells_, block.occupancy);
    if (!block.slabs.empty()) append_sheets(block, first_voxel);
}

std::vector<std::array<std::uint8_t, 3>>
TraversalLevel::correlate(const VoxelLevel& parents) const {
    std::vector<std::array<std::uint8_t, 3>> out(voxels_.size());
    for_each_voxel(parents, [&](const BlockVoxel& parent) {
        const Coverage& c = parent.coverage();
        const std::array<std::uint16_t, 3> whole{c.x, c.y, c.z};
        const TraversalLeaf* const leaf = find_leaf(parent.at * 2).leaf; // of all its children
        if (leaf == nullptr) return;
        std::array<std::int64_t, 8> child;
        for (int i = 0; i < 8; ++i) {
            const Vec3i at = parent.at * 2 + Vec3i{i >> 2, i >> 1 & 1, i & 1};
            child[static_cast<std::size_t>(i)] = leaf->find(at);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto coverage = [&](std::size_t i) {
                return child[i] < 0
                           ? 0.0f
                           : coverage_of(voxels_[static_cast<std::size_t>(child[i])].depth[axis]);
            };
            const std::size_t step = std::size_t{4} >> axis;
            float independent = 0.0f, nested = 0.0f; // unions of the four pairs behind each other
            for (std::size_t i = 0; i < 8; ++i) {
                if ((i & step) != 0) continue;
                const float c1 = coverage(i), c2 = coverage(i + step);
                independent += c1 + c2 - c1 * c2;
                nested += std::max(c1, c2);
            }
            if (!(independent > nested)) continue;
            const float both = 4.0f * static_cast<float>(whole[axis]) / 65535.0f;
            const float rho = std::clamp((independent - both) / (independent - nested), 0.0f, 1.0f);
            for (const std::int64_t v : child) {
                if (v < 0) continue;
                out[static_cast<std::size_t>(v)][axis] =
                    static_cast<std::uint8_t>(rho * 255.0f + 0.5f);
            }
        }
    });
    return out;
}

std::int64_t TraversalLevel::next_voxel(Vec3i at, int axis) const {
    ++at[axis];
    const LeafLookup place = find_leaf(at);
    return place.leaf == nullptr ? -1 : place.leaf->find(at);
}

Vec3f TraversalLevel::depths(std::int64_t v) const {
    const TraversalVoxel& from = voxel(v);
    Vec3f out;
    for (int a = 0; a < 3; ++a) {
        const std::uint16_t depth = from.depth[static_cast<std::size_t>(a)];
        out[a] = has_cells() ? -std::log1p(-coverage_of_cells(sort_columns(cells(v), a),
                                                              unpack_extinction({depth})))
                             : static_cast<float>(depth) * kDepthUnit;
    }
    return out;
}

void TraversalLevel::find_crowding(const std::vector<std::array<float, 3>>& extinction) {
    double radius = 0.0, fibers = 0.0;
    for (const Material& m : info_.materials) {
        if (!(m.fiber_radius > 0.0f)) continue;
        radius += static_cast<double>(m.fiber_radius);
        fibers += 1.0;
    }
    if (fibers == 0.0) return;
    radius /= fibers;
    double blocked = 0.0; // sum over the cells of their coverage, in faces of a voxel
    for (std::size_t v = 0; v < voxels_.size(); ++v) {
        for (const float along : extinction[v]) {
            blocked += -std::expm1(static_cast<double>(along) / -kCells) *
                       std::popcount(cells_[v]) / (3.0 * kCells * kCells);
        }
    }
    const Vec3d h = info_.lattice.voxel_size;
    const double edge = std::cbrt(h.x * h.y * h.z);
    const double volume = static_cast<double>(occupancy_) / 65535.0 *
                          share_of_hit(radius, edge / info_.lattice.subvoxels);
    if (!(blocked > 0.0)) return;
    // Cylinders of diameter D and volume v cover 4 v / (pi D), if they do not cover each other.
    const double diameter = 4.0 * volume * edge / (std::numbers::pi * blocked);
    crowding_ = static_cast<float>(std::max(1.0, diameter / (2.0 * radius)));
    bundle_transmittance_ = std::exp(1.0f - crowding_);
}

void TraversalLevel::fit_cells(const std::vector<Vec3i>& origins,
                               const std::vector<std::array<std::uint8_t, 3>>& correlation) {
    constexpr std::size_t kGrain = 16; // leaves
    using PerAxis = std::array<float, 3>;
    const auto for_voxels = [&](const auto& f) {
        parallel_chunks(leaves_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) for_each_voxel(leaves_[i], origins[i], f);
        });
    };
    const Vec3d h = info_.lattice.voxel_size;
    cell_section_ = static_cast<float>(std::pow(h.x * h.y * h.z, 2.0 / 3.0)) / (kCells * kCells);
    std::vector<PerAxis> extinction(voxels_.size());
    for_voxels([&](std::size_t v, Vec3i) {
        for (std::size_t a = 0; a < 3; ++a) {
            extinction[v][a] = fit_extinction(sort_columns(cells_[v], static_cast<int>(a)),
                                              coverage_of(voxels_[v].depth[a]));
        }
    });
    find_crowding(extinction);
    // of each voxel and the one after it, and the part that this leaves of the later one
    std::vector<PerAxis> first(correlation.empty() ? 0 : voxels_.size(), PerAxis{1.0f, 1.0f, 1.0f});
    std::vector<PerAxis> second = first;
    if (!correlation.empty()) {
        for_voxels([&](std::size_t v, Vec3i at) {
            for (std::size_t a = 0; a < 3; ++a) {
                const int axis = static_cast<int>(a);
                const std::int64_t next = next_voxel(at, axis);
                if (next < 0) continue;
                const auto row_voxel = [&](std::size_t w) {
                    return RowVoxel{sort_columns(cells_[w], axis), extinction[w][a],
                                    coverage_of(voxels_[w].depth[a])};
                };
                const auto after = static_cast<std::size_t>(next);
                const float together = fit_pair(row_voxel(v), row_voxel(after),
                                                static_cast<float>(correlation[v][a]) / 255.0f);
                first[v][a] = together;
                second[after][a] = together;
            }
        });
    }
    for_voxels([&](std::size_t v, Vec3i) {
        for (std::size_t a = 0; a < 3; ++a) {
            const float in_row = first.empty() ? 1.0f : first[v][a] + second[v][a] - 1.0f;
            voxels_[v].depth[a] = pack_extinction(extinction[v][a], in_row).bits;
        }
    });
}

void TraversalLevel::append_sheets(const VoxelBlock& block, std::size_t first_voxel) {
    std::size_t lobe = 0;
    for (std::size_t v = 0; v < block.slabs.size(); ++v) {
        const Lobe& first = block.lobes[lobe];
        lobe += block.lobe_count[v];
        const bool fiber = info_.materials[first.material].kind == MaterialKind::Fiber;
        if (fiber) {
            sheets_.push_back({{}, 0, 0, 0, voxels_[first_voxel + v].depth});
            continue;
        }
        const Coverage& c = block.coverage[v];
        const auto share = [](std::uint16_t x) { return static_cast<double>(x) / 65535.0; };
        sheets_.push_back(
            make_sheet(info_.lattice, {block.slabs[v], {share(c.x), share(c.y), share(c.z)}}));
    }
}

std::int64_t TraversalLevel::byte_count() const {
    return table_.byte_count() + bytes_of(leaves_) + bytes_of(voxels_) + bytes_of(lobes_) +
           bytes_of(maps_) + bytes_of(tangents_) + bytes_of(cells_) + bytes_of(sheets_);
}

} // namespace heddle
