#include <heddle/render/volume/traversal_level.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

/// Reduces a footprint of 8 x 8 cells to 4 x 4: keeps the covered fraction, and sets the fullest
/// cells first.
std::uint64_t halve_footprint(std::uint64_t bits) {
    std::array<int, 16> count{};
    for (; bits != 0; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        ++count[static_cast<std::size_t>((bit >> 4) * 4 + (bit >> 1 & 3))];
    }
    const int total = std::accumulate(count.begin(), count.end(), 0);
    std::uint64_t out = 0;
    for (int set = (total + 2) / 4; set > 0; --set) {
        const auto fullest = std::max_element(count.begin(), count.end());
        out |= std::uint64_t{1} << (fullest - count.begin());
        *fullest = -1;
    }
    return out;
}

/// Packs three footprints of n x n cells into 48 bits.
std::uint64_t pack_footprints(const std::array<std::uint64_t, 3>& from, int n) {
    std::uint64_t out = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        out |= (n == 8 ? halve_footprint(from[a]) : from[a]) << (16 * a);
    }
    return out;
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

TraversalLevel::TraversalLevel(const VoxelLevel& source) : info_(source.info()) {
    const std::vector<std::uint16_t> table = depth_table(info_.lattice);
    voxels_.reserve(static_cast<std::size_t>(info_.voxel_count));
    lobes_.reserve(static_cast<std::size_t>(info_.lobe_count));
    constexpr float kUnknown = std::numeric_limits<float>::infinity();
    float thinnest = kUnknown;
    for (const Material& m : info_.materials) {
        fibers_only_ &= m.kind == MaterialKind::Fiber;
        if (m.fiber_radius > 0.0f) thinnest = std::min(thinnest, m.fiber_radius);
    }
    const Vec3d h = info_.lattice.voxel_size;
    const auto edge = static_cast<float>(std::max({h.x, h.y, h.z}));
    if (thinnest < kUnknown) fibers_across_ = std::log2(edge / thinnest);
    IndexBox box;
    VoxelBlock scratch;
    for (std::size_t b = 0; b < source.block_count(); ++b) {
        append(source.block(b, scratch), table, box);
    }
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
    for (const auto& footprint : block.footprints) {
        footprints_.push_back(pack_footprints(footprint, info_.fields.footprints));
    }
    append_to(correlation_, block.correlation);
    if (!block.slabs.empty()) append_sheets(block, first_voxel);
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
           bytes_of(maps_) + bytes_of(tangents_) + bytes_of(footprints_) + bytes_of(correlation_) +
           bytes_of(sheets_);
}

} // namespace heddle
