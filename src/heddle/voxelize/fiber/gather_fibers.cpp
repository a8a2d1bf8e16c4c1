#include <heddle/voxelize/fiber/gather_fibers.h>

#include <heddle/base/trig.h>
#include <heddle/voxelize/chord/fiber_tile.h>
#include <heddle/voxelize/chord/yarn_frame.h>
#include <heddle/voxelize/fiber/chord_queue.h>
#include <heddle/voxelize/fiber/gather_kernels.h>
#include <heddle/voxelize/fiber/gather_samples.h>
#include <heddle/yarn/flyaway.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace heddle {
namespace {

/// The piece whose chords are added, and the block.
struct PieceTarget {
    GatherTarget block;
    Vec3i anchor;                      ///< anchor of the piece, relative to the block's lo
    std::uint32_t part = 0, parts = 1; ///< number of the piece in its span
};

HEDDLE_CLONES void gather_thick(const Chord& chord, Vec3i anchor, const GatherTarget& t) {
    gather_chord(FiberSums{t.block, t.paint}, t.units, t.size, chord, anchor);
}

} // namespace

struct FiberGatherer::Impl {
    const FiberSource& source;
    LatticeUnits units;
    GatherOptions options;
    bool mask;        ///< CoverageMode::Mask
    FiberTable table; ///< fibers of the yarn below
    std::uint32_t table_set = ~0u;
    std::uint64_t table_curve = ~std::uint64_t{0};
    FiberTile tile;
    std::vector<PlyFrame> frames; ///< plies x kSamples
    std::vector<LoopMemo> loops;  ///< per fiber of the table
    std::vector<Chord> chords;
    ChordQueue queue;

    [[nodiscard]] GatherTarget target_of(std::uint32_t set, BlockSums& block) const;
    void gather_run(const PieceTarget& target);
    void
    gather_one(const Chord& chord, const PieceTarget& target, double begin, double width) const;
    void gather_chords(std::size_t first, const PieceTarget& target, double t0, double t1);
    void gather_one_by_one(std::size_t first,
                           int j,
                           float radius,
                           const PieceTarget& target,
                           double begin,
                           double width);
    void gather_piece(const FiberPiece& piece, BlockSums& block);
    void gather_plain(const FiberPiece& piece, const LocalCubic& cubic, PieceTarget& target);
    void gather_yarn(const FiberPiece& piece, const LocalCubic& cubic, PieceTarget& target);
    void gather_tiles(const YarnType& yarn,
                      const PlySection& section,
                      const PieceTarget& target,
                      const YarnCourse& course,
                      double t0,
                      double t1);
    void gather_hairs(const YarnType& yarn,
                      const LocalCubic& cubic,
                      const YarnCourse& course,
                      PieceTarget& target);
    void set_loops(const YarnType& yarn, std::size_t first, double s0, double s1);
};

GatherTarget FiberGatherer::Impl::target_of(std::uint32_t set, BlockSums& block) const {
    return {
        block,
        units,
        std::countr_zero(static_cast<unsigned>(units.n)),
        block.hi() - block.lo(),
        {.material = source.geometry().curves[set].material, .last = options.fit == FitMode::Last}};
}

void FiberGatherer::Impl::gather_run(const PieceTarget& target) {
    for (std::size_t j = 0; j < chords.size(); ++j) {
        if (mask || chords[j].radius > kThickRadius) {
            const auto count = static_cast<double>(chords.size());
            gather_one(chords[j], target, static_cast<double>(j) / count, 1.0 / count);
        } else {
            queue.add(chords[j], target.anchor, target.block.paint.color);
            if (queue.full()) queue.flush(target.block);
        }
    }
}

void FiberGatherer::Impl::gather_one(const Chord& chord,
                                     const PieceTarget& target,
                                     double begin,
                                     double width) const {
    if (!mask) {
        gather_thick(chord, target.anchor, target.block);
        return;
    }
    const auto parts = static_cast<double>(target.parts);
    const double from = (static_cast<double>(target.part) + begin) / parts;
    gather_samples(chord, target.anchor, target.block,
                   {options.samples, from, from + width / parts});
}

