#include <heddle/voxel/gather_fibers.h>

#include <heddle/base/trig.h>
#include <heddle/voxel/flyaway.h>
#include <heddle/voxel/gather_thin.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace heddle {
namespace {

constexpr int kTile = 64;   ///< fibers expanded at once
constexpr int kChords = 16; ///< chords expanded at once
constexpr int kSamples = kChords + 3;

/// Cross-section frame of one ply at one sample, units: a fiber lies at center + x u + y v.
struct PlyFrame {
    Vec3f center, u, v;
    SinCos fiber, migration; ///< turned by so much since the yarn's start
    float radius = 0;        ///< of a fiber, units
};

/// A tile of fibers at the samples of one run of chords.
struct Tile {
    int fibers = 0;
    int chords = 0;
    /// Samples: one before the first chord, and one after the last, for the second differences.
    alignas(64) float x[kSamples][kTile], y[kSamples][kTile], z[kSamples][kTile];
    alignas(64) float dx[kChords][kTile], dy[kChords][kTile], dz[kChords][kTile];
    alignas(64) float length[kChords][kTile];
    alignas(64) float bend[kChords + 1][kTile]; ///< |difference of directions| / 2 at each joint
    alignas(64) float loop[kSamples][kTile]; ///< factor of the distance from the ply's axis
    float radius[kSamples];
};

/// Shape of a ply's section: what all fibers of a yarn share.
struct Section {
    float offset, short_axis, long_axis;
    float mean, amplitude; ///< migrating radius = R (mean + amplitude cos phase)
};

Section section_of(const YarnType& yarn) {
    if (yarn.model == YarnModel::Slice) {
        return {0.0f, yarn.model_radius, yarn.model_radius, 1.0f, 0.0f};
    }
    Section s{yarn.ply_offset, yarn.ellipse_short, yarn.ellipse_long, 1.0f, 0.0f};
    if (yarn.migration) {
        s.mean = 0.5f * (yarn.migration_max + yarn.migration_min);
        s.amplitude = 0.5f * (yarn.migration_max - yarn.migration_min);
    }
    return s;
}

HEDDLE_INLINE void expand_sample(Tile& tile,
                                 int sample,
                                 const PlyFrame& at,
                                 const Section& section,
                                 const FiberTable& table,
                                 std::size_t first) {
    const float* __restrict radius = table.radius.data() + first;
    const float* __restrict cos_angle = table.cos_angle.data() + first;
    const float* __restrict sin_angle = table.sin_angle.data() + first;
    const float* __restrict cos_phase = table.cos_migration.data() + first;
    const float* __restrict sin_phase = table.sin_migration.data() + first;
    for (int f = 0; f < tile.fibers; ++f) {
        const float c = cos_angle[f] * at.fiber.cos - sin_angle[f] * at.fiber.sin;
        const float s = sin_angle[f] * at.fiber.cos + cos_angle[f] * at.fiber.sin;
        const float phase = cos_phase[f] * at.migration.cos - sin_phase[f] * at.migration.sin;
        const float r =
            radius[f] * (section.mean + section.amplitude * phase) * tile.loop[sample][f];
        const float px = section.offset + section.short_axis * r * c;
        const float py = section.long_axis * r * s;
        tile.x[sample][f] = at.center.x + px * at.u.x + py * at.v.x;
        tile.y[sample][f] = at.center.y + px * at.u.y + py * at.v.y;
        tile.z[sample][f] = at.center.z + px * at.u.z + py * at.v.z;
    }
}

/// Moves every sample outwards by a twelfth of its second difference: a chord between samples lies
/// inside the bend, by 2/3 of its sagitta in the mean; so moved, its mean distance is 0.
HEDDLE_INLINE void balance_samples(Tile& tile) {
    const auto balance = [&](float (&p)[kSamples][kTile]) __attribute__((always_inline)) {
        for (int f = 0; f < tile.fibers; ++f) {
            float before = p[0][f];
            for (int j = 1; j <= tile.chords + 1; ++j) {
                const float here = p[j][f];
                p[j][f] = here - (1.0f / 12.0f) * (before - 2.0f * here + p[j + 1][f]);
                before = here;
            }
        }
    };
    balance(tile.x);
    balance(tile.y);
    balance(tile.z);
}

HEDDLE_INLINE void direct_chords(Tile& tile) {
    for (int j = 0; j < tile.chords; ++j) {
        for (int f = 0; f < tile.fibers; ++f) {
            const float x = tile.x[j + 2][f] - tile.x[j + 1][f];
            const float y = tile.y[j + 2][f] - tile.y[j + 1][f];
            const float z = tile.z[j + 2][f] - tile.z[j + 1][f];
            const float length = std::sqrt(x * x + y * y + z * z);
            const float inv = length > 0.0f ? 1.0f / length : 0.0f;
            tile.dx[j][f] = x * inv;
            tile.dy[j][f] = y * inv;
            tile.dz[j][f] = z * inv;
            tile.length[j][f] = length;
        }
    }
    for (int j = 1; j < tile.chords; ++j) {
        for (int f = 0; f < tile.fibers; ++f) {
            const float x = tile.dx[j][f] - tile.dx[j - 1][f];
            const float y = tile.dy[j][f] - tile.dy[j - 1][f];
            const float z = tile.dz[j][f] - tile.dz[j - 1][f];
            tile.bend[j][f] = 0.5f * std::sqrt(x * x + y * y + z * z);
        }
    }
    for (int f = 0; f < tile.fibers; ++f) { // the curve is smooth: its ends bend as its middle does
        tile.bend[0][f] = tile.chords > 1 ? tile.bend[1][f] : 0.0f;
        tile.bend[tile.chords][f] = tile.chords > 1 ? tile.bend[tile.chords - 1][f] : 0.0f;
    }
}

/// Where the chords of a piece go.
struct Target {
    BlockSums& block;
    const LatticeUnits& units;
    int shift; ///< log2 of the subvoxels per axis
    Vec3i anchor; ///< relative to the block's lo
    Vec3i size;
    FiberPaint paint;
};

HEDDLE_INLINE void gather_any(const Target& t, const Chord& chord, const FiberPaint& paint) {
    if (chord.radius > kThickRadius) {
        gather_chord(t.block, t.units, chord, t.anchor, t.size, paint);
    } else {
        gather_thin(t.block, t.units, t.shift, chord, t.anchor, t.size, paint);
    }
}

HEDDLE_CLONES void gather_tile(Tile& tile,
                               const PlyFrame* frames,
                               const Section& section,
                               const FiberTable& table,
                               std::size_t first,
                               const Target& target) {
    for (int j = 0; j < tile.chords + 3; ++j) {
        expand_sample(tile, j, frames[j], section, table, first);
        tile.radius[j] = frames[j].radius;
    }
    balance_samples(tile);
    direct_chords(tile);
    FiberPaint paint = target.paint;
    for (int j = 0; j < tile.chords; ++j) {
        const float radius = 0.5f * (tile.radius[j + 1] + tile.radius[j + 2]);
        for (int f = 0; f < tile.fibers; ++f) {
            if (!(tile.length[j][f] > 0.0f)) continue;
            const Chord chord{{tile.x[j + 1][f], tile.y[j + 1][f], tile.z[j + 1][f]},
                              {tile.dx[j][f], tile.dy[j][f], tile.dz[j][f]},
                              tile.length[j][f],
                              radius * tile.bend[j][f],
                              radius * tile.bend[j + 1][f],
                              radius};
            paint.color = table.color[first + static_cast<std::size_t>(f)];
            gather_any(target, chord, paint);
        }
    }
}

HEDDLE_CLONES void gather_run(std::span<const Chord> chords, const Target& target) {
    for (const Chord& chord : chords) {
        gather_any(target, chord, target.paint);
    }
}

/// A piece's cubic in units, relative to the corner of its anchor voxel.
struct LocalCubic {
    Vec3i anchor; ///< voxel index
    Vec3f c[4];

