#include <heddle/voxelize/plan.h>

#include <heddle/base/memory.h>
#include <heddle/base/parallel.h>
#include <heddle/base/random.h>
#include <heddle/voxelize/block_worker.h>
#include <heddle/voxelize/prepare.h>
#include <heddle/voxelize/triangle/triangle_scan.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace heddle {
namespace {

constexpr double kMaxVoxels = 0x1p40;
constexpr double kMaxAxis = 0x1p30; ///< VDB has 32-bit indices; the origin may lie far away
constexpr std::int64_t kDefaultVoxels = 512;

/// Seconds of fibers = (a steps + b touched subvoxels + c voxels) / threads. Fitted to nine runs on
/// two cores of an AMD EPYC with AVX2, within 15 % (bench/results/voxelize.md).
constexpr double kSecondsPerStep = 2.28e-8;
constexpr double kSecondsPerSubvoxel = 8.4e-9;
constexpr double kSecondsPerVoxel = 3.0e-6;

/// Seconds of surfaces: per triangle in a block, per hit of a column's centre line, per sample of
/// its maps, and per voxel. Measured on seven meshes (bench/results/ogre_2048.md).
constexpr double kSecondsPerTriangle = 1.2e-6;
constexpr double kSecondsPerHit = 1.6e-8;
constexpr double kSecondsPerSample = 3.5e-7;
constexpr double kSecondsPerSurfaceVoxel = 4.0e-7;

/// Memory of the program and its libraries without any data, measured on `heddle info`.
constexpr std::int64_t kProgramBytes = 38 << 20;

[[noreturn]] void bad(const std::string& what, const std::string& fix) {
    throw Error(ErrorCode::InvalidArgument, "voxelize: " + what, fix);
}

/// Returns the box of the whole geometry: control hulls grown by the primitives' reach.
Bounds bounds_of(const Geometry& geometry) {
    Bounds box;
    const auto join = [](Bounds a, const Bounds& b) {
        a.grow(b);
        return a;
    };
    for (const CurveSet& set : geometry.curves) {
        const YarnType* yarn = geometry.yarn_of(set);
        const float factor = yarn == nullptr ? 1.0f : yarn_reach(*yarn) / yarn->model_radius;
        const auto reach = static_cast<double>(factor * radii_of(set, yarn).most);
        Bounds hulls = reduce_chunks(
            set.curve_count(), 64, Bounds{},
            [&](std::size_t begin, std::size_t end) {
                Bounds part;
                for (std::size_t c = begin; c < end; ++c) {
                    const std::size_t spans = set.span_count(c);
                    for (std::size_t k = 0; k < spans; ++k) part.grow(span_cubic(set, c, k).hull());
                }
                return part;
            },
            join);
        if (hulls.empty()) continue;
        box.grow(hulls.lo, reach);
        box.grow(hulls.hi, reach);
    }
    const TriangleSource triangles(geometry);
    for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m) {
        const double move = triangles.displacement(m);
        for (const Vec3f& p : geometry.meshes[m].positions) box.grow(to_double(p), move);
    }
    return box;
}

Lattice choose_lattice(const VoxelizeOptions& options, const Bounds& whole) {
    Lattice lattice{.voxel_size = options.voxel_size, .subvoxels = options.subvoxels};
    const Vec3d size = whole.size();
    const double longest = std::max({size.x, size.y, size.z});
    if (options.voxel_size == Vec3d{}) {
        const std::int64_t voxels = options.voxels == 0 ? kDefaultVoxels : options.voxels;
        if (voxels < 1) bad(str("voxels along the longest axis is ", voxels), "use 1 or more");
        const double h = longest / static_cast<double>(voxels);
        lattice.voxel_size = {h, h, h};
    }
    for (int a = 0; a < 3; ++a) {
        const double h = lattice.voxel_size[a];
        if (!(h > 0.0) || !std::isfinite(h)) {
            bad(str("voxel size ", h, " on axis ", "xyz"[a], " is not a positive number"),
                "use a length in scene units");
        }
    }
    const Vec3d& h = lattice.voxel_size;
    if (std::max({h.x, h.y, h.z}) / std::min({h.x, h.y, h.z}) > 64.0) {
        bad(str("voxel edges ", h.x, ", ", h.y, ", ", h.z, " differ by more than 64 times"),
            "use less flat voxels");
    }
    return lattice;
}

