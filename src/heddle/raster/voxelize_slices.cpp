#include <heddle/raster/voxelize_slices.h>

#include <heddle/base/error.h>
#include <heddle/base/object_pool.h>
#include <heddle/base/parallel.h>
#include <heddle/raster/brick_grid.h>
#include <heddle/raster/brick_words.h>
#include <heddle/raster/rasterize_bricks.h>
#include <heddle/raster/segment_pass.h>
#include <heddle/voxel/block_sink.h>
#include <heddle/voxelize/block_worker.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace heddle::raster {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Returns the block that contains the smallest control point, which is the same for every region.
Vec3i origin_of(const Geometry& geometry, const LatticeUnits& units) {
    Vec3d least{1e300, 1e300, 1e300};
    for (const CurveSet& set : geometry.curves) {
        for (const Vec3f& p : set.points) {
            for (int a = 0; a < 3; ++a) least[a] = std::min(least[a], static_cast<double>(p[a]));
        }
    }
    Vec3i out;
    for (int a = 0; a < 3; ++a) {
        const double block = units.voxel_size[a] * kBlockVoxels;
        out[a] = static_cast<std::int32_t>(std::floor(least[a] / block)) * kBlockVoxels;
    }
    return out;
}

/// Returns the bits of a weight with which three passes over eight times a full voxel stay below
/// 2^31.
int weight_bits(const LatticeUnits& units,
                std::span<const slice::SliceChunk> chunks,
                float thinnest) {
    if (chunks.empty()) return 0;
    const double volume = static_cast<double>(units.voxel.x) * static_cast<double>(units.voxel.y) *
                          static_cast<double>(units.voxel.z);
    const double most = 3.0 * 0.6366 * volume / static_cast<double>(thinnest);
    return static_cast<int>(std::clamp(std::floor(28.0 - std::log2(most)), -20.0, 20.0));
}

/// Returns the radius of the thinnest fiber, in units.
float thinnest_fiber(const Geometry& geometry,
                     const slice::SectionLayers& sections,
                     const LatticeUnits& units) {
    float least = 1e30f;
    for (std::size_t s = 0; s < geometry.curves.size(); ++s) {
        const CurveSet& set = geometry.curves[s];
        const YarnType* yarn = geometry.yarn_of(set);
        const float radius = radii_of(set, yarn).least;
        const float model = yarn == nullptr ? 1.0f : yarn->model_radius;
        for (std::uint32_t l = sections.first[s]; l < sections.first[s + 1]; ++l) {
            least = std::min(least, radius / model * sections.layers[l].fiber_radius);
        }
    }
    return std::max(least / static_cast<float>(units.unit), 1e-6f);
}

/// Refuses segments whose box has too many bricks: software drivers end a loop after 65535
/// iterations.
void check_thickness(const slice::SectionLayers& sections,
                     const Geometry& geometry,
                     const LatticeUnits& units) {
    constexpr double kMaxReach = 1000.0;
    for (std::size_t s = 0; s < geometry.curves.size(); ++s) {
        const CurveSet& set = geometry.curves[s];
        const YarnType* yarn = geometry.yarn_of(set);
        const float radius = radii_of(set, yarn).most;
        const float model = yarn == nullptr ? 1.0f : yarn->model_radius;
        const float extent = sections.layers[sections.first[s]].extent;
        const double reach = static_cast<double>(radius / model * extent) / units.unit;
        if (reach <= kMaxReach) continue;
        throw Error(ErrorCode::Unsupported,
                    str("raster: a yarn reaches ", reach, " subvoxels from its centreline (limit ",
                        kMaxReach, ")"),
                    "use larger voxels, or --backend sample");
    }
}

void check_geometry(const Geometry& geometry) {
    if (geometry.meshes.empty()) return;
    throw Error(ErrorCode::Unsupported,
                str("raster: '", geometry.name, "' has meshes; slices are of yarn and hair"),
                "use --backend sample");
}

