#include <heddle/io/vol/read_vol.h>

#include <heddle/base/error.h>
#include <heddle/base/parallel.h>
#include <heddle/base/trig.h>
#include <heddle/io/vol/vol_medium.h>
#include <heddle/voxel/occupancy.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace heddle {
namespace {

constexpr int kLeaf = 8;
constexpr int kBlock = 32; // as in the voxelizer: aligned, so no two blocks have the same leaf

auto order(Vec3i v) {
    return std::tuple(v.x, v.y, v.z);
}

/// The samples of one block of voxels; 0 where the volume has none.
struct BlockSamples {
    std::vector<float> density = std::vector<float>(std::size_t{kBlock} * kBlock * kBlock);
    std::vector<Vec3f> tangent = std::vector<Vec3f>(density.size());

    [[nodiscard]] static std::size_t index(std::int32_t x, std::int32_t y, std::int32_t z) {
        return static_cast<std::size_t>((x * kBlock + y) * kBlock + z);
    }
};

struct BlockCounts {
    std::int64_t voxels = 0;
    std::int64_t isotropic = 0;
};

class VolSource final : public VoxelLevel {
public:
    VolSource(const VolLayout& layout, const VolOptions& options, double scale, Vec3i origin)
        : layout_(layout), origin_(origin), medium_(layout.pitch, scale) {
        info_.name = layout.name;
        info_.lattice = {layout.pitch, VolMedium::kSubvoxels};
        info_.max_lobes = options.max_lobes;
        info_.fields.occupancy = options.occupancy;
        info_.command = options.command;
        Material material;
        material.name = layout.name;
        material.kind = MaterialKind::Fiber;
        material.albedo = options.albedo;
        info_.materials = {material};
        list_corners();
    }

    std::vector<Vec3i> corners; ///< voxel indices of the blocks' corners, ascending

    [[nodiscard]] std::size_t block_count() const override { return corners.size(); }
    [[nodiscard]] const VoxelBlock& block(std::size_t i, VoxelBlock& scratch) const override {
        static_cast<void>(make_block(corners[i], scratch));
        return scratch;
    }
    BlockCounts make_block(Vec3i corner, VoxelBlock& out) const;

private:
    void list_corners();
    [[nodiscard]] const VolBlock* find_block(Vec3i at) const;
    void gather(Vec3i corner, BlockSamples& out) const;
    void
    add_samples(const VolBlock& block, Vec3i lo, Vec3i hi, Vec3i base, BlockSamples& out) const;
    BlockCounts
    append_leaf(const BlockSamples& samples, Vec3i base, VoxelLeaf& leaf, VoxelBlock& out) const;

