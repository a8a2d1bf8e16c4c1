#include <heddle/flake/flake_field.h>

#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/index_box.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <cmath>

namespace heddle {
namespace {

constexpr std::int32_t kHalo = 2; ///< voxels by which S is extended into empty space

/// Returns the second moment of the normals of a lobe.
SymmetricMatrix normal_moment(const SggxMatrix& S, MaterialKind kind) {
    const SymmetricMatrix M = second_moment_of(S);
    return kind == MaterialKind::Surface ? M : moment_of_normals(M);
}

void add(SymmetricMatrix& sum, const SymmetricMatrix& M, float weight) {
    sum.xx += weight * M.xx;
    sum.yy += weight * M.yy;
    sum.zz += weight * M.zz;
    sum.xy += weight * M.xy;
    sum.xz += weight * M.xz;
    sum.yz += weight * M.yz;
}

/// Scales S to a largest eigenvalue of 1 and raises smaller ones to at least kMinFlake.
SggxMatrix scale_flake(const SggxMatrix& S) {
    SymmetricEigen e = decompose(S);
    const double largest = e.value[0];
    for (double& v : e.value) {
        v = std::clamp(v / largest, static_cast<double>(kMinFlake), 1.0);
    }
    return compose(e);
}

/// Returns the mean over the axes of a voxel's optical depth per scene unit, with coverage clamped
/// as for `density`.
float mean_extinction(const Coverage& c, const Lattice& lattice) {
    const double columns = static_cast<double>(lattice.subvoxels) * lattice.subvoxels;
    const double cap = 1.0 - 0.5 / columns;
    const auto along = [&](std::uint16_t covered, double h) {
        return -std::log1p(-std::min(covered / 65535.0, cap)) / h;
    };
    const Vec3d h = lattice.voxel_size;
    return static_cast<float>((along(c.x, h.x) + along(c.y, h.y) + along(c.z, h.z)) / 3.0);
}

Vec3f color_of(const std::array<std::uint8_t, 3>& c) {
    return Vec3f{static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])} *
           (1.0f / 255.0f);
}

constexpr SggxMatrix kIsotropic{1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f};

} // namespace

PackedFlake pack_flake(const SggxMatrix& S) {
    const auto round = [](float x) {
        return static_cast<std::int16_t>(
            std::lrintf(std::clamp(x, -1.0f, 1.0f) * (1.0f / kFlakeUnit)));
    };
    return {round(S.xx), round(S.yy), round(S.zz), round(S.xy), round(S.xz), round(S.yz)};
}

/// A box of voxels with a border, while S is extended into its empty space.
struct FlakeField::Draft {
    Vec3i low, size; ///< with the border
    std::vector<float> sigma_t;
    std::vector<SggxMatrix> S;
    std::vector<Vec3f> albedo;
    std::vector<std::uint8_t> known; ///< 0: unknown; else the first pass that may use it

    Draft(Vec3i box_low, Vec3i box_size, Vec3f one_albedo)
        : low(box_low - Vec3i{kHalo, kHalo, kHalo}),
          size(box_size + Vec3i{2 * kHalo, 2 * kHalo, 2 * kHalo}) {
        const std::size_t n = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                              static_cast<std::size_t>(size.z);
        sigma_t.assign(n, 0.0f);
        S.assign(n, kIsotropic);
        albedo.assign(n, one_albedo);
        known.assign(n, 0);
    }
    [[nodiscard]] bool holds(Vec3i p) const {
        return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < size.x && p.y < size.y && p.z < size.z;
    }
    [[nodiscard]] std::size_t number_of(Vec3i p) const {
        return (static_cast<std::size_t>(p.z) * static_cast<std::size_t>(size.y) +
                static_cast<std::size_t>(p.y)) *
                   static_cast<std::size_t>(size.x) +
               static_cast<std::size_t>(p.x);
    }
    void grow(std::uint8_t pass);
    void grow_one(Vec3i p, std::uint8_t pass);
};

/// Sets one voxel to the mean of the neighbours that were known before this pass.
void FlakeField::Draft::grow_one(Vec3i p, std::uint8_t pass) {
    SggxMatrix sum{};
    Vec3f color{};
    int count = 0;
    for (int a = 0; a < 3; ++a) {
        for (const int step : {-1, 1}) {
            Vec3i q = p;
            q[a] += step;
            if (!holds(q)) continue;
            const std::size_t j = number_of(q);
            if (known[j] == 0 || known[j] > pass) continue;
            add(sum, S[j], 1.0f);
            color = color + albedo[j];
            ++count;
        }
    }
    if (count == 0) return;
    const std::size_t i = number_of(p);
    const float share = 1.0f / static_cast<float>(count);
    S[i] = {};
    add(S[i], sum, share);
    albedo[i] = color * share;
    known[i] = static_cast<std::uint8_t>(pass + 1);
}

void FlakeField::Draft::grow(std::uint8_t pass) {
    for (std::int32_t z = 0; z < size.z; ++z) {
        for (std::int32_t y = 0; y < size.y; ++y) {
            for (std::int32_t x = 0; x < size.x; ++x) {
                if (known[number_of({x, y, z})] == 0) grow_one({x, y, z}, pass);
            }
        }
    }
}

