#include <heddle/render/flake_grid.h>

#include <heddle/base/parallel.h>
#include <heddle/render/volume/clip.h>

#include <algorithm>
#include <cmath>

namespace heddle {
namespace {

/// Returns an upper bound of the largest eigenvalue of a stored S, rounded: needed by majorants.
constexpr float kLargestFlake = 1.0001f;

template <typename T>
std::int64_t bytes_of(const std::vector<T>& v) {
    return static_cast<std::int64_t>(v.capacity() * sizeof(T));
}

/// Returns the corners of all leaves whose cells may have extinction. A voxel contributes to the
/// cells on both sides.
std::vector<Vec3i> leaf_corners(const std::vector<Vec3i>& origins) {
    std::vector<Vec3i> out;
    out.reserve(8 * origins.size());
    for (const Vec3i o : origins) {
        for (int c = 0; c < 8; ++c) {
            out.push_back(o - Vec3i{(c & 1) * 8, (c >> 1 & 1) * 8, (c >> 2 & 1) * 8});
        }
    }
    const auto before = [](Vec3i a, Vec3i b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::sort(out.begin(), out.end(), before);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

} // namespace

FlakeGrid::FlakeGrid(const FlakeField& field)
    : voxel_size_(field.voxel_size()),
      lo_(field.lo() - Vec3i{1, 1, 1}),
      hi_(field.hi()),
      one_albedo_(field.albedo()) {
    if (field.origins().empty()) return;
    add_leaves(field, leaf_corners(field.origins()));
}

/// Visits the candidates twice: finds those with extinction, then stores their flakes in arrays of
/// that size.
void FlakeGrid::add_leaves(const FlakeField& field, const std::vector<Vec3i>& corners) {
    std::vector<std::uint8_t> dense(corners.size(), 0);
    parallel_chunks(corners.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            dense[i] = field.any(corners[i], {kSide, kSide, kSide}) ? 1 : 0;
        }
    });
    std::vector<Vec3i> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (dense[i] == 0) continue;
        table_.add(corners[i]);
        kept.push_back(corners[i]);
    }
    majorant_.resize(kept.size());
    sigma_t_.resize(kept.size() * kFlakes);
    S_.resize(kept.size() * kFlakes);
    if (field.albedo_varies()) albedo_.resize(kept.size() * kFlakes);
    parallel_chunks(kept.size(), 16, [&](std::size_t begin, std::size_t end) {
        FlakeBlock block;
        for (std::size_t i = begin; i < end; ++i) {
            field.fill(kept[i], {kSide, kSide, kSide}, block);
            store(i, block);
        }
    });
}

void FlakeGrid::store(std::size_t leaf, const FlakeBlock& block) {
    const float most = *std::max_element(block.sigma_t.begin(), block.sigma_t.end());
    majorant_[leaf] = most * kLargestFlake;
    const float scale = most > 0.0f ? 65535.0f / most : 0.0f;
    const std::size_t first = leaf * kFlakes;
    for (std::size_t i = 0; i < kFlakes; ++i) {
        sigma_t_[first + i] = static_cast<std::uint16_t>(std::lrintf(block.sigma_t[i] * scale));
        S_[first + i] = block.S[i];
        if (albedo_.empty()) continue;
        for (int a = 0; a < 3; ++a) {
            albedo_[first + i][static_cast<std::size_t>(a)] =
                static_cast<std::uint8_t>(std::lrintf(255.0f * block.albedo[i][a]));
        }
    }
}

std::int64_t FlakeGrid::byte_count() const {
    return table_.byte_count() + bytes_of(majorant_) + bytes_of(sigma_t_) + bytes_of(S_) +
           bytes_of(albedo_);
}

namespace {

/// Offsets from a cell's first flake to its corners: bit 0 is x, bit 1 is y, bit 2 is z.
constexpr std::array<std::size_t, 8> kCorner{0, 1, 9, 10, 81, 82, 90, 91};

} // namespace