void FiberGatherer::Impl::gather_chords(std::size_t first,
                                        const PieceTarget& target,
                                        double t0,
                                        double t1) {
    std::array<std::array<std::int32_t, FiberTile::kRow>, 3> anchor;
    std::array<float, FiberTile::kRow> radius;
    for (int a = 0; a < 3; ++a) anchor[static_cast<std::size_t>(a)].fill(target.anchor[a]);
    for (int j = 0; j < tile.chords; ++j) {
        const float mean = 0.5f * (tile.radius[j + 1] + tile.radius[j + 2]);
        if (mask || mean > kThickRadius) {
            gather_one_by_one(first, j, mean, target, t0 + (t1 - t0) * (j + 1) / (tile.chords + 2),
                              (t1 - t0) / (tile.chords + 2));
            continue;
        }
        radius.fill(mean);
        gather_thin({{tile.x[j + 1], tile.y[j + 1], tile.z[j + 1]},
                     {tile.dx[j], tile.dy[j], tile.dz[j]},
                     {tile.bx[j], tile.by[j], tile.bz[j]},
                     tile.length[j],
                     tile.before[j],
                     tile.after[j],
                     radius.data(),
                     {anchor[0].data(), anchor[1].data(), anchor[2].data()},
                     table.color.data() + first,
                     tile.fibers},
                    target.block);
    }
}

void FiberGatherer::Impl::gather_one_by_one(
    std::size_t first, int j, float radius, const PieceTarget& target, double begin, double width) {
    PieceTarget own = target;
    for (int f = 0; f < tile.fibers; ++f) {
        if (!(tile.length[j][f] > 0.0f)) continue;
        own.block.paint.color = table.color[first + static_cast<std::size_t>(f)];
        gather_one({{tile.x[j + 1][f], tile.y[j + 1][f], tile.z[j + 1][f]},
                    {tile.dx[j][f], tile.dy[j][f], tile.dz[j][f]},
                    tile.length[j][f],
                    tile.before[j][f],
                    tile.after[j][f],
                    radius},
                   own, begin, width);
    }
}

void FiberGatherer::Impl::gather_piece(const FiberPiece& piece, BlockSums& block) {
    const LocalCubic cubic(piece.cubic, units);
    PieceTarget target{target_of(piece.set, block), cubic.anchor - block.lo(), piece.part,
                       piece.parts};
    const YarnType* yarn = source.yarn_of(piece.set);
    if (yarn == nullptr || yarn->model == YarnModel::Solid) {
        gather_plain(piece, cubic, target);
    } else {
        gather_yarn(piece, cubic, target);
    }
}

void FiberGatherer::Impl::gather_plain(const FiberPiece& piece,
                                       const LocalCubic& cubic,
                                       PieceTarget& target) {
    const FiberView fibers = source.view();
    const CurveSetView& set = fibers.sets[piece.set];
    if (set.color != nullptr) target.block.paint.color = set.color_of(piece);
    chords.clear();
    for_each_plain_chord(fibers, piece, cubic, units, [&](const Chord& c) { chords.push_back(c); });
    gather_run(target);
}

void FiberGatherer::Impl::gather_yarn(const FiberPiece& piece,
                                      const LocalCubic& cubic,
                                      PieceTarget& target) {
    const YarnType& yarn = *source.yarn_of(piece.set);
    if (table_set != piece.set || table_curve != piece.curve) {
        table = place_fibers(yarn, source.seed() + piece.set, piece.curve);
        table_set = piece.set;
        table_curve = piece.curve;
        loops.clear();
    }
    const YarnCourse course = source.course(piece, units.unit);
    const PlySection section = section_of(yarn);
    const int count = yarn_chord_count(piece, cubic, course, section, units);
    const std::size_t plies = table.first_of_ply.size() - 1;
    frames.resize(plies * FiberTile::kSamples);
    for (int j0 = 0; j0 < count; j0 += FiberTile::kChords) {
        tile.chords = std::min(FiberTile::kChords, count - j0);
        for (int j = 0; j < tile.chords + 3; ++j) {
            const float t = static_cast<float>(j0 + j - 1) / static_cast<float>(count);
            YarnFrame frame(cubic, course, t);
            frame.twist(course);
            tile.radius[j] = table.fiber_radius * frame.scale;
            for (std::size_t ply = 0; ply < plies; ++ply) {
                frames[ply * FiberTile::kSamples + static_cast<std::size_t>(j)] =
                    frame.of_ply({table.ply_sin[ply], table.ply_cos[ply]});
            }
        }
        const double t0 = static_cast<double>(j0 - 1) / count;
        gather_tiles(yarn, section, target, course, t0,
                     t0 + static_cast<double>(tile.chords + 2) / count);
    }
    if (yarn.flyaways && yarn.hair_density > 0.0f) gather_hairs(yarn, cubic, course, target);
}

