#include <heddle/voxel/bin.h>

#include <heddle/base/parallel.h>
#include <heddle/base/trig.h>
#include <heddle/voxel/surface_sample.h>
#include <heddle/voxel/triangle_scan.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace heddle {
namespace {

constexpr std::size_t kGrain = 1024;

/// Box of block indices, inclusive.
struct BlockBox {
    Vec3i lo, hi;
};

/// Blocks of the range that the box touches. A box outside the range comes back empty.
BlockBox blocks_of(const Bounds& box, const BlockRange& range, const Vec3d& voxel_size) {
    BlockBox out;
    for (int a = 0; a < 3; ++a) {
        const double edge = voxel_size[a] * kBlockVoxels;
        const double first = range.lo[a];
        const double last = first + range.size[a] - 1;
        // clamped in floating point: a box far outside must not overflow the conversion
        out.lo[a] =
            static_cast<std::int32_t>(std::clamp(std::floor(box.lo[a] / edge), first, last + 1));
        out.hi[a] =
            static_cast<std::int32_t>(std::clamp(std::floor(box.hi[a] / edge), first - 1, last));
    }
    return out;
}

/// True when the plane through the triangle, thickened by `margin`, meets the block's box.
bool plane_meets(const Vec3d (&p)[3], Vec3d normal, double margin, Vec3d center, Vec3d half) {
    const double distance = dot(normal, center - p[0]);
    const double reach = std::abs(normal.x) * half.x + std::abs(normal.y) * half.y +
                         std::abs(normal.z) * half.z + margin * length(normal);
    return std::abs(distance) <= reach * (1.0 + 1e-9);
}

} // namespace

BlockRange::BlockRange(Vec3i begin, Vec3i end) : voxel_lo(begin), voxel_hi(end) {
    for (int a = 0; a < 3; ++a) {
        lo[a] = floor_div(begin[a], kBlockVoxels);
        size[a] = floor_div(end[a] - 1, kBlockVoxels) - lo[a] + 1;
    }
}

Vec3i BlockRange::index(std::uint64_t block) const {
    const auto ny = static_cast<std::uint64_t>(size.y);
    const auto nz = static_cast<std::uint64_t>(size.z);
    return lo + Vec3i{static_cast<std::int32_t>(block / (ny * nz)),
                      static_cast<std::int32_t>(block / nz % ny),
                      static_cast<std::int32_t>(block % nz)};
}

void BlockRange::voxels(std::uint64_t block, Vec3i& begin, Vec3i& end) const {
    const Vec3i at = index(block);
    for (int a = 0; a < 3; ++a) {
        begin[a] = std::max(voxel_lo[a], at[a] * kBlockVoxels);
        end[a] = std::min(voxel_hi[a], (at[a] + 1) * kBlockVoxels);
    }
}

TriangleSource::TriangleSource(const Geometry& geometry) : geometry_(geometry), first_(1, 0) {
    for (const Mesh& mesh : geometry.meshes) {
        first_.push_back(first_.back() + mesh.triangles.size());
        const Material& m = geometry.materials[mesh.material];
        const auto map = static_cast<std::size_t>(m.height_map);
        const bool moves = m.height_map >= 0 && map < geometry.textures.size() && !mesh.uvs.empty();
        // heights are computed in float: a rounding more than the largest of them
        displacement_.push_back(moves ? max_displacement(m, geometry.textures[map]) * (1.0 + 1e-6)
                                      : 0.0);
    }
}

TriangleSource::Place TriangleSource::place(std::uint64_t triangle) const {
    const auto mesh = std::upper_bound(first_.begin() + 1, first_.end(), triangle) - 1;
    return {static_cast<std::uint32_t>(mesh - first_.begin()),
            static_cast<std::uint32_t>(triangle - *mesh)};
}

