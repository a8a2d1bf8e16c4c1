// No include guard: included once for each instruction set, HEDDLE_ISA.
// The fibers of a yarn, eight at once, from their table.

namespace heddle::HEDDLE_ISA {

inline void expand_sample(FiberTile& tile,
                          int sample,
                          std::size_t row,
                          const PlyPart& part,
                          const PlySection& section,
                          const FiberTable& table) {
    const PlyFrame at = part.frames[sample];
    float* const x = tile.x[sample] + row;
    float* const y = tile.y[sample] + row;
    float* const z = tile.z[sample] + row;
    for (std::size_t f = 0; f < part.end - part.begin; f += kLanes) {
        const std::size_t i = part.begin + f;
        const Real cos_angle = Real::load(table.cos_angle.data() + i);
        const Real sin_angle = Real::load(table.sin_angle.data() + i);
        const Real c = cos_angle * Real(at.fiber.cos) - sin_angle * Real(at.fiber.sin);
        const Real s = sin_angle * Real(at.fiber.cos) + cos_angle * Real(at.fiber.sin);
        const Real phase = Real::load(table.cos_migration.data() + i) * Real(at.migration.cos) -
                           Real::load(table.sin_migration.data() + i) * Real(at.migration.sin);
        Real r = Real::load(table.radius.data() + i) *
                 (Real(section.mean) + Real(section.amplitude) * phase);
        if (tile.loops) r = r * Real::load(tile.loop[sample] + row + f);
        const Real px = Real(section.offset) + Real(section.short_axis) * r * c;
        const Real py = Real(section.long_axis) * r * s;
        (Real(at.center.x) + px * Real(at.u.x) + py * Real(at.v.x)).store(x + f);
        (Real(at.center.y) + px * Real(at.u.y) + py * Real(at.v.y)).store(y + f);
        (Real(at.center.z) + px * Real(at.u.z) + py * Real(at.v.z)).store(z + f);
    }
}

struct Point {
    Real x, y, z;
    friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Point operator*(Point a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
    friend Real length_of(Point a) { return sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }
};

/// Chords between samples. Each sample is first moved outwards by a twelfth of its second difference:
/// a chord between points of the curve lies inside the bend, by 2/3 of its sagitta in the mean; so
/// moved, its mean distance from the curve is 0.
inline void make_chords(FiberTile& tile, int f) {
    const auto sample = [&](int j) {
        return Point{Real::load(tile.x[j] + f), Real::load(tile.y[j] + f),
                     Real::load(tile.z[j] + f)};
    };
    const Real outwards(1.0f / 12.0f);
    const Real half(0.5f);
    Point p0 = sample(0);
    Point p1 = sample(1);
    Point from{};
    Point bend_from{};
    for (int j = 1; j <= tile.chords + 1; ++j) {
        const Point p2 = sample(j + 1);
        const Point bend = (p2 - p1) - (p1 - p0);
        const Point at = p1 - bend * outwards;
        at.x.store(tile.x[j] + f);
        at.y.store(tile.y[j] + f);
        at.z.store(tile.z[j] + f);
        if (j > 1) {
            const int c = j - 2;
            const Point d = at - from;
            const Real length = length_of(d);
            const Real inv = select(Real(0.0f) < length, Real(1.0f) / length, Real(0.0f));
            const Point mean = (bend + bend_from) * (half * inv);
            (d.x * inv).store(tile.dx[c] + f);
            (d.y * inv).store(tile.dy[c] + f);
            (d.z * inv).store(tile.dz[c] + f);
            length.store(tile.length[c] + f);
            mean.x.store(tile.bx[c] + f);
            mean.y.store(tile.by[c] + f);
            mean.z.store(tile.bz[c] + f);
            // the wedge that a turn by |bend| / length opens on the outer side of each joint
            const Real wedge = half * inv;
            (length_of(bend_from) * (wedge * Real(tile.radius[j - 1]))).store(tile.before[c] + f);
            (length_of(bend) * (wedge * Real(tile.radius[j]))).store(tile.after[c] + f);
        }
        from = at;
        bend_from = bend;
        p0 = p1;
        p1 = p2;
    }
}

void expand(FiberTile& tile,
            std::span<const PlyPart> parts,
            const PlySection& section,
            const FiberTable& table) {
    for (int j = 0; j < tile.chords + 3; ++j) {
        std::size_t row = 0;
        for (const PlyPart& part :
             parts) { // a part's last lanes are overwritten by the next's first
            expand_sample(tile, j, row, part, section, table);
            row += part.end - part.begin;
        }
    }
    for (int f = 0; f < tile.fibers; f += kLanes) make_chords(tile, f);
    for (int f = tile.fibers; f % kLanes != 0; ++f) {
        for (int c = 0; c < tile.chords; ++c) tile.length[c][f] = 0.0f; // no chord
    }
}

} // namespace heddle::HEDDLE_ISA
