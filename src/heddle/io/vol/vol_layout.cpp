#include <heddle/io/vol/vol_layout.h>

#include <heddle/base/error.h>
#include <heddle/io/vol/block_set.h>
#include <heddle/io/vol/vol_dictionary.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <tuple>

namespace heddle {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxSamples = std::int64_t{1} << 30;

std::string show(Vec3i v) {
    return str(v.x, " ", v.y, " ", v.z);
}

bool begins_with_vol(const std::string& path) {
    const InputFile file(path);
    char magic[3]{};
    if (file.size_bytes() >= sizeof magic) file.read_at(0, magic, sizeof magic);
    return std::memcmp(magic, "VOL", sizeof magic) == 0;
}

/// Half a unit in the last place of a float: the largest rounding error of a bound.
double rounding_of(double bound) {
    const auto f = static_cast<float>(std::fabs(bound));
    return 0.5 * (double{std::nextafter(f, std::numeric_limits<float>::infinity())} - double{f});
}

/// The number with the fewest digits within `tolerance` of `x`.
double shortest_near(double x, double tolerance) {
    for (int digits = 1; digits < 17; ++digits) {
        char text[40];
        std::snprintf(text, sizeof text, "%.*g", digits, x);
        const double rounded = std::strtod(text, nullptr);
        if (rounded > 0.0 && std::fabs(rounded - x) <= tolerance) return rounded;
    }
    return x;
}

Vec3d find_pitch(const Bounds& bounds, Vec3i samples) {
    Vec3d pitch, tolerance;
    double lo = 0.0;
    double hi = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
        const double n = samples[a] - 1;
        pitch[a] = (bounds.hi[a] - bounds.lo[a]) / n;
        tolerance[a] = (rounding_of(bounds.lo[a]) + rounding_of(bounds.hi[a])) / n;
        lo = std::max(lo, pitch[a] - tolerance[a]);
        hi = std::min(hi, pitch[a] + tolerance[a]);
    }
    if (lo <= hi) {
        const double edge = shortest_near(0.5 * (lo + hi), 0.5 * (hi - lo));
        return {edge, edge, edge};
    }
    for (int a = 0; a < 3; ++a) pitch[a] = shortest_near(pitch[a], tolerance[a]);
    return pitch;
}

void expect_size(const VolFile& file, Vec3i size, const char* whose) {
    const Vec3i n = file.header().size;
    if (n == size) return;
    file.fail(8, str("has ", show(n), " samples, ", whose, " has ", show(size)),
              "export the volume again");
}

/// @param tolerance  scene units per axis
void expect_bounds(const VolFile& file, const Bounds& bounds, Vec3d tolerance, const char* whose) {
    for (int a = 0; a < 3; ++a) {
        const double lo = file.header().bounds.lo[a];
        const double hi = file.header().bounds.hi[a];
        if (std::fabs(lo - bounds.lo[a]) <= tolerance[a] &&
            std::fabs(hi - bounds.hi[a]) <= tolerance[a]) {
            continue;
        }
        file.fail(24 + 4 * static_cast<std::uint64_t>(a),
                  str("reaches from ", lo, " to ", hi, " along ", "xyz"[a], ", ", whose, " from ",
                      bounds.lo[a], " to ", bounds.hi[a]),
                  "it belongs to another volume; export the volume again");
    }
}

/// A sixteenth of a pitch: accepts floats that were computed differently, rejects another position.
Vec3d bounds_tolerance(Vec3d pitch) {
    return pitch * (1.0 / 16.0);
}

VolLayout find_grid(const std::string& path, std::string orientation) {
    VolLayout out;
    out.name = fs::path(path).stem().string();
    const VolFile density(path);
    expect_density(density);
    out.bounds = density.header().bounds;
    out.block_samples = density.header().size;
    out.pitch = find_pitch(out.bounds, out.block_samples);
    out.density_encoding = density.header().encoding;
    if (orientation.empty()) {
        std::string name = fs::path(path).filename().string();
        const std::size_t word = name.find("density");
        if (word != std::string::npos) {
            name.replace(word, std::strlen("density"), "orientation");
            const fs::path beside = fs::path(path).parent_path() / name;
            if (fs::exists(beside)) orientation = beside.string();
        }
    } else if (orientation == "none") {
        orientation.clear();
    }
    if (!orientation.empty()) {
        const VolFile directions(orientation);
        expect_directions(directions);
        expect_size(directions, out.block_samples, "the density");
        expect_bounds(directions, out.bounds, bounds_tolerance(out.pitch), "the density");
        out.orientation_encoding = directions.header().encoding;
    }
    out.blocks = {{{}, path, orientation}};
    return out;
}

void check_block(const VolLayout& layout, Vec3i at, const VolFile& file) {
    Bounds expected;
    for (int a = 0; a < 3; ++a) {
        const double edge = (layout.bounds.hi[a] - layout.bounds.lo[a]) / layout.cells[a];
        expected.lo[a] = layout.bounds.lo[a] + edge * at[a];
        expected.hi[a] = layout.bounds.lo[a] + edge * (at[a] + 1);
    }
    expect_size(file, layout.block_samples, "the first block");
    expect_bounds(file, expected, bounds_tolerance(layout.pitch), "its place in the dictionary");
}

void check_sample_count(const std::string& path, const VolLayout& layout) {
    for (int a = 0; a < 3; ++a) {
        const std::int64_t n = std::int64_t{layout.cells[a]} * (layout.block_samples[a] - 1) + 1;
        if (n <= kMaxSamples) continue;
        throw Error(ErrorCode::BadFile,
                    str(n, " samples along ", "xyz"[a], ", at most 2^30 are allowed"),
                    "export the volume again", {.path = path, .offset = 24 + 4 * a});
    }
}

void check_blocks(const VolLayout& layout) {
    for (const VolBlock& block : layout.blocks) {
        const VolFile density(block.density);
        expect_density(density);
        check_block(layout, block.at, density);
        if (block.orientation.empty()) continue;
        const VolFile directions(block.orientation);
        expect_directions(directions);
        check_block(layout, block.at, directions);
    }
}

VolLayout find_hierarchy(const std::string& path, const std::string& orientation) {
    const VolDictionary dictionary = read_vol_dictionary(path);
    const VolSets sets = find_vol_sets(path, dictionary, orientation);
    VolLayout out;
    out.name = fs::path(path).stem().string();
    out.hierarchical = true;
    out.bounds = dictionary.bounds;
    out.cells = dictionary.cells;
    const VolFile first(sets.density.path_of(dictionary.blocks.front()));
    out.block_samples = first.header().size;
    check_sample_count(path, out);
    out.pitch = find_pitch(out.bounds, out.samples());
    out.density_encoding = first.header().encoding;
    for (const Vec3i at : dictionary.blocks) {
        out.blocks.push_back({at, sets.density.path_of(at),
                              sets.orientation ? sets.orientation->path_of(at) : std::string()});
    }
    check_blocks(out); // in the order of the dictionary
    if (sets.orientation) {
        out.orientation_encoding = VolFile(out.blocks.front().orientation).header().encoding;
    }
    std::sort(out.blocks.begin(), out.blocks.end(), [](const VolBlock& a, const VolBlock& b) {
        return std::tuple(a.at.x, a.at.y, a.at.z) < std::tuple(b.at.x, b.at.y, b.at.z);
    });
    return out;
}

} // namespace

VolLayout find_vol_layout(const std::string& path, const std::string& orientation) {
    return begins_with_vol(path) ? find_grid(path, orientation) : find_hierarchy(path, orientation);
}

} // namespace heddle