    VolLayout layout_;
    Vec3i origin_; ///< voxel of sample (0, 0, 0)
    VolMedium medium_;
};

void VolSource::list_corners() {
    for (const VolBlock& b : layout_.blocks) {
        Vec3i lo, hi;
        for (int a = 0; a < 3; ++a) {
            const std::int32_t pitch = layout_.block_samples[a] - 1;
            lo[a] = floor_div(origin_[a] + b.at[a] * pitch, kBlock);
            hi[a] = floor_div(origin_[a] + b.at[a] * pitch + pitch, kBlock);
        }
        for (Vec3i c = lo; c.x <= hi.x; ++c.x) {
            for (c.y = lo.y; c.y <= hi.y; ++c.y) {
                for (c.z = lo.z; c.z <= hi.z; ++c.z) corners.push_back(c * kBlock);
            }
        }
    }
    std::sort(corners.begin(), corners.end(), [](Vec3i a, Vec3i b) { return order(a) < order(b); });
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
}

const VolBlock* VolSource::find_block(Vec3i at) const {
    const auto found =
        std::lower_bound(layout_.blocks.begin(), layout_.blocks.end(), at,
                         [](const VolBlock& b, Vec3i v) { return order(b.at) < order(v); });
    return found != layout_.blocks.end() && found->at == at ? &*found : nullptr;
}

/// @param lo, hi  range of samples in the whole volume, inside the block
/// @param base    the sample that is the first one of `out`
void VolSource::add_samples(
    const VolBlock& block, Vec3i lo, Vec3i hi, Vec3i base, BlockSamples& out) const {
    Vec3i start;
    for (int a = 0; a < 3; ++a) start[a] = block.at[a] * (layout_.block_samples[a] - 1);
    std::vector<float> density;
    VolFile(block.density).read_densities(lo - start, hi - start, density);
    if (std::all_of(density.begin(), density.end(), [](float d) { return d == 0.0f; })) return;
    std::vector<Vec3f> tangent(block.orientation.empty() ? density.size() : 0);
    if (tangent.empty())
        VolFile(block.orientation).read_directions(lo - start, hi - start, tangent);
    std::size_t i = 0;
    for (std::int32_t z = lo.z; z < hi.z; ++z) {
        for (std::int32_t y = lo.y; y < hi.y; ++y) {
            for (std::int32_t x = lo.x; x < hi.x; ++x, ++i) {
                const std::size_t to = BlockSamples::index(x - base.x, y - base.y, z - base.z);
                if (density[i] <= out.density[to]) continue; // shared, and not denser
                out.density[to] = density[i];
                out.tangent[to] = tangent[i];
            }
        }
    }
}

void VolSource::gather(Vec3i corner, BlockSamples& out) const {
    const Vec3i base = corner - origin_;
    const Vec3i end = layout_.samples();
    Vec3i lo, hi, first, last;
    for (int a = 0; a < 3; ++a) {
        const std::int32_t pitch = layout_.block_samples[a] - 1;
        lo[a] = std::max(0, base[a]);
        hi[a] = std::min(end[a], base[a] + kBlock);
        first[a] = std::max(0, lo[a] - 1) / pitch; // the previous block's last layer may be lo
        last[a] = std::min(layout_.cells[a] - 1, (hi[a] - 1) / pitch);
    }
    for (Vec3i at = first; at.x <= last.x; ++at.x) {
        for (at.y = first.y; at.y <= last.y; ++at.y) {
            for (at.z = first.z; at.z <= last.z; ++at.z) {
                const VolBlock* block = find_block(at);
                if (block == nullptr) continue;
                Vec3i from, to;
                for (int a = 0; a < 3; ++a) {
                    const std::int32_t pitch = layout_.block_samples[a] - 1;
                    from[a] = std::max(lo[a], at[a] * pitch);
                    to[a] = std::min(hi[a], at[a] * pitch + pitch + 1);
                }
                add_samples(*block, from, to, base, out);
            }
        }
    }
}

BlockCounts VolSource::append_leaf(const BlockSamples& samples,
                                   Vec3i base,
                                   VoxelLeaf& leaf,
                                   VoxelBlock& out) const {
    BlockCounts counts;
    for (std::int32_t x = 0; x < kLeaf; ++x) {
        for (std::int32_t bit = 0; bit < kLeaf * kLeaf; ++bit) {
            const std::size_t i =
                BlockSamples::index(base.x + x, base.y + bit / kLeaf, base.z + bit % kLeaf);
            if (samples.density[i] == 0.0f) continue;
            const Vec3f tangent = samples.tangent[i];
            const Coverage c = medium_.coverage(samples.density[i], tangent);
            if (c.x == 0 && c.y == 0 && c.z == 0) continue;
            leaf.active[static_cast<std::size_t>(x)] |= std::uint64_t{1} << bit;
            out.coverage.push_back(c);
            out.lobe_count.push_back(1);
            out.lobes.push_back({VolMedium::lobe(tangent), 255, 0});
            if (info_.fields.occupancy) out.occupancy.push_back(kAllCells);
            ++counts.voxels;
            counts.isotropic += tangent == Vec3f{} ? 1 : 0;
        }
    }
    return counts;
}

BlockCounts VolSource::make_block(Vec3i corner, VoxelBlock& out) const {
    out.leaves.clear();
    VoxelBlock::for_each_array(out, [](auto& v) { v.clear(); });
    BlockSamples samples;
    gather(corner, samples);
    BlockCounts counts;
    for (Vec3i base; base.x < kBlock; base.x += kLeaf) {
        for (base.y = 0; base.y < kBlock; base.y += kLeaf) {
            for (base.z = 0; base.z < kBlock; base.z += kLeaf) {
                VoxelLeaf leaf;
                leaf.origin = corner + base;
                leaf.first_voxel = static_cast<std::uint32_t>(out.coverage.size());
                leaf.first_lobe = static_cast<std::uint32_t>(out.lobes.size());
                const BlockCounts more = append_leaf(samples, base, leaf, out);
                if (more.voxels > 0) out.leaves.push_back(leaf);
                counts.voxels += more.voxels;
                counts.isotropic += more.isotropic;
            }
        }
    }
    return counts;
}

/// The voxel whose centre is nearest to sample (0, 0, 0).
Vec3i find_origin(const VolLayout& layout) {
    constexpr double kMax = 1 << 30;
    Vec3i origin;
    for (int a = 0; a < 3; ++a) {
        const double at = std::floor(layout.bounds.lo[a] / layout.pitch[a]);
        if (!(at >= -kMax && at + layout.samples()[a] <= kMax)) {
            throw Error(ErrorCode::BadFile,
                        str("its samples along ", "xyz"[a], " lie ", at,
                            " voxels from the origin, ", "at most 2^30 are allowed"),
                        "move the volume towards the origin", {.path = layout.blocks[0].density});
        }
        origin[a] = static_cast<std::int32_t>(at);
    }
    return origin;
}

std::string note_move(const VolLayout& layout, Vec3i origin) {
    Vec3d move;
    for (int a = 0; a < 3; ++a) {
        move[a] = (origin[a] + 0.5) * layout.pitch[a] - layout.bounds.lo[a];
    }
    return str("moved by (", move.x, ", ", move.y, ", ", move.z,
               ") scene units, at most half a voxel: samples lie at voxels' centres");
}

/// Reads all samples to count the voxels, and drops the blocks that are empty.
BlockCounts count_voxels(VolSource& source, Progress& progress) {
    std::vector<BlockCounts> counts(source.corners.size());
    progress.begin("read", "blocks", static_cast<std::int64_t>(counts.size()));
    parallel_chunks(counts.size(), 1, [&](std::size_t begin, std::size_t end) {
        progress.check();
        VoxelBlock scratch;
        for (std::size_t i = begin; i < end; ++i) {
            counts[i] = source.make_block(source.corners[i], scratch);
        }
        progress.advance(static_cast<std::int64_t>(end - begin));
    });
    BlockCounts sum;
    std::vector<Vec3i> occupied;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        sum.voxels += counts[i].voxels;
        sum.isotropic += counts[i].isotropic;
        if (counts[i].voxels > 0) occupied.push_back(source.corners[i]);
    }
    source.corners = std::move(occupied);
    return sum;
}

} // namespace

VolVolume read_vol(const VolLayout& layout, const VolOptions& options, Progress& progress) {
    const Vec3i origin = find_origin(layout);
    const bool given = options.density_scale > 0.0;
    const double scale = given ? options.density_scale : default_density_scale(layout.pitch);
    auto source = std::make_unique<VolSource>(layout, options, scale, origin);
    const BlockCounts counts = count_voxels(*source, progress);
    VoxelLevelInfo info = source->info();
    info.voxel_count = info.lobe_count = counts.voxels;
    source->set_info(std::move(info));
    VolVolume out;
    out.notes.push_back(note_move(layout, origin));
    if (!given) {
        out.notes.push_back(str(
            "density scale ", scale,
            ": density 1 covers 86 % of a voxel's face; give a scene's 'scale' as --density-scale"));
    }
    if (!layout.orientation_encoding) {
        out.notes.emplace_back(
            "no directions: all voxels are isotropic; name their file with --orientation");
    } else if (counts.isotropic > 0) {
        out.notes.push_back(str(counts.isotropic, " of ", counts.voxels,
                                " voxels have no direction: they are isotropic"));
    }
    out.grid = std::move(source);
    return out;
}

} // namespace heddle
