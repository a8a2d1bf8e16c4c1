// Prints, as markdown, the error that packing an SGGX into 6 bytes adds, by the width of the lobe.

#include <heddle/sggx/moments.h>
#include <heddle/sggx/pack.h>
#include <heddle/sggx/test_lobe.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace {

using namespace heddle;

constexpr int kLobes = 20000;

struct Row {
    double moment = 0.0, worst_moment = 0.0;        // error of M's entries
    double before_least = 0.0, before_middle = 0.0; // sigma
    double after_least = 0.0, after_middle = 0.0;   // decoded
    double area = 0.0, worst_area = 0.0;            // error of sigma(w)
    int indefinite = 0; // lobes that the paper's bytes decode to an eigenvalue <= 0
};

std::uint8_t round_byte(double x) {
    return static_cast<std::uint8_t>(std::floor(std::min(255.0, std::max(0.0, x)) + 0.5));
}

/// True if the paper's bytes, rounded to nearest and linear in r, decode to a positive definite S.
bool is_plainly_definite(const SggxMatrix& S) {
    const Vec3d diagonal = to_double({S.xx, S.yy, S.zz});
    const Vec3d s{std::sqrt(diagonal.x), std::sqrt(diagonal.y), std::sqrt(diagonal.z)};
    const Vec3d off = to_double({S.xy, S.xz, S.yz});
    const Vec3d r{off.x / (s.x * s.y), off.y / (s.x * s.z), off.z / (s.y * s.z)};
    double c[3];
    for (int i = 0; i < 3; ++i) {
        if (round_byte(255.0 * s[i]) == 0) return false;
        c[i] = 2.0 * round_byte(127.5 * (1.0 + r[i])) / 255.0 - 1.0;
        if (c[i] * c[i] >= 1.0) return false;
    }
    return 1.0 + 2.0 * c[0] * c[1] * c[2] - c[0] * c[0] - c[1] * c[1] - c[2] * c[2] > 1e-12;
}

void add(Row& row, const SggxMatrix& S, CounterRandom& random) {
    const PackedSggx p = pack(S);
    const SggxMatrix back = unpack(p);
    const SymmetricEigen e = decompose(back);
    const double error = test::difference(second_moment_of(back), second_moment_of(S));
    row.moment += error / kLobes;
    row.worst_moment = std::max(row.worst_moment, error);
    row.after_middle += std::sqrt(e.value[1]) / kLobes;
    row.after_least += std::sqrt(e.value[2]) / kLobes;
    const SymmetricEigen before = decompose(S);
    row.before_middle = std::sqrt(before.value[1]);
    row.before_least = std::sqrt(before.value[2]);
    const Vec3f w = to_float(test::random_direction(random));
    const double area = std::fabs(projected_area(back, w) - projected_area(S, w));
    row.area += area / kLobes;
    row.worst_area = std::max(row.worst_area, area);

    row.indefinite += is_plainly_definite(S) ? 0 : 1;
}

void print(const char* shape, double least, const Row& row) {
    std::printf("| %s | %g | %.4f / %.4f | %.4f / %.4f | %.1e | %.1e | %.1e | %.1e | %.1f %% |\n",
                shape, least, row.before_middle, row.before_least, row.after_middle,
                row.after_least, row.moment, row.worst_moment, row.area, row.worst_area,
                100.0 * row.indefinite / kLobes);
}

} // namespace

int main() {
    std::printf(
        "# What packing an SGGX into 6 bytes costs\n\n"
        "Made by `build/release/bench/heddle_sggx_packing > bench/results/sggx_packing.md`\n"
        "(`cmake --preset release -DHEDDLE_BENCH=ON`). %d lobes a row on random axes; s is\n"
        "the ratio of sigmas, largest 1, before S is normalized. M: largest error of an entry\n"
        "of the second moment. Area: error of sigma(w) along a random direction. Plain: share of\n"
        "lobes that the paper's bytes, rounded to nearest, leave without a positive definite S;\n"
        "here all are definite.\n\n"
        "| shape | s | sigma, middle / least | decoded | M mean | M worst | area mean "
        "| area worst | plain |\n|---|---|---|---|---|---|---|---|---|\n",
        kLobes);
    CounterRandom random{5, 1};
    for (const double least : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5}) {
        struct Shape {
            const char* name;
            Vec3d sigma;
        };
        for (const Shape& shape :
             {Shape{"needle (1, s, s)", {1, least, least}}, Shape{"disc (1, 1, s)", {1, 1, least}},
              Shape{"mixed (1, sqrt s, s)", {1, std::sqrt(least), least}}}) {
            Row row;
            for (int i = 0; i < kLobes; ++i)
                add(row, test::random_sggx(shape.sigma, random), random);
            print(shape.name, least, row);
        }
    }
}