void check_options(const VoxelizeOptions& o) {
    if (o.subvoxels != 1 && o.subvoxels != 2 && o.subvoxels != 4 && o.subvoxels != 8) {
        bad(str("subvoxels per axis is ", o.subvoxels), "use 1, 2, 4 or 8");
    }
    if (o.max_lobes < 1 || o.max_lobes > 8) bad(str("lobes is ", o.max_lobes), "use 1 to 8");
    if (o.footprints != 0 && o.footprints != 4 && o.footprints != 8) {
        bad(str("footprints is ", o.footprints), "use 4 or 8 cells per axis");
    }
    if (o.samples < 0) bad(str("samples is ", o.samples), "use 0 or more");
}

/// Returns false if every set of curves and every mesh is a single point. A radius is no extent.
bool has_extent(const Geometry& geometry) {
    const auto differ = [](const std::vector<Vec3f>& points) {
        return std::adjacent_find(points.begin(), points.end(), std::not_equal_to<>()) !=
               points.end();
    };
    return std::any_of(geometry.curves.begin(), geometry.curves.end(),
                       [&](const CurveSet& set) { return differ(set.points); }) ||
           std::any_of(geometry.meshes.begin(), geometry.meshes.end(),
                       [&](const Mesh& mesh) { return differ(mesh.positions); });
}

/// Refuses curves with a surface's material: their tangents would be taken for normals.
void check_material(const Geometry& geometry, const CurveSet& set) {
    if (set.material >= geometry.materials.size()) return;
    const Material& material = geometry.materials[set.material];
    if (material.kind == MaterialKind::Fiber) return;
    bad(str("curves of '", geometry.name, "' have the material '", material.name, "' of a surface"),
        "set the material's kind to fiber");
}

void check_geometry(const Geometry& geometry) {
    if (!has_extent(geometry)) {
        throw Error(ErrorCode::BadFile, str("voxelize: '", geometry.name, "' has no extent"),
                    "check the file with heddle info");
    }
    if (geometry.materials.size() > 256) {
        bad(str(geometry.materials.size(), " materials in '", geometry.name, "' (limit 256)"),
            "merge some, or voxelize parts of it");
    }
    for (const CurveSet& set : geometry.curves) {
        const YarnType* yarn = geometry.yarn_of(set);
        const bool given = (yarn != nullptr && yarn->radius > 0.0f) || !set.radius.empty() ||
                           set.default_radius > 0.0f;
        if (!given) bad(str("'", geometry.name, "' names no radius"), "give --yarn-radius");
        check_material(geometry, set);
    }
}

/// Returns the box of all hits. The scan snaps vertices to its lattice, and a surface on a voxel's
/// face belongs to the voxel above. @throws Error if coordinates are too large for the scan
Bounds snap_bounds(const Bounds& whole, const Lattice& lattice, const std::string& name) {
    Bounds box;
    for (int a = 0; a < 3; ++a) {
        const double step =
            lattice.voxel_size[a] / lattice.subvoxels / static_cast<double>(kScanOne);
        const double far = std::max(std::abs(whole.lo[a]), std::abs(whole.hi[a]));
        if (far / step >= kMaxAxis * static_cast<double>(kScanOne)) {
            bad(str("'", name, "' lies ", far / step / static_cast<double>(kScanOne),
                    " subvoxels from the origin (limit 2^30 for meshes)"),
                "use larger voxels, or move it closer to the origin");
        }
        box.lo[a] = step * std::floor(whole.lo[a] / step + 0.5);
        box.hi[a] = step * (std::floor(whole.hi[a] / step + 0.5) + 0.5);
    }
    return box;
}

