#include <heddle/preview/scene.h>

#include <heddle/base/parallel.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/pack.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heddle::preview {
namespace {

std::uint8_t to_byte(float unit) {
    return static_cast<std::uint8_t>(std::clamp(unit, 0.0f, 1.0f) * 255.0f + 0.5f);
}

/// -ln(1 - c) as a byte, by coverage.
std::vector<std::uint8_t> make_depths() {
    std::vector<std::uint8_t> table(65536);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double c = std::min(static_cast<double>(i) / 65535.0, 1.0 - 1.0 / 128.0);
        const double depth = -std::log1p(-c) / double{kMaxDepth} * 255.0;
        table[i] = static_cast<std::uint8_t>(i == 0 ? 0 : std::max(1.0, std::round(depth)));
    }
    return table;
}

/// How far from a needle: square root of the mean of the two smaller eigenvalues over the largest.
float lobe_width(const SggxMatrix& S, Vec3f axis) {
    const float largest = dot(axis, multiply(S, axis));
    const float rest = 0.5f * (S.xx + S.yy + S.zz - largest);
    return largest > 0.0f ? std::sqrt(std::max(0.0f, rest / largest)) : 1.0f;
}

class Packer {
public:
    Packer(const VoxelGridInfo& info, bool tangents)
        : info_(info), tangents_(tangents && info.fields.tangents), depths_(make_depths()) {}

    [[nodiscard]] Voxel pack(const VoxelBlock& block, std::size_t v, std::size_t l) const {
        const Lobe& lobe = block.lobes[l];
        const SggxMatrix S = unpack(lobe.sggx);
        Vec3f axis = principal_direction(S);
        const Coverage& c = block.coverage[v];
        Voxel out{};
        out.depth = {depths_[c.x], depths_[c.y], depths_[c.z]};
        out.width = to_byte(lobe_width(S, axis));
        for (int a = 0; a < 3; ++a) out.flags |= static_cast<std::uint8_t>((axis[a] < 0.0f) << a);
        const bool brushed = tangents_ && block.tangents[l].sigma[0] != 0; // all zero: isotropic
        if (brushed) axis = principal_direction(unpack(block.tangents[l]));
        for (int a = 0; a < 3; ++a) {
            out.axis[static_cast<std::size_t>(a)] =
                static_cast<std::int8_t>(std::lround(axis[a] * 127.0f));
        }
        out.material = lobe.material;
        if (lobe.material < info_.materials.size()) {
            if (info_.materials[lobe.material].kind == MaterialKind::Fiber) out.flags |= 8;
        }
        out.color = mean_color(block, v, l);
        return out;
    }

private:
    /// Of all lobes, by weight: a fiber over a surface shows both.
    [[nodiscard]] std::array<std::uint8_t, 3>
    mean_color(const VoxelBlock& block, std::size_t v, std::size_t first) const {
        Vec3f sum;
        float weight = 0.0f;
        for (std::size_t l = first; l < first + block.lobe_count[v]; ++l) {
            Vec3f albedo{0.8f, 0.8f, 0.8f};
            const Lobe& lobe = block.lobes[l];
            if (lobe.material < info_.materials.size()) {
                albedo = info_.materials[lobe.material].albedo;
            }
            if (info_.fields.albedo) {
                const auto& map = block.maps[l].albedo;
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

    const VoxelGridInfo& info_;
    bool tangents_;
    std::vector<std::uint8_t> depths_;
};

std::vector<Voxel> pack_block(const Packer& packer, const VoxelBlock& block) {
    std::vector<Voxel> voxels;
    voxels.reserve(block.coverage.size());
    for (const VoxelLeaf& leaf : block.leaves) { // in the leaves' order: first_voxel may have gaps
        std::size_t l = leaf.first_lobe;
        const std::size_t end = leaf.first_voxel + leaf.voxel_count();
        for (std::size_t v = leaf.first_voxel; v < end; ++v) {
            voxels.push_back(packer.pack(block, v, l));
            l += block.lobe_count[v];
        }
    }
    return voxels;
}

} // namespace

Scene::Scene(const VoxelSource& source, bool tangents, Progress& progress)
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
    place_leaves(blocks);
}

void Scene::place_leaves(const std::vector<std::vector<VoxelLeaf>>& blocks) {
    constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
    lo_ = {kMax, kMax, kMax};
    hi_ = {-kMax, -kMax, -kMax};
    std::vector<Vec3i> at; // of each leaf, in leaves
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        std::uint32_t first = 0;
        for (const VoxelLeaf& from : blocks[b]) {
            Leaf& leaf = leaves_.emplace_back();
            leaf.active = from.active;
            leaf.first = first;
            leaf.block = static_cast<std::uint32_t>(b);
            std::uint16_t before = 0;
            for (std::size_t x = 0; x < 8; ++x) {
                leaf.before[x] = before;
                before = static_cast<std::uint16_t>(before + std::popcount(from.active[x]));
            }
            first += before;
            at.push_back({from.origin.x >> 3, from.origin.y >> 3, from.origin.z >> 3});
            for (int a = 0; a < 3; ++a) {
                lo_[a] = std::min(lo_[a], at.back()[a]);
                hi_[a] = std::max(hi_[a], at.back()[a]);
            }
        }
    }
    if (leaves_.empty()) return;
    cell_lo_ = {lo_.x >> 4, lo_.y >> 4, lo_.z >> 4};
    cells_ = Vec3i{hi_.x >> 4, hi_.y >> 4, hi_.z >> 4} - cell_lo_ + Vec3i{1, 1, 1};
    for (int a = 0; a < 3; ++a) {
        bounds_lo_[a] = lo_[a] * 8.0 * voxel_size_[a];
        bounds_hi_[a] = (hi_[a] + 1) * 8.0 * voxel_size_[a];
    }
    cell_table_.assign(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) *
                           static_cast<std::size_t>(cells_.z),
                       -1);
    for (std::size_t i = 0; i < at.size(); ++i) {
        const Vec3i c = Vec3i{at[i].x >> 4, at[i].y >> 4, at[i].z >> 4} - cell_lo_;
        std::int32_t& cell =
            cell_table_[(static_cast<std::size_t>(c.x) * static_cast<std::size_t>(cells_.y) +
                         static_cast<std::size_t>(c.y)) *
                            static_cast<std::size_t>(cells_.z) +
                        static_cast<std::size_t>(c.z)];
        if (cell < 0) {
            cell = static_cast<std::int32_t>(leaf_table_.size() / 4096);
            leaf_table_.resize(leaf_table_.size() + 4096, 0);
        }
        leaf_table_[static_cast<std::size_t>(cell) * 4096 +
                    static_cast<std::size_t>(((at[i].x & 15) << 8) | ((at[i].y & 15) << 4) |
                                             (at[i].z & 15))] = static_cast<std::uint32_t>(i) + 1;
    }
}

} // namespace heddle::preview