template <typename Visit>
void Bins::visit_pairs(const Progress& progress, const Visit& visit) const {
    const Vec3d& voxel = fibers_.units().voxel_size;
    const auto block_number = [&](int x, int y, int z) {
        return (static_cast<std::uint64_t>(x - range_.lo.x) *
                    static_cast<std::uint64_t>(range_.size.y) +
                static_cast<std::uint64_t>(y - range_.lo.y)) *
                   static_cast<std::uint64_t>(range_.size.z) +
               static_cast<std::uint64_t>(z - range_.lo.z);
    };
    const auto visit_box = [&](const BlockBox& box, Primitive id, const auto& accept) {
        for (int x = box.lo.x; x <= box.hi.x; ++x) {
            for (int y = box.lo.y; y <= box.hi.y; ++y) {
                for (int z = box.lo.z; z <= box.hi.z; ++z) {
                    if (accept(x, y, z)) visit(block_number(x, y, z), id);
                }
            }
        }
    };
    parallel_chunks(fibers_.span_count(), kGrain, [&](std::size_t begin, std::size_t end) {
        progress.check();
        for (std::size_t span = begin; span < end; ++span) {
            const FiberPiece whole = fibers_.whole_span(span);
            for (std::uint32_t part = 0; part < whole.parts; ++part) {
                const FiberPiece piece = FiberSource::part_of(whole, part);
                Bounds box = piece.cubic.hull();
                const double reach = fibers_.reach(piece);
                box.lo = box.lo - Vec3d{reach, reach, reach};
                box.hi = box.hi + Vec3d{reach, reach, reach};
                visit_box(blocks_of(box, range_, voxel), span << 16 | part,
                          [](int, int, int) { return true; });
            }
        }
    });
    // the scan snaps vertices to a lattice of this pitch: a hit may lie that far outside
    const double snap =
        std::max({voxel.x, voxel.y, voxel.z}) / (fibers_.units().n * static_cast<double>(kScanOne));
    parallel_chunks(triangles_.count(), kGrain, [&](std::size_t begin, std::size_t end) {
        progress.check();
        for (std::size_t t = begin; t < end; ++t) {
            const TriangleSource::Place at = triangles_.place(t);
            const Mesh& mesh = triangles_.geometry().meshes[at.mesh];
            const double move = triangles_.displacement(at.mesh) + 2.0 * snap;
            Vec3d p[3];
            Bounds box;
            for (std::size_t i = 0; i < 3; ++i) {
                p[i] = to_double(mesh.positions[mesh.triangles[at.triangle][i]]);
                box.grow(p[i], move);
            }
            const BlockBox blocks = blocks_of(box, range_, voxel);
            const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
            const Vec3d half = 0.5 * kBlockVoxels * voxel;
            visit_box(blocks, t | kTriangleBit, [&](int x, int y, int z) {
                const Vec3d center = half + Vec3d{2.0 * x, 2.0 * y, 2.0 * z} * half;
                return plane_meets(p, normal, move, center, half);
            });
        }
    });
}

Bins::Bins(const FiberSource& fibers,
           const TriangleSource& triangles,
           const BlockRange& range,
           const Progress& progress)
    : fibers_(fibers), triangles_(triangles), range_(range), counts_(range.count(), 0) {
    visit_pairs(progress, [&](std::uint64_t block, Primitive) {
        std::atomic_ref(counts_[block]).fetch_add(1, std::memory_order_relaxed);
    });
    for (std::uint64_t b = 0; b < counts_.size(); ++b) {
        if (counts_[b] == 0) continue;
        blocks_.push_back(static_cast<std::uint32_t>(b));
        total_ += counts_[b];
    }
}

Bins::Lists Bins::fill(std::span<const std::uint32_t> chosen, const Progress& progress) const {
    Lists lists;
    lists.first.resize(chosen.size() + 1, 0);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        lists.first[i + 1] = lists.first[i] + entries(chosen[i]);
    }
    lists.primitives.resize(lists.first.back());
    std::vector<std::uint64_t> cursor(lists.first.begin(), lists.first.end() - 1);
    visit_pairs(progress, [&](std::uint64_t block, Primitive id) {
        const auto found = std::lower_bound(chosen.begin(), chosen.end(), block);
        if (found == chosen.end() || *found != block) return;
        const auto i = static_cast<std::size_t>(found - chosen.begin());
        const std::uint64_t at = std::atomic_ref(cursor[i]).fetch_add(1, std::memory_order_relaxed);
        lists.primitives[at] = id;
    });
    // filled in any order by many threads: sorted, every run sees the same lists
    parallel_chunks(chosen.size(), 64, [&](std::size_t b, std::size_t e) {
        for (std::size_t i = b; i < e; ++i) {
            std::sort(lists.primitives.begin() + static_cast<std::ptrdiff_t>(lists.first[i]),
                      lists.primitives.begin() + static_cast<std::ptrdiff_t>(lists.first[i + 1]));
        }
    });
    return lists;
}

std::int64_t Bins::byte_count() const {
    return static_cast<std::int64_t>(counts_.capacity() * sizeof(counts_[0]) +
                                     blocks_.capacity() * sizeof(blocks_[0]));
}

} // namespace heddle