/// Sets the range of voxels that the region touches. @throws Error if there are too many
void choose_range(VoxelizePlan& plan, const std::string& name) {
    double total = 1.0;
    double most = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double h = plan.lattice.voxel_size[a];
        const double lo = std::floor(plan.bounds.lo[a] / h);
        double hi = std::ceil(plan.bounds.hi[a] / h);
        if (hi <= lo) hi = lo + 1.0; // a flat object on a voxel's face
        total *= hi - lo;
        most = std::max({most, std::abs(lo), std::abs(hi)});
        if (most <= kMaxAxis) {
            plan.voxel_lo[a] = static_cast<std::int32_t>(lo);
            plan.voxel_hi[a] = static_cast<std::int32_t>(hi);
        }
    }
    if (total <= kMaxVoxels && most <= kMaxAxis) return;
    const double factor = std::max(std::cbrt(total / kMaxVoxels), most / kMaxAxis);
    const Vec3d& h = plan.lattice.voxel_size;
    const bool many = total > kMaxVoxels;
    bad(str("voxel size ", h.x, " needs ", many ? total : most,
            many ? " voxels" : " voxels from the origin", " over '", name, "' (limit 2^",
            many ? 40 : 30, ")"),
        std::isfinite(factor) ? str("use at least ", h.x * factor * 1.01) : "use larger ones");
}

/// Voxelizes a random sample of the blocks and scales the counts: for fibers by the number of
/// pieces, for surfaces by the number of blocks (a fine mesh has more triangles but not more
/// voxels).
/// @return  estimated sums over all blocks
BlockCounts measure_sample(VoxelizePlan& plan,
                           const VoxelizeContext& context,
                           const Bins& bins,
                           const Progress& progress,
                           BlockVisitor* visitor) {
    const std::size_t blocks = bins.blocks().size();
    if (blocks == 0) return {};
    const bool surfaces = context.prepared.triangles.count() > context.prepared.fibers.span_count();
    // a block of surfaces takes little time, but blocks differ more
    const std::size_t wanted = surfaces ? std::clamp<std::size_t>(blocks / 32, 16, 256)
                                        : std::clamp<std::size_t>(blocks / 32, 4, 48);
    const std::size_t stride = std::max<std::size_t>(1, blocks / wanted);
    std::vector<std::uint32_t> chosen;
    double entries = 0.0;
    for (std::size_t i = 0; i < blocks; i += stride) {
        const std::size_t width = std::min(stride, blocks - i);
        chosen.push_back(bins.blocks()[i + hash64(0, i) % width]);
        entries += static_cast<double>(bins.entries(chosen.back()));
    }
    const Bins::Lists lists = bins.fill(chosen, progress);
    WorkerPool pool(context);
    const VoxelLevelInfo info = context.info();
    std::vector<BlockCounts> counts(chosen.size());
    parallel_chunks(chosen.size(), 1, [&](std::size_t s, std::size_t) {
        pool.with([&](BlockWorker& worker) {
            VoxelBlock out;
            counts[s] = worker.run(chosen[s], lists.of(s), progress, out);
            if (visitor != nullptr) visitor->sample(info, bins.range().index(chosen[s]), out);
        });
    });
    const double scale = surfaces ? static_cast<double>(blocks) / static_cast<double>(chosen.size())
                                  : static_cast<double>(bins.total_entries()) / entries;
    const auto scaled = [&](std::int64_t BlockCounts::*field) {
        std::int64_t sum = 0;
        for (const BlockCounts& c : counts) sum += c.*field;
        return static_cast<std::int64_t>(static_cast<double>(sum) * scale + 0.5);
    };
    plan.voxels = scaled(&BlockCounts::voxels);
    plan.lobes = scaled(&BlockCounts::lobes);
    plan.leaves = scaled(&BlockCounts::leaves);
    plan.touched_subvoxels = scaled(&BlockCounts::subvoxels);
    if (visitor != nullptr) {
        std::vector<Vec3i> all;
        for (const std::uint32_t block : bins.blocks()) all.push_back(bins.range().index(block));
        LevelPlan above = visitor->plan({.blocks = all,
                                         .scale = scale,
                                         .voxel_lo = plan.voxel_lo,
                                         .voxel_hi = plan.voxel_hi,
                                         .voxels = plan.voxels,
                                         .correlation = plan.fields.correlation});
        plan.levels = std::move(above.levels);
        plan.visitor_bytes = above.workspace_bytes;
        plan.visitor_seconds = above.thread_seconds;
    }
    return {.triangles = scaled(&BlockCounts::triangles),
            .triangle_hits = scaled(&BlockCounts::triangle_hits),
            .surface_samples = scaled(&BlockCounts::surface_samples)};
}

