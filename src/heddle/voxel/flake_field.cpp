#include <heddle/voxel/flake_field.h>

#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace heddle {
namespace {

constexpr std::int32_t kHalo = 2; ///< voxels by which S grows into emptiness

/// Second moment of the normals of a lobe.
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

/// Largest eigenvalue 1, no smaller one than kLeastFlake.
SggxMatrix scale_flake(const SggxMatrix& S) {
    SymmetricEigen e = decompose(S);
    const double largest = e.value[0];
    for (double& v : e.value) {
        v = std::clamp(v / largest, static_cast<double>(kLeastFlake), 1.0);
    }
    return compose(e);
}

/// Mean over the axes of a voxel's optical depth per scene unit; coverage is capped as `density` is.
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

/// A box of voxels with a border, while S grows into its emptiness.
struct FlakeField::Draft {
    Vec3i low, size; ///< with the border
    std::vector<float> sigma_t;
    std::vector<SggxMatrix> S;
    std::vector<Vec3f> albedo;
    std::vector<std::uint8_t> known; ///< 0, or the pass before which it was known

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
    [[nodiscard]] std::size_t place(Vec3i p) const {
        return (static_cast<std::size_t>(p.z) * static_cast<std::size_t>(size.y) +
                static_cast<std::size_t>(p.y)) *
                   static_cast<std::size_t>(size.x) +
               static_cast<std::size_t>(p.x);
    }
    void grow(std::uint8_t pass);
    void grow_one(Vec3i p, std::uint8_t pass);
};

/// One voxel takes the mean of those neighbours that were known before this pass.
void FlakeField::Draft::grow_one(Vec3i p, std::uint8_t pass) {
    SggxMatrix sum{};
    Vec3f color{};
    int count = 0;
    for (int a = 0; a < 3; ++a) {
        for (const int step : {-1, 1}) {
            Vec3i q = p;
            q[a] += step;
            if (!holds(q)) continue;
            const std::size_t j = place(q);
            if (known[j] == 0 || known[j] > pass) continue;
            add(sum, S[j], 1.0f);
            color = color + albedo[j];
            ++count;
        }
    }
    if (count == 0) return;
    const std::size_t i = place(p);
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
                if (known[place({x, y, z})] == 0) grow_one({x, y, z}, pass);
            }
        }
    }
}

std::uint64_t FlakeField::key_of(Vec3i origin) {
    const auto part = [](std::int32_t v) {
        return static_cast<std::uint64_t>((v >> 3) + (1 << 20)) & 0x1fffffu;
    };
    return part(origin.x) << 42 | part(origin.y) << 21 | part(origin.z);
}

FlakeField::FlakeField(const VoxelSource& source, std::span<const Vec3f> albedo)
    : voxel_size_(source.info().lattice.voxel_size) {
    const auto voxels = static_cast<std::size_t>(source.info().voxel_count);
    sigma_t_.reserve(voxels);
    S_.reserve(voxels);
    if (!albedo.empty()) one_albedo_ = albedo.front();
    if (albedo.size() > 1 || source.info().fields.albedo) albedo_.reserve(voxels);
    constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
    lo_ = {kMost, kMost, kMost};
    hi_ = {-kMost, -kMost, -kMost};
    VoxelBlock scratch;
    for (std::size_t b = 0; b < source.block_count(); ++b) {
        add_block(source.info(), source.block(b, scratch), albedo);
    }
    if (leaves_.empty()) lo_ = hi_ = {};
    place_.reserve(leaves_.size());
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        place_.emplace(key_of(origins_[i]), static_cast<std::uint32_t>(i));
    }
    drop_equal_albedo();
}

