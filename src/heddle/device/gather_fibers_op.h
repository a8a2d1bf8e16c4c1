#pragma once

#include <heddle/base/offset_search.h>
#include <heddle/device/block_pairs_op.h>
#include <heddle/device/fiber_tables.h>
#include <heddle/device/level/dense_sums.h>
#include <heddle/voxelize/chord/chord_op.h>
#include <heddle/voxelize/chord/expand_op.h>
#include <heddle/voxelize/chord/fiber_chords.h>
#include <heddle/voxelize/chord/lanes_one.h>
#include <heddle/yarn/fiber_view.h>

#include <cstddef>
#include <cstdint>

namespace heddle {

/// A yarn's piece in a block, prepared for gathering.
struct YarnPair {
    LocalCubic cubic;
    YarnCourse course;
    std::uint64_t curve; ///< number in the set
    std::uint32_t set;
    std::uint32_t slot;
    std::int32_t chords; ///< number of chords of each fiber
};

/// The data that all ops on the fibers of a batch read.
struct FiberBatch {
    FiberView fibers;
    FiberTablesView tables;
    LatticeUnits units;
    DenseSums sums;

    [[nodiscard]] HEDDLE_HD ChordSpace space(std::uint32_t slot) const {
        return ChordSpace(units, sums.blocks[slot].size);
    }
    /// Adds a chord of any thickness to a block.
    /// @param anchor  voxel that the chord's positions are relative to
    HEDDLE_HD void add_chord(std::uint32_t slot,
                             const Chord& chord,
                             Vec3f bend,
                             Vec3i anchor,
                             const DenseLobe& to) const {
        const Vec3i relative = anchor - sums.blocks[slot].lo;
        if (chord.radius > kThickRadius) {
            gather_chord(to, units, sums.blocks[slot].size, chord, relative);
            return;
        }
        gather_chord_op(ThinChord{chord.start, chord.dir, bend, chord.length, chord.before,
                                  chord.after, chord.radius},
                        relative, space(slot), to);
    }
};

/// Gathers one piece of a single curve.
struct GatherPlainOp {
    FiberBatch batch;
    const BlockPair* pairs;

    HEDDLE_HD void operator()(std::size_t i) const {
        const FiberView& fibers = batch.fibers;
        const std::uint32_t slot = pairs[i].slot;
        const FiberPiece piece = fibers.piece(pairs[i].primitive);
        const CurveSetView& set = fibers.sets[piece.set];
        const LocalCubic cubic(piece.cubic, batch.units);
        DenseLobe to = batch.sums.lobe(slot, set.material);
        if (set.color != nullptr) to.color = set.color_of(piece);
        for_each_plain_chord(fibers, piece, cubic, batch.units,
                             AddChord{batch, slot, cubic.anchor, to});
    }

private:
    struct AddChord {
        const FiberBatch& batch;
        std::uint32_t slot;
        Vec3i anchor;
        const DenseLobe& to;
        HEDDLE_HD void operator()(const Chord& chord) const {
            batch.add_chord(slot, chord, {}, anchor, to);
        }
    };
};

/// Prepares one yarn's piece, and counts its frames, its runs of chords and the cells of its hairs.
struct PrepareYarnOp {
    FiberBatch batch;
    const BlockPair* pairs;
    YarnPair* yarns;
    std::uint32_t* frames; ///< per pair
    std::uint32_t* runs;
    std::uint32_t* hairs;

    HEDDLE_HD void operator()(std::size_t i) const {
        const FiberView& fibers = batch.fibers;
        const FiberPiece piece = fibers.piece(pairs[i].primitive);
        const CurveSetView& set = fibers.sets[piece.set];
        const LocalCubic cubic(piece.cubic, batch.units);
        const YarnCourse course = fibers.course(piece, batch.units.unit);
        const int count = yarn_chord_count(piece, cubic, course, section_of(set.yarn), batch.units);
        yarns[i] = {cubic, course, piece.curve, piece.set, pairs[i].slot, count};
        frames[i] = static_cast<std::uint32_t>(count + 3);
        const std::uint64_t* first =
            batch.tables.first + batch.tables.yarn_of_set[piece.set] + piece.curve;
        const auto tiles =
            static_cast<std::uint32_t>((count + FiberTile::kChords - 1) / FiberTile::kChords);
        runs[i] = tiles * static_cast<std::uint32_t>(first[1] - first[0]);
        hairs[i] = 0;
        if (!set.yarn.flyaways || !(set.yarn.hair_density > 0.0f)) return;
        const HairModel model(HairShape(set.yarn), course.total, course.closed);
        const std::int64_t cells = model.cells(course.start, course.start + course.length).count();
        if (cells > 0) hairs[i] = static_cast<std::uint32_t>(cells * ply_count(set.yarn));
    }
    [[nodiscard]] HEDDLE_HD static std::int32_t ply_count(const YarnView& yarn) {
        return yarn.model == YarnModel::Slice ? 1 : yarn.plies;
    }
};

/// Computes one frame of one yarn's piece. Frame g is at the start of chord g - 1.
struct FrameYarnOp {
    const YarnPair* yarns;
    const std::uint64_t* first_frame; ///< per pair, and the end
    std::size_t pairs;
    YarnFrame* frames;