/// @param work  sums over all blocks, from measure_sample()
double predict_seconds(const VoxelizePlan& plan, const BlockCounts& work) {
    const auto voxels = static_cast<double>(plan.voxels);
    const double fibers = kSecondsPerStep * plan.steps +
                          kSecondsPerSubvoxel * static_cast<double>(plan.touched_subvoxels) +
                          kSecondsPerVoxel * voxels;
    const double surfaces = kSecondsPerTriangle * static_cast<double>(work.triangles) +
                            kSecondsPerHit * static_cast<double>(work.triangle_hits) +
                            kSecondsPerSample * static_cast<double>(work.surface_samples) +
                            kSecondsPerSurfaceVoxel * voxels;
    return ((plan.steps > 0.0 ? fibers : 0.0) + (work.triangles > 0 ? surfaces : 0.0) +
            plan.visitor_seconds) /
           thread_count();
}

template <typename T>
std::int64_t bytes_of(const std::vector<T>& v) {
    return static_cast<std::int64_t>(v.capacity() * sizeof(T));
}

std::int64_t geometry_bytes(const Geometry& geometry) {
    std::int64_t sum = 0;
    for (const CurveSet& s : geometry.curves) {
        sum += bytes_of(s.points) + bytes_of(s.first) + bytes_of(s.closed) + bytes_of(s.radius) +
               bytes_of(s.color);
    }
    for (const Mesh& m : geometry.meshes) {
        sum += bytes_of(m.positions) + bytes_of(m.normals) + bytes_of(m.tangents) +
               bytes_of(m.uvs) + bytes_of(m.triangles);
    }
    for (const Texture& t : geometry.textures) sum += bytes_of(t.texels);
    return sum;
}

std::int64_t memory_limit(const VoxelizeOptions& options) {
    if (options.memory_bytes != 0) return options.memory_bytes;
    return std::max<std::int64_t>(available_bytes() / 2, std::int64_t{1} << 30);
}

/// @throws Error  OutOfMemory: the counters of all blocks, including empty ones, take too much
///                memory
void check_blocks(const BlockRange& range, const VoxelizeOptions& options) {
    const std::int64_t limit = memory_limit(options);
    const auto counters = static_cast<std::int64_t>(range.count() * sizeof(std::uint32_t));
    if (kProgramBytes + counters <= limit) return;
    throw Error(ErrorCode::OutOfMemory,
                str("voxelize: ", limit >> 20, " MiB of memory is not enough for a box of ",
                    range.count(), " blocks"),
                str("give at least ", ((kProgramBytes + counters) >> 20) + 1,
                    "M, use larger voxels, or only a part (bounds)"));
}