    LocalCubic(const Cubic& cubic, const LatticeUnits& u) {
        for (int a = 0; a < 3; ++a) {
            anchor[a] = static_cast<std::int32_t>(std::floor(cubic.c[0][a] / u.voxel_size[a]));
            const double corner = anchor[a] * u.voxel_size[a];
            c[0][a] = static_cast<float>((cubic.c[0][a] - corner) / u.unit);
            for (int i = 1; i < 4; ++i) c[i][a] = static_cast<float>(cubic.c[i][a] / u.unit);
        }
    }
    [[nodiscard]] Vec3f at(float t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
    [[nodiscard]] Vec3f derivative(float t) const {
        return c[1] + t * (2.0f * c[2] + (3.0f * t) * c[3]);
    }
    [[nodiscard]] Vec3f second_derivative(float t) const {
        return 2.0f * c[2] + (6.0f * t) * c[3];
    }
    /// Largest |P''|: linear in t, so at one of the ends.
    [[nodiscard]] float bend() const {
        return std::max(length(second_derivative(0.0f)), length(second_derivative(1.0f)));
    }
};

/// Chords that keep within kChordSagitta of a curve with |P''| <= bend, and within a voxel's edge.
int chord_count(double bend, double length, const LatticeUnits& u) {
    const double by_bend = std::sqrt(bend / (8.0 * kChordSagitta));
    const double by_length = length / std::max(2.0, static_cast<double>(u.n));
    return static_cast<int>(std::clamp(std::ceil(std::max(by_bend, by_length)), 1.0, 4096.0));
}

} // namespace

struct FiberGatherer::State {
    const FiberSource& source;
    const VoxelizeOptions& options;
    FiberTable table; ///< of the yarn below
    std::uint32_t table_set = ~0u;
    std::uint64_t table_curve = ~std::uint64_t{0};
    Tile tile;
    std::vector<Chord> chords;