    HEDDLE_HD void operator()(std::size_t i) const {
        const std::size_t p = range_of(first_frame, pairs, i);
        const YarnPair& yarn = yarns[p];
        const int g = static_cast<int>(i - first_frame[p]);
        const float t = static_cast<float>(g - 1) / static_cast<float>(yarn.chords);
        YarnFrame frame(yarn.cubic, yarn.course, t);
        frame.twist(yarn.course);
        frames[i] = frame;
    }
};

/// Gathers one fiber of one yarn's piece along one run of at most FiberTile::kChords chords.
struct GatherYarnOp {
    FiberBatch batch;
    const YarnPair* yarns;
    const std::uint64_t* first_run;   ///< per pair, and the end
    const std::uint64_t* first_frame; ///< per pair, and the end
    std::size_t pairs;
    const YarnFrame* frames;

    HEDDLE_HD void operator()(std::size_t i) const {
        const std::size_t p = range_of(first_run, pairs, i);
        const YarnPair& yarn = yarns[p];
        const FiberTablesView& tables = batch.tables;
        const std::uint64_t* first = tables.first + tables.yarn_of_set[yarn.set] + yarn.curve;
        const std::uint64_t fibers = first[1] - first[0];
        const std::uint64_t local = i - first_run[p];
        Run run;
        run.begin = static_cast<int>(local / fibers) * FiberTile::kChords;
        run.chords = yarn.chords - run.begin < FiberTile::kChords ? yarn.chords - run.begin
                                                                  : FiberTile::kChords;
        run.number = local % fibers;
        run.fiber = first[0] + run.number;
        run.frames = frames + first_frame[p] + run.begin;
        gather(yarn, run);
    }

private:
    using Real = one::Real;

    /// The part of one fiber that an item gathers.
    struct Run {
        int begin, chords;    ///< first chord in the piece, and number of chords
        std::uint64_t number; ///< number of the fiber in its yarn
        std::uint64_t fiber;  ///< number of the fiber in the tables
        const YarnFrame* frames;
    };

    HEDDLE_HD void gather(const YarnPair& yarn, const Run& run) const {
        const CurveSetView& set = batch.fibers.sets[yarn.set];
        DenseLobe to = batch.sums.lobe(yarn.slot, set.material);
        to.color = batch.tables.color[run.fiber];
        const float radius = batch.tables.set_fiber_radius[yarn.set];
        FiberSampler sampler(batch, yarn, run, set.yarn);
        LanePoint<Real> p0 = sampler.at(0);
        LanePoint<Real> p1 = sampler.at(1);
        ChordEnd<Real> from{};
        for (int j = 1; j <= run.chords + 1; ++j) {
            const LanePoint<Real> p2 = sampler.at(j + 1);
            const ChordEnd<Real> end = chord_end(p0, p1, p2);
            if (j > 1) {
                const float r0 = radius * run.frames[j - 1].scale;
                const float r1 = radius * run.frames[j].scale;
                add(chord_between(from, end, r0, r1), from.at, 0.5f * (r0 + r1), yarn, to);
            }
            from = end;
            p0 = p1;
            p1 = p2;
        }
    }

    HEDDLE_HD void add(const LaneChord<Real>& lane,
                       const LanePoint<Real>& start,
                       float radius,
                       const YarnPair& yarn,
                       const DenseLobe& to) const {
        const float length = lane.length.v;
        if (!(length > 0.0f)) return;
        const Chord chord{to_vec(start), to_vec(lane.dir), length,
                          lane.before.v, lane.after.v,     radius};
        batch.add_chord(yarn.slot, chord, to_vec(lane.bend), yarn.cubic.anchor, to);
    }
    HEDDLE_HD static Vec3f to_vec(const LanePoint<Real>& p) { return {p.x.v, p.y.v, p.z.v}; }