// By reference: where g++ 12 passes the three floats in two registers, it may store two of them and
// load them as one, which waits for the stores. Rays through flakes took 1.2 times as long.
FlakeGrid::TrilinearLookup FlakeGrid::look_up(std::uint32_t leaf, const Vec3f& at) {
    Vec3f f;
    std::array<std::int32_t, 3> cell;
    for (int a = 0; a < 3; ++a) {
        const float p = std::min(std::max(at[a], 0.0f), 8.0f);
        const std::int32_t c = std::min(static_cast<std::int32_t>(p), 7);
        cell[static_cast<std::size_t>(a)] = c;
        f[a] = p - static_cast<float>(c);
    }
    const float y0 = 1.0f - f.y;
    const float z0 = 1.0f - f.z;
    const float a = y0 * z0;
    const float b = f.y * z0;
    const float c = y0 * f.z;
    const float d = f.y * f.z;
    return {
        leaf * kFlakes + static_cast<std::size_t>((cell[2] * kSide + cell[1]) * kSide + cell[0]),
        {a - a * f.x, a * f.x, b - b * f.x, b * f.x, c - c * f.x, c * f.x, d - d * f.x, d * f.x}};
}

float FlakeGrid::sigma_t(std::uint32_t leaf, const TrilinearLookup& at) const {
    const std::uint16_t* s = sigma_t_.data() + at.first;
    float sum = 0.0f;
    for (std::size_t c = 0; c < 8; ++c) sum += at.weight[c] * static_cast<float>(s[kCorner[c]]);
    return sum * (majorant_[leaf] * (1.0f / (65535.0f * kLargestFlake)));
}

SggxMatrix FlakeGrid::S(const TrilinearLookup& at) const {
    std::array<float, 6> sum{};
    for (std::size_t c = 0; c < 8; ++c) {
        const PackedFlake& p = S_[at.first + kCorner[c]];
        for (std::size_t i = 0; i < 6; ++i) sum[i] += at.weight[c] * static_cast<float>(p[i]);
    }
    for (float& v : sum) v *= kFlakeUnit;
    return {sum[0], sum[1], sum[2], sum[3], sum[4], sum[5]};
}

Vec3f FlakeGrid::albedo(const TrilinearLookup& at) const {
    if (albedo_.empty()) return one_albedo_;
    Vec3f sum{};
    for (std::size_t c = 0; c < 8; ++c) {
        const auto& p = albedo_[at.first + kCorner[c]];
        sum = sum +
              Vec3f{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])} *
                  at.weight[c];
    }
    return sum * (1.0f / 255.0f);
}

/// A ray in units of cells and in the object's axes.
struct FlakeMedium::GridRay {
    VoxelRay cells;
    Vec3f w;      ///< direction in object space, not of unit length
    float length; ///< of w: object units per scene unit
    float t0, t1; ///< the part in the grid's box
};

FlakeMedium::FlakeMedium(std::shared_ptr<const FlakeGrid> grid,
                         const Affine& to_world,
                         std::uint32_t material)
    : grid_(std::move(grid)), to_object_(inverse(to_world)), material_(material) {
    const Affine identity;
    moved_ = !(to_world.x == identity.x && to_world.y == identity.y && to_world.z == identity.z);
    const Vec3d h = grid_->voxel_size();
    per_voxel_ = {1.0 / h.x, 1.0 / h.y, 1.0 / h.z};
    for (int c = 0; c < 8; ++c) {
        Vec3d p;
        for (int a = 0; a < 3; ++a) {
            p[a] = h[a] * (0.5 + ((c >> a & 1) != 0 ? grid_->hi()[a] : grid_->lo()[a]));
        }
        bounds_.grow(to_world.point(p));
    }
}

FlakeMedium::GridRay FlakeMedium::enter(const Ray& ray) const {
    const Vec3d direction =
        moved_ ? to_object_.direction(to_double(ray.direction)) : to_double(ray.direction);
    GridRay out;
    out.cells.origin =
        (moved_ ? to_object_.point(ray.origin) : ray.origin + to_object_.offset) * per_voxel_ -
        Vec3d{0.5, 0.5, 0.5};
    out.cells.direction = direction * per_voxel_;
    out.w = to_float(direction);
    out.length = moved_ ? length(out.w) : 1.0f;
    const Vec3i lo = grid_->lo();
    const Vec3i hi = grid_->hi();
    const Bounds box{
        {static_cast<double>(lo.x), static_cast<double>(lo.y), static_cast<double>(lo.z)},
        {static_cast<double>(hi.x), static_cast<double>(hi.y), static_cast<double>(hi.z)}};
    const RayRange range = clip(out.cells.origin, out.cells.direction, 0.0f, ray.t_max, box);
    out.t0 = range.t0;
    out.t1 = range.t1;
    return out;
}