    void gather_piece(const FiberPiece& piece, BlockSums& block);
    void gather_plain(const FiberPiece& piece, const LocalCubic& cubic, Target& target);
    void gather_yarn(const FiberPiece& piece, const LocalCubic& cubic, Target& target);
    void gather_ply(std::size_t ply, const Section& section, const LocalCubic& cubic,
                    const YarnCourse& course, int chords_in_piece, Target& target,
                    const YarnType& yarn);
    void gather_hairs(const YarnType& yarn, const LocalCubic& cubic, const YarnCourse& course,
                      Target& target);
    void set_loops(const YarnType& yarn, std::size_t first, int sample, double s);
    [[nodiscard]] PlyFrame frame_at(const LocalCubic& cubic, const YarnCourse& course,
                                    std::size_t ply, float t) const;
};

PlyFrame FiberGatherer::State::frame_at(const LocalCubic& cubic,
                                        const YarnCourse& course,
                                        std::size_t ply,
                                        float t) const {
    const Vec3f tangent = normalize(cubic.derivative(t));
    const Vec3f lerped = course.normal0 * (1.0f - t) + course.normal1 * t;
    const Vec3f normal = normalize(lerped - dot(lerped, tangent) * tangent,
                                   any_perpendicular(tangent));
    const Vec3f binormal = cross(tangent, normal);
    const float scale = course.scale0 * (1.0f - t) + course.scale1 * t;
    const double s = course.start + course.length * static_cast<double>(t);
    const double closing = course.total > 0.0 ? course.closing_turns * s / course.total : 0.0;
    const SinCos yarn = sincos_turns(course.turns_per_length[0] * s + closing);
    const float c = (table.ply_cos[ply] * yarn.cos - table.ply_sin[ply] * yarn.sin) * scale;
    const float sn = (table.ply_sin[ply] * yarn.cos + table.ply_cos[ply] * yarn.sin) * scale;
    return {cubic.at(t),
            c * normal + sn * binormal,
            c * binormal - sn * normal,
            sincos_turns(course.turns_per_length[1] * s),
            sincos_turns(course.turns_per_length[2] * s),
            table.fiber_radius * scale};
}

void FiberGatherer::State::gather_piece(const FiberPiece& piece, BlockSums& block) {
    const CurveSet& set = source.geometry().curves[piece.set];
    const LocalCubic cubic(piece.cubic, source.units());
    Target target{block, source.units(), std::countr_zero(static_cast<unsigned>(source.units().n)),
                  cubic.anchor - block.lo(), block.hi() - block.lo(),
                  {.material = set.material, .last = options.fit == FitMode::Last}};
    const YarnType* yarn = source.yarn_of(piece.set);
    if (yarn == nullptr || yarn->model == YarnModel::Solid) {
        gather_plain(piece, cubic, target);
    } else {
        gather_yarn(piece, cubic, target);
    }
}

namespace {

/// |difference of directions| / 2 between a linear span's end and its neighbour; 0 at a free end.
float joint_bend(const CurveSet& set, const FiberPiece& piece, bool end) {
    if (set.basis != Basis::Linear) return 0.0f;
    const std::size_t spans = set.span_count(piece.curve);
    const bool closed = set.is_closed(piece.curve);
    if (end ? piece.part + 1 < piece.parts : piece.part > 0) return 0.0f;
    if (!closed && (end ? piece.span + 1 == spans : piece.span == 0)) return 0.0f;
    const std::size_t other = end ? (piece.span + 1) % spans : (piece.span + spans - 1) % spans;
    const Vec3d d = normalize(span_cubic(set, piece.curve, other).c[1]) - normalize(piece.cubic.c[1]);
    return static_cast<float>(0.5 * length(d));
}

} // namespace

void FiberGatherer::State::gather_plain(const FiberPiece& piece,
                                        const LocalCubic& cubic,
                                        Target& target) {
    const CurveSet& set = source.geometry().curves[piece.set];
    const YarnCourse course = source.course(piece);
    const int count = chord_count(static_cast<double>(cubic.bend()),
                                  piece.cubic.polygon_length() / source.units().unit, source.units());
    if (!set.color.empty()) {
        const std::size_t skip = set.basis == Basis::Linear || set.is_closed(piece.curve) ? 0 : 1;
        target.paint.color = set.color[set.first[piece.curve] + piece.span + skip];
    }
    chords.clear();
    // moved outwards as in balance_samples
    const float twelfth = 1.0f / (12.0f * static_cast<float>(count) * static_cast<float>(count));
    const auto sample = [&](float t) { return cubic.at(t) - twelfth * cubic.second_derivative(t); };
    Vec3f from = sample(0.0f);
    for (int j = 0; j < count; ++j) {
        const float t1 = static_cast<float>(j + 1) / static_cast<float>(count);
        const float tm = (static_cast<float>(j) + 0.5f) / static_cast<float>(count);
        const Vec3f to = sample(t1);
        const Vec3f d = to - from;
        const float len = length(d);
        if (len > 0.0f) {
            const float radius = course.scale0 * (1.0f - tm) + course.scale1 * tm;
            chords.push_back({from, d * (1.0f / len), len, 0.0f, 0.0f, std::max(radius, 1e-6f)});
            from = to;
        }
    }
    for (std::size_t j = 1; j < chords.size(); ++j) {
        const float bend = 0.5f * length(chords[j].dir - chords[j - 1].dir);
        chords[j - 1].after = bend * chords[j - 1].radius;
        chords[j].before = bend * chords[j].radius;
    }
    if (!chords.empty()) {
        chords.front().before = chords.front().radius * joint_bend(set, piece, false);
        chords.back().after = chords.back().radius * joint_bend(set, piece, true);
    }
    gather_run(chords, target);
}

void FiberGatherer::State::gather_yarn(const FiberPiece& piece,
                                       const LocalCubic& cubic,
                                       Target& target) {
    const YarnType& yarn = *source.yarn_of(piece.set);
    if (table_set != piece.set || table_curve != piece.curve) {
        table = place_fibers(yarn, source.seed() + piece.set, piece.curve);
        table_set = piece.set;
        table_curve = piece.curve;
    }
    const YarnCourse course = source.course(piece);
    const Section section = section_of(yarn);
    // |P''| of a helix of radius r that turns by w over the piece is r w^2
    const double turn0 = 6.2831853 * std::abs(course.turns_per_length[0]) * course.length;
    const double turn1 = 6.2831853 * std::abs(course.turns_per_length[1]) * course.length;
    const double turn2 = 6.2831853 * std::abs(course.turns_per_length[2]) * course.length;
    const double scale = static_cast<double>(std::max(course.scale0, course.scale1));
    const double axis = static_cast<double>(std::max(section.short_axis, section.long_axis));
    const double all = turn0 + turn1 + (section.amplitude > 0.0f ? turn2 : 0.0);
    const double bend = static_cast<double>(cubic.bend()) +
                        scale * (static_cast<double>(section.offset) * turn0 * turn0 + axis * all * all);
    const int count = chord_count(bend, piece.cubic.polygon_length() / source.units().unit,
                                  source.units());
    for (std::size_t ply = 0; ply + 1 < table.first_of_ply.size(); ++ply) {
        gather_ply(ply, section, cubic, course, count, target, yarn);
    }
    if (yarn.flyaways && yarn.hair_density > 0.0f) gather_hairs(yarn, cubic, course, target);
}

void FiberGatherer::State::gather_ply(std::size_t ply,
                                      const Section& section,
                                      const LocalCubic& cubic,
                                      const YarnCourse& course,
                                      int chords_in_piece,
                                      Target& target,
                                      const YarnType& yarn) {
    const bool loops = yarn.flyaways && yarn.loop_density > 0.0f;
    std::array<PlyFrame, kSamples> frames;
    for (int j0 = 0; j0 < chords_in_piece; j0 += kChords) {
        tile.chords = std::min(kChords, chords_in_piece - j0);
        for (int j = 0; j < tile.chords + 3; ++j) {
            const float t = static_cast<float>(j0 + j - 1) / static_cast<float>(chords_in_piece);
            frames[static_cast<std::size_t>(j)] = frame_at(cubic, course, ply, t);
        }
        const std::size_t end = table.first_of_ply[ply + 1];
        for (std::size_t first = table.first_of_ply[ply]; first < end; first += kTile) {
            tile.fibers = static_cast<int>(std::min<std::size_t>(kTile, end - first));
            for (int j = 0; j < tile.chords + 3; ++j) {
                std::fill_n(tile.loop[j], tile.fibers, 1.0f);
                const double t = static_cast<double>(j0 + j - 1) / chords_in_piece;
                if (loops) set_loops(yarn, first, j, course.start + course.length * t);
            }
            gather_tile(tile, frames.data(), section, table, first, target);
        }
    }
}

void FiberGatherer::State::set_loops(const YarnType& yarn, std::size_t first, int sample, double s) {
    const double turns_at = static_cast<double>(yarn.migration_frequency) * s /
                            static_cast<double>(yarn.fiber_pitch);
    const LoopModel model(yarn);
    for (int f = 0; f < tile.fibers; ++f) {
        const std::size_t i = first + static_cast<std::size_t>(f);
        const double phase = turns_at + static_cast<double>(table.migration_turns[i]);
        tile.loop[sample][f] =
            model.factor(source.seed() + table_set, table_curve, i, phase, table.radius[i]);
    }
}

void FiberGatherer::State::gather_hairs(const YarnType& yarn,
                                        const LocalCubic& cubic,
                                        const YarnCourse& course,
                                        Target& target) {
    const HairModel model(yarn, course.total, course.closed);
    for (std::size_t ply = 0; ply + 1 < table.first_of_ply.size(); ++ply) {
        model.for_each(source.seed() + table_set, table_curve, ply, course.start,
                       course.start + course.length, [&](const FlyawayHair& hair) {
            const double dt = hair.t1 - hair.t0;
            const double size = static_cast<double>(course.scale0) *
                                (std::abs(hair.ze) + std::abs(hair.re) +
                                 std::abs(hair.pe) * (hair.r0 + std::abs(hair.re)));
            const int count = std::clamp(static_cast<int>(std::ceil(size * dt / 4.0)), 1, 64);
            chords.clear();
            Vec3f from;
            for (int j = 0; j <= count; ++j) {
                const double q = hair.t0 + dt * j / count;
                const double s = hair.z0 + hair.ze * q;
                const auto t = static_cast<float>((s - course.start) / course.length);
                const PlyFrame at = frame_at(cubic, course, ply, t);
                const SinCos turn = sincos_turns((hair.p0 + hair.pe * q) / 6.283185307179586);
                const auto r = static_cast<float>(hair.r0 + hair.re * q);
                const Vec3f to = at.center + (yarn.ply_offset + r * turn.cos) * at.u +
                                 (r * turn.sin) * at.v;
                const float len = length(to - from);
                if (j > 0 && len > 0.0f) {
                    chords.push_back({from, (to - from) * (1.0f / len), len, 0.0f, 0.0f, at.radius});
                }
                from = to;
            }
            gather_run(chords, target);
        });
    }
}

FiberGatherer::FiberGatherer(const FiberSource& source, const VoxelizeOptions& options)
    : state_(new State{.source = source, .options = options, .table = {}, .tile = {}, .chords = {}}) {}

FiberGatherer::~FiberGatherer() = default;

void FiberGatherer::gather(std::span<const PieceId> pieces,
                           BlockSums& block,
                           const Progress& progress) {
    std::size_t done = 0;
    for (const PieceId id : pieces) {
        if (done++ % 64 == 0) progress.check();
        state_->gather_piece(
            state_->source.piece(id >> 16, static_cast<std::uint32_t>(id & 0xffff)), block);
    }
}

} // namespace heddle