FlakeField::FlakeField(const VoxelLevel& source, std::span<const Vec3f> albedo)
    : voxel_size_(source.info().lattice.voxel_size) {
    const auto voxels = static_cast<std::size_t>(source.info().voxel_count);
    sigma_t_.reserve(voxels);
    S_.reserve(voxels);
    if (!albedo.empty()) one_albedo_ = albedo.front();
    if (albedo.size() > 1 || source.info().fields.albedo) albedo_.reserve(voxels);
    IndexBox box;
    VoxelBlock scratch;
    for (std::size_t b = 0; b < source.block_count(); ++b) {
        const VoxelBlock& block = source.block(b, scratch);
        for (const VoxelLeaf& leaf : block.leaves) {
            box.grow(box_of(leaf));
            table_.add(leaf.origin);
            leaves_.push_back({leaf.active, sigma_t_.size()});
            origins_.push_back(leaf.origin);
            for_each_voxel(block, leaf, [&](const BlockVoxel& voxel) {
                add_voxel(source.info(), voxel, albedo);
            });
        }
    }
    if (!box.empty()) {
        lo_ = box.lo;
        hi_ = box.hi + Vec3i{1, 1, 1};
    }
    drop_equal_albedo();
}

void FlakeField::add_voxel(const VoxelLevelInfo& info,
                           const BlockVoxel& voxel,
                           std::span<const Vec3f> albedo) {
    const bool colors = albedo_.capacity() > 0;
    SymmetricMatrix M{};
    Vec3f color{};
    float weight = 0.0f;
    for (std::size_t i = 0; i < voxel.lobe_count(); ++i) {
        const Lobe& l = voxel.lobes()[i];
        const auto w = static_cast<float>(l.weight);
        add(M, normal_moment(unpack(l.sggx), info.materials[l.material].kind), w);
        weight += w;
        if (!colors) continue;
        Vec3f c = albedo[l.material];
        if (!voxel.maps().empty()) c = c * color_of(voxel.maps()[i].albedo);
        color = color + c * w;
    }
    const SggxMatrix S = scale_flake(fit_sggx(M));
    const float seen = (std::sqrt(S.xx) + std::sqrt(S.yy) + std::sqrt(S.zz)) / 3.0f;
    sigma_t_.push_back(mean_extinction(voxel.coverage(), info.lattice) / seen);
    S_.push_back(pack_flake(S));
    if (!colors) return;
    const auto byte = [&](float x) {
        return static_cast<std::uint8_t>(std::lrintf(255.0f * x / weight));
    };
    albedo_.push_back({byte(color.x), byte(color.y), byte(color.z)});
}

void FlakeField::drop_equal_albedo() {
    if (albedo_.empty()) return;
    const bool equal = std::all_of(albedo_.begin(), albedo_.end(),
                                   [&](const auto& c) { return c == albedo_.front(); });
    if (!equal) return;
    one_albedo_ = color_of(albedo_.front());
    albedo_ = {};
}

/// Calls visit(number, index) for each voxel of a box.
template <typename Visit>
void FlakeField::for_each_in_box(Vec3i low, Vec3i size, const Visit& visit) const {
    const Vec3i end = low + size;
    const auto inside = [&](Vec3i p) {
        return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x < end.x && p.y < end.y &&
               p.z < end.z;
    };
    const auto visit_leaf = [&](const FlakeLeaf& leaf, Vec3i origin) {
        std::size_t v = leaf.first;
        for_each_active(leaf.active, [&](std::size_t x, int bit) {
            const Vec3i p = voxel_index(origin, x, bit);
            if (inside(p)) visit(v, p);
            ++v;
        });
    };
    for (std::int32_t x = low.x & ~7; x < end.x; x += 8) {
        for (std::int32_t y = low.y & ~7; y < end.y; y += 8) {
            for (std::int32_t z = low.z & ~7; z < end.z; z += 8) {
                const std::uint32_t leaf = table_.find({x, y, z}).leaf;
                if (leaf != LeafTable<3>::kNone) visit_leaf(leaves_[leaf], {x, y, z});
            }
        }
    }
}

bool FlakeField::any(Vec3i low, Vec3i size) const {
    bool found = false;
    for_each_in_box(low, size, [&](std::size_t v, Vec3i) { found = found || sigma_t_[v] > 0.0f; });
    return found;
}

void FlakeField::fill(Vec3i low, Vec3i size, FlakeBlock& out) const {
    Draft draft(low, size, one_albedo_);
    bool any = false;
    for_each_in_box(draft.low, draft.size, [&](std::size_t v, Vec3i p) {
        const std::size_t i = draft.number_of(p - draft.low);
        draft.sigma_t[i] = sigma_t_[v];
        draft.S[i] = unpack_flake(S_[v]);
        draft.known[i] = 1;
        if (!albedo_.empty()) draft.albedo[i] = color_of(albedo_[v]);
        any = true;
    });
    if (any) {
        for (std::uint8_t pass = 1; pass <= kHalo; ++pass) draft.grow(pass);
    }
    out.sigma_t.clear();
    out.S.clear();
    out.albedo.clear();
    for (std::int32_t z = 0; z < size.z; ++z) {
        for (std::int32_t y = 0; y < size.y; ++y) {
            for (std::int32_t x = 0; x < size.x; ++x) {
                const std::size_t i = draft.number_of({x + kHalo, y + kHalo, z + kHalo});
                out.sigma_t.push_back(draft.sigma_t[i]);
                out.S.push_back(pack_flake(draft.S[i]));
                if (albedo_varies()) out.albedo.push_back(draft.albedo[i]);
            }
        }
    }
}

} // namespace heddle
