#include <heddle/voxelize/block_worker.h>

#include <algorithm>

namespace heddle {
namespace {

/// Returns the optional fields that the voxels have, which depend on the materials and their maps.
VoxelFields fields_of(const Geometry& geometry) {
    VoxelFields fields;
    for (const CurveSet& set : geometry.curves) {
        const YarnType* yarn = geometry.yarn_of(set);
        const bool slice = yarn != nullptr && yarn->model == YarnModel::Slice;
        fields.albedo = fields.albedo || slice || !set.color.empty();
    }
    for (const Mesh& mesh : geometry.meshes) {
        const Material& m = geometry.materials[mesh.material];
        fields.albedo = fields.albedo || m.albedo_map >= 0;
        fields.surface = fields.surface || m.metal_rough_map >= 0 || m.anisotropy_map >= 0;
        fields.tangents = fields.tangents || m.anisotropy > 0.0f;
        fields.slabs = fields.slabs || m.kind == MaterialKind::Surface;
    }
    return fields;
}

} // namespace

VoxelizeContext::VoxelizeContext(const PreparedGeometry& prepared_in,
                                 const VoxelizeOptions& options_in,
                                 bool with_sums)
    : prepared(prepared_in),
      options(options_in),
      fit{.subvoxels = prepared_in.lattice.subvoxels,
          .max_lobes = options_in.max_lobes,
          .project_subvoxels = options_in.coverage == CoverageMode::Mask,
          .fields = fields_of(prepared_in.geometry),
          .voxel_size = prepared_in.lattice.voxel_size} {
    fit.fields.masks = options_in.keep_sums || with_sums;
    fit.fields.footprints = options_in.footprints;
    fit.fields.occupancy = options_in.occupancy;
    fit.fields.correlation = options_in.correlation;
    for (std::uint32_t m = 0; m < prepared.geometry.materials.size(); ++m) {
        if (prepared.geometry.materials[m].kind == MaterialKind::Surface) fit.normals.add(m);
    }
}

VoxelFields VoxelizeContext::fields() const {
    VoxelFields of_result = fit.fields;
    of_result.masks = options.keep_sums;
    return of_result;
}

VoxelLevelInfo VoxelizeContext::info() const {
    const Geometry& geometry = prepared.geometry;
    VoxelLevelInfo info{.name = geometry.name,
                        .lattice = prepared.lattice,
                        .max_lobes = options.max_lobes,
                        .fields = fields(),
                        .materials = geometry.materials,
                        .yarns = geometry.yarns,
                        .command = options.command};
    for (YarnType& yarn : info.yarns) yarn.slice.texels.clear();
    for (std::size_t m = 0; m < info.materials.size(); ++m) {
        info.materials[m].fiber_radius = mean_fiber_radius(geometry, static_cast<std::uint32_t>(m));
    }
    return info;
}

BlockWorker::BlockWorker(const VoxelizeContext& context)
    : context_(context),
      sums_(context.fit.fields.map_sums()),
      fibers_(context.prepared.fibers, context.prepared.units, context.options.gather()),
      triangles_(context.prepared.surfaces, context.prepared.units, context.options.fit),
      slabs_(context.prepared.surfaces, context.fit) {}

BlockCounts BlockWorker::run(std::uint64_t block,
                             std::span<const Primitive> primitives,
                             const Progress& progress,
                             VoxelBlock& out) {
    Vec3i lo;
    Vec3i hi;
    context_.prepared.range.voxels(block, lo, hi);
    sums_.reset(lo, hi);
    // sorted: fiber pieces first, triangles (top bit set) after them
    const auto split = static_cast<std::size_t>(
        std::lower_bound(primitives.begin(), primitives.end(), kTriangleBit) - primitives.begin());
    fibers_.gather(primitives.first(split), sums_, progress);
    const std::span<const Primitive> triangles = primitives.subspan(split);
    const TriangleWork work = triangles_.gather(triangles, sums_, progress);
    BlockCounts counts = fit_block(sums_, context_.fit, out);
    if (context_.fit.fields.slabs) slabs_.fit(triangles, lo, hi, progress, out);
    counts.triangles = static_cast<std::int64_t>(triangles.size());
    counts.triangle_hits = work.hits;
    counts.surface_samples = work.samples;
    return counts;
}

std::int64_t BlockWorker::byte_count(const FitOptions& fit) {
    const std::size_t voxel =
        sizeof(std::uint16_t) + sizeof(VoxelSums) + (fit.fields.map_sums() ? sizeof(MapSums) : 0);
    return static_cast<std::int64_t>(voxel * BlockSums::kVoxels + (std::size_t{1} << 18)) +
           (fit.fields.slabs ? SlabFitter::byte_count() : 0);
}

} // namespace heddle