/// Converts sums to voxels, block by block.
struct BlockFitter {
    const VoxelizeContext& context;
    const BrickGrid& grid;
    std::span<const TouchedBlock> blocks;
    BlockSink& sink;
    ObjectPool<BlockSums> lender{};

    void fit(const RasterBatch& batch) {
        parallel_chunks(batch.end - batch.begin, 1, [&](std::size_t i, std::size_t) {
            const auto make = [&] {
                return std::make_unique<BlockSums>(context.fit.fields.map_sums());
            };
            lender.with(make, [&](BlockSums& sums) { fit_one(batch, batch.begin + i, sums); });
        });
    }

    void fit_one(const RasterBatch& batch, std::size_t rank, BlockSums& sums) {
        const TouchedBlock& block = blocks[rank];
        Vec3i lo;
        Vec3i hi;
        for (int a = 0; a < 3; ++a) {
            const std::int32_t corner = block.index[a] * kBlockVoxels;
            lo[a] = std::max(corner, grid.voxel_lo[a] + grid.origin[a]);
            hi[a] = std::min(corner + kBlockVoxels, grid.voxel_hi[a] + grid.origin[a]);
        }
        sums.reset(lo, hi);
        for (const RasterMaterial& drawn : batch.materials) {
            for (std::size_t k = 0; k < block.bricks.size(); ++k) {
                const std::size_t slot = batch.first_slot[rank - batch.begin] + k;
                const Vec3i corner = grid.brick(block.bricks[k]) * kBrickEdge + grid.origin - lo;
                add_brick(std::span(drawn.words).subspan(slot * kBrickWords, kBrickWords),
                          drawn.form, corner, sums);
            }
        }
        VoxelBlock out;
        fit_block(sums, context.fit, out);
        sink.take(rank, out);
    }
};

RasterCounts count(std::span<const slice::SliceChunk> chunks,
                   std::span<const TouchedBlock> blocks) {
    RasterCounts out;
    for (const slice::SliceChunk& c : chunks) out.slices += c.count;
    for (const TouchedBlock& b : blocks) out.bricks += static_cast<std::int64_t>(b.bricks.size());
    return out;
}

/// Draws and fits all blocks, batch by batch.
void draw_all(BrickRasterizer& rasterizer,
              BlockFitter& fitter,
              Progress& progress,
              RasterCounts& done) {
    progress.begin("draw", "bricks", done.bricks);
    for (std::size_t begin = 0; begin < fitter.blocks.size(); ++done.batches) {
        progress.check();
        const auto drawn_at = Clock::now();
        const RasterBatch batch = rasterizer.draw(fitter.blocks, begin);
        done.draw_seconds += seconds_since(drawn_at);
        const auto fitted_at = Clock::now();
        fitter.fit(batch);
        done.fit_seconds += seconds_since(fitted_at);
        progress.advance(static_cast<std::int64_t>(batch.bricks));
        begin = batch.end;
    }
}

std::vector<Vec3i> indices_of(std::span<const TouchedBlock> blocks) {
    std::vector<Vec3i> out;
    for (const TouchedBlock& b : blocks) out.push_back(b.index);
    return out;
}

std::int64_t memory_of(const VoxelizeOptions& options) {
    return options.memory_bytes > 0 ? options.memory_bytes / 4 : std::int64_t{512} << 20;
}

} // namespace

struct SliceVoxelizer::Kept {
    opengl::Context driver;
    slice::PlacePrograms place;
    opengl::Program mark = make_mark_program();
    SegmentResources kit;
    slice::SectionLayers sections;
    std::optional<slice::SectionTextures> textures;

    explicit Kept(const RasterOptions& raster) : kit(driver, raster.path, raster.composition) {}

    void update(const Geometry& geometry, std::uint64_t seed) {
        if (slice::update_sections(sections, geometry, seed)) textures.emplace(sections);
    }
};

SliceVoxelizer::Kept& SliceVoxelizer::open() {
    if (!kept_) kept_ = std::make_unique<Kept>(raster_);
    kept_->driver.make_current(); // another context may be current
    return *kept_;
}