/// Calls visit(leaf, ray from the leaf's corner, t_in, t_out) -> bool for the leaves that a ray
/// crosses, in order, until it returns false. t is relative to ray.t0.
template <typename Visit>
void FlakeMedium::walk(const GridRay& ray, const Visit& visit) const {
    if (!(ray.t0 < ray.t1)) return;
    const detail::LocalRay local = detail::localize(ray.cells, ray.t0);
    const float end = ray.t1 - ray.t0;
    Vec3i at{};
    float t = 0.0f;
    while (t < end) {
        const Vec3i cell = local.base + at;
        const LeafTable<3>::LeafLookup found = grid_->find_leaf(cell);
        const std::int32_t mask = ~(found.size - 1);
        const Vec3i low = Vec3i{cell.x & mask, cell.y & mask, cell.z & mask} - local.base;
        const detail::Exit exit = detail::find_exit(local, low, found.size);
        const float out = exit.t > t ? exit.t : t;
        if (found.leaf != FlakeGrid::kNone) {
            const Vec3f corner{static_cast<float>(low.x), static_cast<float>(low.y),
                               static_cast<float>(low.z)};
            const Vec3f from = local.from - corner;
            if (!visit(found.leaf, from, local.direction, t, std::min(out, end))) return;
        }
        at = detail::step_over(local, low, found.size, exit);
        t = out;
    }
}

/// Calls collide(where, density, t) -> bool at tentative collisions, whose distances follow the
/// leaves' majorants, until it returns false. density: sigma_t / majorant. t is relative to ray.t0.
template <typename Collide>
void FlakeMedium::track(const GridRay& ray, StreamRandom& random, const Collide& collide) const {
    float left = -std::log(1.0f - random.uniform());
    walk(ray, [&](std::uint32_t leaf, Vec3f from, Vec3f direction, float t, float out) {
        const float majorant = grid_->majorant(leaf) * ray.length;
        const float step = 1.0f / majorant;
        for (;;) {
            const float next = t + left * step;
            if (!(next < out)) {
                left -= (out - t) * majorant;
                return true;
            }
            t = next;
            left = -std::log(1.0f - random.uniform());
            const FlakeGrid::TrilinearLookup at = FlakeGrid::look_up(leaf, from + direction * t);
            if (!collide(at, grid_->sigma_t(leaf, at) * step, t)) return false;
        }
    });
}

bool FlakeMedium::sample_flight(const Ray& ray, StreamRandom& random, FlakeHit& hit) const {
    const GridRay r = enter(ray);
    bool stopped = false;
    track(r, random, [&](const FlakeGrid::TrilinearLookup& at, float density, float t) {
        const float wanted = random.uniform();
        if (!(wanted < density * r.length * kLargestFlake)) return true;
        const SggxMatrix S = grid_->S(at);
        if (!(wanted < density * projected_area(S, r.w))) return true;
        hit = {r.t0 + t, S, grid_->albedo(at)};
        stopped = true;
        return false;
    });
    return stopped;
}

float FlakeMedium::transmittance(const Ray& ray, StreamRandom& random) const {
    constexpr float kLittle = 0.25f; // below it, Russian roulette
    const GridRay r = enter(ray);
    float passes = 1.0f;
    track(r, random, [&](const FlakeGrid::TrilinearLookup& at, float density, float) {
        if (!(density > 0.0f)) return true;
        passes *= std::max(0.0f, 1.0f - density * projected_area(grid_->S(at), r.w));
        if (passes >= kLittle) return true;
        if (random.uniform() * kLittle >= passes) {
            passes = 0.0f;
            return false;
        }
        passes = kLittle;
        return true;
    });
    return passes;
}

Scatterer FlakeMedium::scatterer(const FlakeHit& hit, Vec3f wi) const {
    Scatterer out;
    out.material.model = ScatterModel::MicroflakeSpecular;
    out.material.albedo = hit.albedo;
    out.axis = wi; // flakes have no axis of their own
    out.tangent = any_perpendicular(wi);
    out.lobe = hit.S;
    if (moved_) { // A^T S A with the linear part A of to_object_, as in the extinction
        const Vec3f a[3]{to_float(to_object_.x), to_float(to_object_.y), to_float(to_object_.z)};
        const auto entry = [&](int i, int j) { return dot(a[i], multiply(hit.S, a[j])); };
        out.lobe = {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
    }
    return out;
}

} // namespace heddle
