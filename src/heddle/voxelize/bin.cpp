#include <heddle/voxelize/bin.h>

#include <heddle/base/parallel.h>
#include <heddle/surface/surface_source.h>
#include <heddle/voxelize/bin_op.h>

#include <algorithm>
#include <atomic>

namespace heddle {
namespace {

constexpr std::size_t kGrain = 1024;

} // namespace

TriangleSource::TriangleSource(const Geometry& geometry) : geometry_(geometry), first_(1, 0) {
    for (const Mesh& mesh : geometry.meshes) {
        first_.push_back(first_.back() + mesh.triangles.size());
        displacement_.push_back(max_displacement(geometry, mesh));
    }
}

template <typename Visit>
void Bins::visit_pairs(const Progress& progress, const Visit& visit) const {
    const FiberView fibers = fibers_.view();
    parallel_chunks(fibers.span_count, kGrain, [&](std::size_t begin, std::size_t end) {
        progress.check();
        for (std::size_t span = begin; span < end; ++span) {
            const FiberPiece whole = fibers.whole_span(span);
            for (std::uint32_t part = 0; part < whole.parts; ++part) {
                for_each_block(fibers, part_of(whole, part), units_, range_,
                               [&](int x, int y, int z) {
                                   visit(range_.number({x, y, z}), pack_piece(span, part));
                               });
            }
        }
    });
    parallel_chunks(triangles_.count(), kGrain, [&](std::size_t begin, std::size_t end) {
        progress.check();
        for (std::size_t t = begin; t < end; ++t) {
            const TriangleId at = triangles_.place(t);
            const Mesh& mesh = triangles_.geometry().meshes[at.mesh];
            const auto [a, b, c] = mesh.triangles[at.triangle];
            const Vec3f corners[3] = {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
            for_each_block(corners, triangles_.displacement(at.mesh), units_, range_,
                           [&](int x, int y, int z) {
                               visit(range_.number({x, y, z}), pack_triangle(t));
                           });
        }
    });
}

Bins::Bins(const FiberSource& fibers,
           const TriangleSource& triangles,
           const LatticeUnits& units,
           const BlockRange& range,
           const Progress& progress)
    : fibers_(fibers),
      triangles_(triangles),
      units_(units),
      range_(range),
      counts_(range.count(), 0) {
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
    // many threads fill the lists in any order, so they are sorted to be the same in every run
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