void FiberGatherer::Impl::gather_tiles(const YarnType& yarn,
                                       const PlySection& section,
                                       const PieceTarget& target,
                                       const YarnCourse& course,
                                       double t0,
                                       double t1) {
    const bool with_loops = yarn.flyaways && yarn.loop_density > 0.0f;
    std::array<PlyPart, 8> parts;
    std::size_t ply = 0;
    for (std::size_t first = 0; first < table.size();) {
        std::size_t end = first;
        std::size_t count = 0;
        while (end < table.size() && end - first < FiberTile::kFibers && count < parts.size()) {
            const std::size_t stop =
                std::min<std::size_t>(table.first_of_ply[ply + 1], first + FiberTile::kFibers);
            parts[count++] = {end, stop, &frames[ply * FiberTile::kSamples]};
            end = stop;
            if (end == table.first_of_ply[ply + 1]) ++ply;
        }
        tile.fibers = static_cast<int>(end - first);
        tile.loops = false;
        if (with_loops) {
            set_loops(yarn, first, course.start + course.length * t0,
                      course.start + course.length * t1);
        }
        expand_fibers(tile, std::span(parts.data(), count), section, table);
        gather_chords(first, target, t0, t1);
        first = end;
    }
}

void FiberGatherer::Impl::set_loops(const YarnType& yarn, std::size_t first, double s0, double s1) {
    const LoopModel model(yarn);
    const int samples = tile.chords + 3;
    const auto fibers = static_cast<std::size_t>(tile.fibers);
    loops.resize(table.size());
    for (std::size_t f = 0; f < fibers; ++f) {
        const std::size_t i = first + f;
        const float turns = table.migration_turns[i];
        const double p0 = LoopModel::period_of(model.phase_at(s0, turns));
        const double p1 = LoopModel::period_of(model.phase_at(s1, turns));
        const std::uint64_t id = LoopModel::id(source.seed() + table_set, table_curve, i);
        const auto ratio = [&](double period) {
            return loops[i].ratio(model, id, period, table.radius[i]);
        };
        bool any = false;
        for (double p = std::min(p0, p1); p <= std::max(p0, p1); p += 1.0) {
            any = any || ratio(p) > 1.0;
        }
        if (!any) continue;
        if (!tile.loops) {
            for (int j = 0; j < samples; ++j) std::fill_n(tile.loop[j], fibers, 1.0f);
            tile.loops = true;
        }
        for (int j = 0; j < samples; ++j) {
            const double phase = model.phase_at(s0 + (s1 - s0) * j / (samples - 1), turns);
            tile.loop[j][f] = LoopModel::factor(ratio(LoopModel::period_of(phase)), phase);
        }
    }
}

void FiberGatherer::Impl::gather_hairs(const YarnType& yarn,
                                       const LocalCubic& cubic,
                                       const YarnCourse& course,
                                       PieceTarget& target) {
    const HairModel model(HairShape(yarn), course.total, course.closed);
    const std::uint64_t seed = source.seed() + table_set;
    for (std::size_t ply = 0; ply + 1 < table.first_of_ply.size(); ++ply) {
        model.for_each({seed, table_curve, ply}, course.start, course.start + course.length,
                       [&](const FlyawayHair& hair) {
                           chords.clear();
                           HairPath{cubic,
                                    course,
                                    hair,
                                    {table.ply_sin[ply], table.ply_cos[ply]},
                                    yarn.ply_offset,
                                    table.fiber_radius}
                               .for_each_chord([&](const Chord& c) { chords.push_back(c); });
                           gather_run(target);
                       });
    }
}

FiberGatherer::FiberGatherer(const FiberSource& source,
                             const LatticeUnits& units,
                             const GatherOptions& options)
    : impl_(new Impl{.source = source,
                     .units = units,
                     .options = options,
                     .mask = options.coverage == CoverageMode::Mask,
                     .table = {},
                     .tile = {},
                     .frames = {},
                     .loops = {},
                     .chords = {},
                     .queue = {}}) {}

FiberGatherer::~FiberGatherer() = default;

void FiberGatherer::gather(std::span<const PieceId> pieces,
                           BlockSums& block,
                           const Progress& progress) {
    Impl& state = *impl_;
    const bool last = state.options.fit == FitMode::Last;
    std::uint32_t set = 0; // set of the queued chords
    std::size_t done = 0;
    for (const PieceId id : pieces) {
        if (done++ % 64 == 0) progress.check();
        const FiberPiece piece = state.source.view().piece(id);
        if (piece.set != set) state.queue.flush(state.target_of(set, block));
        set = piece.set;
        state.gather_piece(piece, block);
        // which of two chords is the last must not depend on the other contents of the block
        if (last) state.queue.flush(state.target_of(set, block));
    }
    if (!pieces.empty()) state.queue.flush(state.target_of(set, block));
}

} // namespace heddle