    /// Computes a fiber's positions at the samples of a run.
    class FiberSampler {
    public:
        HEDDLE_HD
        FiberSampler(const FiberBatch& batch,
                     const YarnPair& yarn,
                     const Run& run,
                     const YarnView& type)
            : run_(run), section_(section_of(type)), loops_(type) {
            const FiberTablesView& t = batch.tables;
            const std::uint64_t f = run.fiber;
            radius_ = t.radius[f];
            constants_ = {Real(radius_), Real(t.cos_angle[f]), Real(t.sin_angle[f]),
                          Real(t.cos_migration[f]), Real(t.sin_migration[f])};
            const std::uint64_t ply =
                type.model == YarnModel::Slice
                    ? 0
                    : run.number / static_cast<std::uint64_t>(type.fibers_per_ply);
            ply_ = t.ply[t.ply_of_set[yarn.set] + ply];
            with_loops_ = type.flyaways && type.loop_density > 0.0f;
            if (!with_loops_) return;
            turns_ = t.migration_turns[f];
            id_ = LoopModel::id(batch.fibers.seed + yarn.set, yarn.curve, run.number);
            const double t0 = static_cast<double>(run.begin - 1) / yarn.chords;
            const double t1 = t0 + static_cast<double>(run.chords + 2) / yarn.chords;
            s0_ = yarn.course.start + yarn.course.length * t0;
            s1_ = yarn.course.start + yarn.course.length * t1;
        }
        [[nodiscard]] HEDDLE_HD LanePoint<Real> at(int j) {
            const PlyFrame frame = run_.frames[j].of_ply(ply_);
            if (!with_loops_) return fiber_point<Real>(constants_, frame, section_, nullptr);
            const double phase = loops_.phase_at(s0_ + (s1_ - s0_) * j / (run_.chords + 2), turns_);
            const double ratio = memo_.ratio(loops_, id_, LoopModel::period_of(phase), radius_);
            const Real loop(LoopModel::factor(ratio, phase));
            return fiber_point(constants_, frame, section_, &loop);
        }

    private:
        const Run& run_;
        PlySection section_;
        LoopModel loops_;
        FiberConstants<Real> constants_{};
        SinCos ply_;
        LoopMemo memo_;
        double s0_ = 0.0, s1_ = 0.0; ///< yarn length at the first and last sample
        std::uint64_t id_ = 0;
        float radius_ = 0.0f, turns_ = 0.0f;
        bool with_loops_ = false;
    };
};

/// Gathers the hair flyaway, if any, of one cell of one ply of a yarn's piece.
struct GatherHairOp {
    FiberBatch batch;
    const YarnPair* yarns;
    const std::uint64_t* first_hair; ///< per pair, and the end
    std::size_t pairs;

    HEDDLE_HD void operator()(std::size_t i) const {
        const std::size_t p = range_of(first_hair, pairs, i);
        const YarnPair& yarn = yarns[p];
        const CurveSetView& set = batch.fibers.sets[yarn.set];
        const YarnCourse& course = yarn.course;
        const HairModel model(HairShape(set.yarn), course.total, course.closed);
        const double end = course.start + course.length;
        const HairModel::Cells cells = model.cells(course.start, end);
        const auto local = static_cast<std::int64_t>(i - first_hair[p]);
        const auto ply = static_cast<std::uint64_t>(local / cells.count());
        FlyawayHair hair;
        const HairPly of{batch.fibers.seed + yarn.set, yarn.curve, ply};
        if (!model.hair_of(cells.first + local % cells.count(), of, course.start, end, hair)) {
            return;
        }
        const SinCos base = batch.tables.ply[batch.tables.ply_of_set[yarn.set] + ply];
        const DenseLobe to = batch.sums.lobe(yarn.slot, set.material);
        HairPath{yarn.cubic,
                 course,
                 hair,
                 base,
                 set.yarn.ply_offset,
                 batch.tables.set_fiber_radius[yarn.set]}
            .for_each_chord(AddChord{batch, yarn, to});
    }

private:
    struct AddChord {
        const FiberBatch& batch;
        const YarnPair& yarn;
        const DenseLobe& to;
        HEDDLE_HD void operator()(const Chord& chord) const {
            batch.add_chord(yarn.slot, chord, {}, yarn.cubic.anchor, to);
        }
    };
};

} // namespace heddle
