#include <heddle/preview/preview_volume.h>

#include <heddle/base/parallel.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/index_box.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <cmath>

namespace heddle::preview {
namespace {

std::uint8_t to_byte(float unit) {
    return static_cast<std::uint8_t>(std::clamp(unit, 0.0f, 1.0f) * 255.0f + 0.5f);
}

/// Returns a table of -ln(1 - c) as bytes, one for each coverage c.
std::vector<std::uint8_t> make_depths() {
    std::vector<std::uint8_t> table(65536);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double c = std::min(static_cast<double>(i) / 65535.0, 1.0 - 1.0 / 128.0);
        const double depth = -std::log1p(-c) / double{kMaxDepth} * 255.0;
        table[i] = static_cast<std::uint8_t>(i == 0 ? 0 : std::max(1.0, std::round(depth)));
    }
    return table;
}

/// Returns 0 for a needle and 1 for a ball: the square root of the mean of the two smaller
/// eigenvalues over the largest.
float lobe_width(const SggxMatrix& S, Vec3f axis) {
    const float largest = dot(axis, multiply(S, axis));
    const float rest = 0.5f * (S.xx + S.yy + S.zz - largest);
    return largest > 0.0f ? std::sqrt(std::max(0.0f, rest / largest)) : 1.0f;
}

class Packer {
public:
    Packer(const VoxelLevelInfo& info, bool tangents)
        : info_(info), tangents_(tangents && info.fields.tangents), depths_(make_depths()) {}

    [[nodiscard]] PreviewVoxel pack(const BlockVoxel& voxel) const {
        const Lobe& lobe = voxel.lobes()[0];
        const SggxMatrix S = unpack(lobe.sggx);
        Vec3f axis = principal_direction(S);
        const Coverage& c = voxel.coverage();
        PreviewVoxel out{};
        out.depth = {depths_[c.x], depths_[c.y], depths_[c.z]};
        out.width = to_byte(lobe_width(S, axis));
        for (int a = 0; a < 3; ++a) out.flags |= static_cast<std::uint8_t>((axis[a] < 0.0f) << a);
        const bool brushed = tangents_ && voxel.tangents()[0].sigma[0] != 0; // all zero: isotropic
        if (brushed) axis = principal_direction(unpack(voxel.tangents()[0]));
        for (int a = 0; a < 3; ++a) {
            out.axis[static_cast<std::size_t>(a)] =
                static_cast<std::int8_t>(std::lround(axis[a] * 127.0f));
        }
        out.material = lobe.material;
        if (lobe.material < info_.materials.size()) {
            if (info_.materials[lobe.material].kind == MaterialKind::Fiber) out.flags |= 8;
        }
        out.color = mean_color(voxel);
        return out;
    }

private:
    /// Returns the mean of all lobes by weight: a fiber over a surface shows both colours.
    [[nodiscard]] std::array<std::uint8_t, 3> mean_color(const BlockVoxel& voxel) const {
        Vec3f sum;
        float weight = 0.0f;
        for (std::size_t l = 0; l < voxel.lobe_count(); ++l) {
            Vec3f albedo{0.8f, 0.8f, 0.8f};
            const Lobe& lobe = voxel.lobes()[l];
            if (lobe.material < info_.materials.size()) {
                albedo = info_.materials[lobe.material].albedo;
            }
            if (info_.fields.albedo) {
                const auto& map = voxel.maps()[l].albedo;
                albedo = albedo * Vec3f{map[0] / 255.0f, map[1] / 255.0f, map[2] / 255.0f};
            }
            sum = sum + albedo * static_cast<float>(lobe.weight);
            weight += static_cast<float>(lobe.weight);
        }
        const float s = 1.0f / std::max(weight, 1.0f);
        return {to_byte(std::sqrt(std::max(0.0f, sum.x * s))),
                to_byte(std::sqrt(std::max(0.0f, sum.y * s))),
                to_byte(std::sqrt(std::max(0.0f, sum.z * s)))};
    }

    const VoxelLevelInfo& info_;
    bool tangents_;
    std::vector<std::uint8_t> depths_;
};

std::vector<PreviewVoxel> pack_block(const Packer& packer, const VoxelBlock& block) {
    std::vector<PreviewVoxel> voxels;
    voxels.reserve(block.coverage.size());
    // in the order of leaves, since first_voxel may have gaps
    for_each_voxel(block, [&](const BlockVoxel& v) { voxels.push_back(packer.pack(v)); });
    return voxels;
}

} // namespace

PreviewVolume::PreviewVolume(const VoxelLevel& source, bool tangents, Progress& progress)
    : voxel_size_(source.info().lattice.voxel_size), voxels_(source.block_count()) {
    const Packer packer(source.info(), tangents);
    std::vector<std::vector<VoxelLeaf>> blocks(source.block_count());
    progress.begin("gather", "blocks", static_cast<std::int64_t>(blocks.size()));
    parallel_chunks(blocks.size(), 1, [&](std::size_t i, std::size_t) {
        progress.check();
        VoxelBlock scratch;
        const VoxelBlock& block = source.block(i, scratch);
        blocks[i] = block.leaves;
        voxels_[i] = pack_block(packer, block);
        progress.advance(1);
    });
    IndexBox box; // of leaf indices
    for (std::uint32_t b = 0; b < blocks.size(); ++b) {
        add_leaves(blocks[b], b);
        for (const VoxelLeaf& leaf : blocks[b]) {
            box.grow(Vec3i{leaf.origin.x >> 3, leaf.origin.y >> 3, leaf.origin.z >> 3});
        }
    }
    lo_ = box.lo;
    hi_ = box.hi;
    if (leaves_.empty()) return;
    for (int a = 0; a < 3; ++a) {
        bounds_lo_[a] = lo_[a] * 8.0 * voxel_size_[a];
        bounds_hi_[a] = (hi_[a] + 1) * 8.0 * voxel_size_[a];
    }
}

void PreviewVolume::add_leaves(std::span<const VoxelLeaf> leaves, std::uint32_t block) {
    std::uint32_t first = 0;
    for (const VoxelLeaf& from : leaves) {
        table_.add(from.origin);
        leaves_.push_back({RankedMask(from.active), first, block});
        first += leaves_.back().mask.count();
    }
}

} // namespace heddle::preview