std::int64_t SliceVoxelizer::predict_bytes(const Geometry& geometry,
                                           const VoxelizeOptions& options,
                                           const VoxelizePlan& plan) {
    constexpr std::int64_t kDriver = std::int64_t{90} << 20; // measured: llvmpipe with its programs
    constexpr double kTouched = 1.6; // measured: touched bricks per leaf with voxels
    const opengl::Context& driver = open().driver;
    const auto brick = static_cast<std::int64_t>(kBrickWords * sizeof(std::uint32_t));
    const auto touched =
        static_cast<std::int64_t>(kTouched * static_cast<double>(plan.leaves)) + 64;
    const std::int64_t sums =
        std::min({touched * brick, driver.limits().storage_bytes, memory_of(options)});
    if (!driver.is_software()) return sums;
    const LatticeUnits units(plan.lattice);
    const std::int64_t slices =
        slice::estimate_slices(geometry, units, {.spacing = raster_.slice_spacing / units.unit});
    const auto each = static_cast<std::int64_t>(sizeof(slice::PlacedSlice) + sizeof(std::uint32_t));
    return kDriver + 2 * sums + slices * each;
}

SliceVoxelizer::SliceVoxelizer(const RasterOptions& raster) : raster_(raster) {}
SliceVoxelizer::~SliceVoxelizer() = default;

std::unique_ptr<VoxelLevel> SliceVoxelizer::voxelize(const Geometry& geometry,
                                                     const VoxelizeOptions& options,
                                                     const VoxelizePlan& plan,
                                                     Progress& progress,
                                                     BlockVisitor* visitor,
                                                     RasterCounts* counts) {
    check_geometry(geometry);
    const auto start = Clock::now();
    const std::unique_ptr<PreparedGeometry> prepared = take_prepared(plan, geometry, options.seed);
    prepared->drop_bins(); // the driver finds the blocks
    const LatticeUnits& units = prepared->units;
    const VoxelizeContext context(*prepared, options, visitor != nullptr);
    const BrickGrid grid(units, origin_of(geometry, units), plan.voxel_lo, plan.voxel_hi);
    const opengl::Context& driver = open().driver;
    kept_->update(geometry, options.seed);
    const slice::SectionLayers& sections = kept_->sections;
    check_thickness(sections, geometry, units);
    const std::vector<slice::SliceChunk> chunks =
        slice::place_slices(driver, geometry, sections, units,
                            {.origin = grid.origin,
                             .spacing = raster_.slice_spacing / units.unit,
                             .programs = &kept_->place});
    const std::vector<TouchedBlock> blocks = find_blocks(driver, kept_->mark, grid, chunks);
    const int bits = weight_bits(units, chunks, thinnest_fiber(geometry, sections, units));
    RasterCounts done = count(chunks, blocks);
    BrickRasterizer rasterizer(
        driver, kept_->kit, grid, *kept_->textures, chunks,
        {.weight_bits = bits, .memory_bytes = memory_of(options), .bricks = done.bricks});
    BlockSink sink(context.info(), indices_of(blocks), plan.spool, options.spool_dir, visitor);
    BlockFitter fitter{context, grid, blocks, sink};
    done.driver = driver.driver();
    done.setup_seconds = seconds_since(start);
    draw_all(rasterizer, fitter, progress, done);
    done.path = kept_->kit.path();
    if (counts != nullptr) *counts = done;
    return sink.finish();
}

std::unique_ptr<VoxelLevel> voxelize_slices(const Geometry& geometry,
                                            const VoxelizeOptions& options,
                                            const RasterOptions& raster,
                                            const VoxelizePlan& plan,
                                            Progress& progress,
                                            BlockVisitor* visitor,
                                            RasterCounts* counts) {
    return SliceVoxelizer(raster).voxelize(geometry, options, plan, progress, visitor, counts);
}

} // namespace heddle::raster