/// Divides the work into batches and decides whether finished blocks are stored in a file.
void plan_memory(VoxelizePlan& plan, const VoxelizeContext& context, const Bins& bins) {
    const std::int64_t limit = memory_limit(context.options);
    const std::int64_t fixed = kProgramBytes + geometry_bytes(context.prepared.geometry) +
                               context.prepared.fibers.byte_count() +
                               SurfaceSource::predict_bytes(context.prepared.geometry);
    const std::int64_t counts = bins.byte_count();
    const std::int64_t workers = thread_count() * BlockWorker::byte_count(context.fit);
    const VoxelFields& fields = plan.fields;
    std::int64_t result = predict_block_bytes(plan.leaves, plan.voxels, plan.lobes, fields);
    std::int64_t leaves = plan.leaves;
    VoxelFields of_levels = fields;
    of_levels.masks = false;
    for (const LevelSize& l : plan.levels) {
        result += predict_block_bytes(l.leaves, l.voxels, l.lobes, of_levels);
        leaves += l.leaves;
    }
    const std::int64_t writer =
        context.options.writer_bytes + leaves * context.options.writer_bytes_per_leaf;
    const auto entries = static_cast<std::int64_t>(bins.total_entries() * sizeof(Primitive));

    const auto peak = [&](std::int64_t kept, std::int64_t lists) {
        return fixed +
               std::max(counts + workers + plan.visitor_bytes + kept + lists, kept + writer);
    };
    plan.spool = !fields.correlation && peak(result, std::min(entries, limit / 8)) > limit;
    const std::int64_t kept = plan.spool ? 0 : result;
    const std::int64_t room = limit - fixed - counts - workers - plan.visitor_bytes - kept;
    const std::int64_t lists = std::max<std::int64_t>(room, entries / 64 + 1);
    plan.batches = entries == 0 ? 1 : (entries + lists - 1) / lists;
    plan.peak_bytes = peak(kept, std::min(entries, lists));
    if (plan.peak_bytes > limit && context.options.memory_bytes != 0) {
        throw Error(ErrorCode::OutOfMemory,
                    str("voxelize: ", limit >> 20, " MiB of memory is not enough for about ",
                        plan.voxels, " voxels"),
                    str("give at least ", (plan.peak_bytes >> 20) + 1, "M, or use larger voxels"));
    }
}

} // namespace

VoxelizePlan plan_range(const Geometry& geometry, const VoxelizeOptions& options) {
    check_options(options);
    check_geometry(geometry);
    const Bounds whole = bounds_of(geometry);
    VoxelizePlan plan;
    plan.lattice = choose_lattice(options, whole);
    plan.bounds = whole;
    if (!geometry.meshes.empty()) plan.bounds.grow(snap_bounds(whole, plan.lattice, geometry.name));
    if (options.bounds) {
        for (int a = 0; a < 3; ++a) {
            plan.bounds.lo[a] = std::max(plan.bounds.lo[a], options.bounds->lo[a]);
            plan.bounds.hi[a] = std::min(plan.bounds.hi[a], options.bounds->hi[a]);
        }
        if (plan.bounds.empty()) {
            bad("the bounds do not meet the object", "heddle info shows where it lies");
        }
    }
    choose_range(plan, geometry.name);
    check_blocks(BlockRange(plan.voxel_lo, plan.voxel_hi), options);
    plan.block_voxels = kBlockVoxels;
    return plan;
}

VoxelizePlan plan_voxelize(const Geometry& geometry,
                           const VoxelizeOptions& options,
                           const Progress& progress,
                           BlockVisitor* visitor) {
    VoxelizePlan plan = plan_range(geometry, options);
    auto prepared = std::make_unique<PreparedGeometry>(geometry, plan.lattice, plan.voxel_lo,
                                                       plan.voxel_hi, options.seed);
    const Bins& bins = prepared->bins(progress);
    const VoxelizeContext context(*prepared, options, visitor != nullptr);
    plan.fields = context.fields();
    plan.blocks = static_cast<std::int64_t>(bins.blocks().size());
    plan.primitives =
        static_cast<std::int64_t>(prepared->fibers.span_count() + prepared->triangles.count());
    plan.step_length = prepared->units.unit;
    plan.steps = prepared->fibers.fiber_length() / plan.step_length;
    plan.chord_error = kChordSagitta * 2.0 / 3.0;
    const BlockCounts work = measure_sample(plan, context, bins, progress, visitor);
    plan.seconds = predict_seconds(plan, work);
    plan_memory(plan, context, bins);
    plan.prepared = std::make_shared<PreparedSlot>(std::move(prepared));
    return plan;
}

} // namespace heddle