void FlakeField::add_block(const VoxelGridInfo& info,
                           const VoxelBlock& block,
                           std::span<const Vec3f> albedo) {
    const bool colors = albedo_.capacity() > 0;
    for (const VoxelLeaf& leaf : block.leaves) {
        leaves_.push_back({leaf.active, sigma_t_.size()});
        origins_.push_back(leaf.origin);
        grow_bounds(leaf);
        std::size_t lobe = leaf.first_lobe;
        for (std::size_t v = leaf.first_voxel; v < leaf.first_voxel + leaf.voxel_count(); ++v) {
            SymmetricMatrix M{};
            Vec3f color{};
            float weight = 0.0f;
            for (std::size_t end = lobe + block.lobe_count[v]; lobe < end; ++lobe) {
                const Lobe& l = block.lobes[lobe];
                const auto w = static_cast<float>(l.weight);
                add(M, normal_moment(unpack(l.sggx), info.materials[l.material].kind), w);
                weight += w;
                if (!colors) continue;
                Vec3f c = albedo[l.material];
                if (!block.maps.empty()) c = c * color_of(block.maps[lobe].albedo);
                color = color + c * w;
            }
            const SggxMatrix S = scale_flake(fit_sggx(M));
            const float seen = (std::sqrt(S.xx) + std::sqrt(S.yy) + std::sqrt(S.zz)) / 3.0f;
            sigma_t_.push_back(mean_extinction(block.coverage[v], info.lattice) / seen);
            S_.push_back(pack_flake(S));
            if (!colors) continue;
            const auto byte = [&](float x) {
                return static_cast<std::uint8_t>(std::lrintf(255.0f * x / weight));
            };
            albedo_.push_back({byte(color.x), byte(color.y), byte(color.z)});
        }
    }
}

void FlakeField::grow_bounds(const VoxelLeaf& leaf) {
    for (std::int32_t x = 0; x < 8; ++x) {
        for (std::uint64_t word = leaf.active[static_cast<std::size_t>(x)]; word != 0;) {
            const int bit = std::countr_zero(word);
            word &= word - 1;
            const Vec3i p = leaf.origin + Vec3i{x, bit >> 3, bit & 7};
            for (int a = 0; a < 3; ++a) {
                lo_[a] = std::min(lo_[a], p[a]);
                hi_[a] = std::max(hi_[a], p[a] + 1);
            }
        }
    }
}

void FlakeField::drop_equal_albedo() {
    if (albedo_.empty()) return;
    const bool equal = std::all_of(albedo_.begin(), albedo_.end(),
                                   [&](const auto& c) { return c == albedo_.front(); });
    if (!equal) return;
    one_albedo_ = color_of(albedo_.front());
    albedo_ = {};
}

/// Calls visit(number, index) for the voxels of a box.
template <typename Visit>
void FlakeField::for_each_voxel(Vec3i low, Vec3i size, const Visit& visit) const {
    const Vec3i end = low + size;
    const auto inside = [&](Vec3i p) {
        return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x < end.x && p.y < end.y &&
               p.z < end.z;
    };
    const auto visit_leaf = [&](const Leaf& leaf, Vec3i origin) {
        std::size_t v = leaf.first;
        for (std::int32_t x = 0; x < 8; ++x) {
            for (std::uint64_t word = leaf.active[static_cast<std::size_t>(x)]; word != 0; ++v) {
                const int bit = std::countr_zero(word);
                word &= word - 1;
                const Vec3i p = origin + Vec3i{x, bit >> 3, bit & 7};
                if (inside(p)) visit(v, p);
            }
        }
    };
    for (std::int32_t x = low.x & ~7; x < end.x; x += 8) {
        for (std::int32_t y = low.y & ~7; y < end.y; y += 8) {
            for (std::int32_t z = low.z & ~7; z < end.z; z += 8) {
                const auto at = place_.find(key_of({x, y, z}));
                if (at != place_.end()) visit_leaf(leaves_[at->second], {x, y, z});
            }
        }
    }
}

bool FlakeField::any(Vec3i low, Vec3i size) const {
    bool found = false;
    for_each_voxel(low, size, [&](std::size_t v, Vec3i) { found = found || sigma_t_[v] > 0.0f; });
    return found;
}

void FlakeField::fill(Vec3i low, Vec3i size, FlakeBlock& out) const {
    Draft draft(low, size, one_albedo_);
    bool any = false;
    for_each_voxel(draft.low, draft.size, [&](std::size_t v, Vec3i p) {
        const std::size_t i = draft.place(p - draft.low);
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
                const std::size_t i = draft.place({x + kHalo, y + kHalo, z + kHalo});
                out.sigma_t.push_back(draft.sigma_t[i]);
                out.S.push_back(pack_flake(draft.S[i]));
                if (albedo_varies()) out.albedo.push_back(draft.albedo[i]);
            }
        }
    }
}

} // namespace heddle
