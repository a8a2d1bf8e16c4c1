#include <heddle/io/vol/write_mitsuba06.h>

#include <heddle/base/error.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/vol/vol_dictionary.h>
#include <heddle/sggx/eigen.h>
#include <heddle/sggx/pack.h>
#include <heddle/voxel/leaf_voxels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <tuple>
#include <vector>

namespace heddle {
namespace {

constexpr std::int64_t kMaxSamples = std::int64_t{1} << 31; ///< samples of a block
constexpr std::int32_t kMaxBlocks = 999;                    ///< three digits in a file's name
constexpr std::uint8_t kNoDirection = 255;

/// The sample that a voxel becomes.
struct Sample {
    Vec3i at; ///< voxel index
    float density = 0.0f;
    std::uint8_t theta = kNoDirection;
    std::uint8_t phi = 0;
};

/// theta = b0 pi / 255, phi = b1 2 pi / 255; b0 is below 255, which means no direction.
void set_direction(Sample& sample, Vec3f t) {
    if (t.z < 0.0f) t = t * -1.0f; // axial: keeps theta at most pi / 2
    const double theta = std::acos(std::min(1.0, static_cast<double>(t.z)));
    double phi = std::atan2(static_cast<double>(t.y), static_cast<double>(t.x));
    if (phi < 0.0) phi += 2.0 * std::numbers::pi;
    sample.theta = static_cast<std::uint8_t>(theta * 255.0 / std::numbers::pi + 0.5);
    sample.phi = static_cast<std::uint8_t>(phi * 255.0 / (2.0 * std::numbers::pi) + 0.5);
}

/// The direction that a reader decodes.
Vec3d stored_direction(const Sample& sample) {
    const double theta = sample.theta * std::numbers::pi / 255.0;
    const double phi = sample.phi * 2.0 * std::numbers::pi / 255.0;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Extinction of density 1, averaged over the axes, of flakes around `t` (docs/import.md).
double mean_sine(Vec3d t) {
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        sum += std::sqrt(std::max(0.0, 1.0 - t[a] * t[a])) / 3.0;
    }
    return 4.0 / std::numbers::pi * sum;
}

/// The extinction per scene unit, averaged over the axes.
double extinction(const Coverage& c, const Lattice& lattice) {
    const double columns = static_cast<double>(lattice.subvoxels) * lattice.subvoxels;
    const double cap = 1.0 - 0.5 / columns;
    const std::array<std::uint16_t, 3> axis{c.x, c.y, c.z};
    double sum = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double covered = std::min(axis[a] / 65535.0, cap);
        sum -= std::log1p(-covered) / (3.0 * lattice.voxel_size[static_cast<int>(a)]);
    }
    return sum;
}

template <typename Visit>
void for_each_sample(const VoxelLevel& source, Progress& progress, const Visit& visit) {
    const VoxelLevelInfo& info = source.info();
    VoxelBlock scratch;
    for (std::size_t b = 0; b < source.block_count(); ++b) {
        progress.check();
        for_each_voxel(source.block(b, scratch), [&](const BlockVoxel& voxel) {
            Sample sample{.at = voxel.at};
            double density = extinction(voxel.coverage(), info.lattice);
            const Lobe& first = voxel.lobes()[0]; // the heaviest
            if (info.materials[first.material].kind == MaterialKind::Fiber) {
                set_direction(sample, principal_direction(unpack(first.sggx)));
                density /= mean_sine(stored_direction(sample));
            }
            sample.density = static_cast<float>(density);
            visit(sample);
        });
    }
}

using Cell = std::tuple<std::int32_t, std::int32_t, std::int32_t>;

/// A sample in one block: its number, density and angles.
struct Placed {
    std::uint32_t at;
    std::uint8_t density, theta, phi;
};

/// All samples by block; those of a shared layer are in both blocks.
struct Blocks {
    Vec3i low; ///< voxel index of sample 0
    Vec3i cells;
    Vec3i samples; ///< per block
    std::map<Cell, std::vector<Placed>> placed;

    /// Distance between the first samples of neighbouring blocks, in samples.
    [[nodiscard]] Vec3i pitch() const { return samples - Vec3i{1, 1, 1}; }
    /// Voxel index, from `low`, of the first sample of a block.
    [[nodiscard]] Vec3i first_of(Vec3i cell) const {
        const Vec3i p = pitch();
        return {cell.x * p.x, cell.y * p.y, cell.z * p.z};
    }

    void add(const Sample& sample, double scale) {
        const Vec3i at = sample.at - low;
        const auto density = static_cast<std::uint8_t>(
            std::min(255.0, static_cast<double>(sample.density) / scale * 255.0 + 0.5));
        if (density == 0) return;
        for (int corner = 0; corner < 8; ++corner) {
            Vec3i cell;
            Vec3i in;
            bool here = true;
            for (int a = 0; a < 3; ++a) {
                const std::int32_t step = samples[a] - 1;
                cell[a] =
                    at[a] / step - (corner >> a & 1); // the previous block shares its last layer
                in[a] = at[a] - cell[a] * step;
                here = here && cell[a] >= 0 && cell[a] < cells[a] && in[a] < samples[a];
            }
            if (!here) continue;
            const std::int64_t number = (std::int64_t{in.z} * samples.y + in.y) * samples.x + in.x;
            placed[{cell.x, cell.y, cell.z}].push_back(
                {static_cast<std::uint32_t>(number), density, sample.theta, sample.phi});
        }
    }
};

void write_head(OutputFile& file,
                std::int32_t encoding,
                Vec3i samples,
                std::int32_t channels,
                const Bounds& box) {
    file.write("VOL\3", 4);
    for (const std::int32_t v : {encoding, samples.x, samples.y, samples.z, channels}) {
        file.write_value(v);
    }
    for (const Vec3d& p : {box.lo, box.hi}) {
        for (int a = 0; a < 3; ++a) file.write_value(static_cast<float>(p[a]));
    }
}

void write_whole(const std::string& path,
                 std::int32_t encoding,
                 Vec3i samples,
                 const Bounds& box,
                 const std::vector<std::uint8_t>& bytes) {
    OutputFile file(path);
    write_head(file, encoding, samples, encoding == 4 ? 3 : 1,
               box); // directions have 3 channels in the header and store 2 bytes
    file.write_array(std::span<const std::uint8_t>(bytes));
    file.commit();
}

/// Bounds of the samples `from` to `to` in scene units; samples are at voxel centres.
Bounds bounds_of(Vec3i low, Vec3i from, Vec3i to, Vec3d h) {
    Bounds box;
    for (int a = 0; a < 3; ++a) {
        box.lo[a] = (low[a] + from[a] + 0.5) * h[a];
        box.hi[a] = (low[a] + to[a] + 0.5) * h[a];
    }
    return box;
}

std::int64_t write_block(const Blocks& blocks,
                         const Cell& cell,
                         const std::vector<Placed>& placed,
                         Vec3d h,
                         const std::string& folder) {
    const Vec3i n = blocks.samples;
    const std::size_t count = static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
                              static_cast<std::size_t>(n.z);
    std::vector<std::uint8_t> density(count, 0);
    std::vector<std::uint8_t> angles(2 * count, kNoDirection);
    for (const Placed& p : placed) {
        density[p.at] = p.density;
        angles[2 * std::size_t{p.at}] = p.theta;
        angles[2 * std::size_t{p.at} + 1] = p.phi;
    }
    const auto [x, y, z] = cell;
    const Vec3i first = blocks.first_of({x, y, z});
    const Bounds box = bounds_of(blocks.low, first, first + blocks.pitch(), h);
    write_whole(folder + "/" + BlockName{"density_", ".vol", {}}.of({x, y, z}), 3, n, box, density);
    write_whole(folder + "/" + BlockName{"orientation_", ".vol", {}}.of({x, y, z}), 4, n, box,
                angles);
    return static_cast<std::int64_t>(3 * count + 96);
}

std::int64_t write_dictionary(const Blocks& blocks, Vec3d h, const std::string& folder) {
    OutputFile file(folder + "/volume.vol");
    const Bounds box = bounds_of(blocks.low, {}, blocks.first_of(blocks.cells), h);
    for (const Vec3d& p : {box.lo, box.hi}) {
        for (int a = 0; a < 3; ++a) file.write_value(static_cast<float>(p[a]));
    }
    for (int a = 0; a < 3; ++a) file.write_value(blocks.cells[a]);
    for (const auto& [cell, placed] : blocks.placed) {
        const auto [x, y, z] = cell;
        for (const std::int32_t v : {x, y, z}) file.write_value(v);
    }
    file.commit();
    return static_cast<std::int64_t>(36 + 12 * blocks.placed.size());
}

std::string volume_element(const char* name, const char* prefix) {
    return str("    <volume name=\"", name, "\" type=\"hgridvolume\">\n",
               "      <string name=\"filename\" value=\"volume.vol\"/>\n",
               "      <string name=\"prefix\" value=\"", prefix, "\"/>\n",
               "      <string name=\"postfix\" value=\".vol\"/>\n    </volume>\n");
}

std::string point(const char* name, Vec3d v) {
    return str("      <", name, " x=\"", v.x, "\" y=\"", v.y, "\" z=\"", v.z, "\"/>\n");
}

std::string scene_text(const Bounds& box, double scale, double stddev, Vec3f albedo) {
    const Vec3d middle = (box.lo + box.hi) * 0.5;
    const double radius = 0.5 * length(box.size());
    const Vec3d eye = middle + normalize(Vec3d{0.5, 0.35, 1.0}) * (3.0 * radius);
    const auto list = [](Vec3d v) { return str(v.x, ", ", v.y, ", ", v.z); };
    return str(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<scene version=\"0.6.0\">\n",
        "  <integrator type=\"volpath\"/>\n  <medium type=\"heterogeneous\" id=\"medium\">\n",
        "    <string name=\"method\" value=\"woodcock\"/>\n", "    <float name=\"scale\" value=\"",
        scale, "\"/>\n", volume_element("density", "density_"),
        volume_element("orientation", "orientation_"),
        "    <volume name=\"albedo\" type=\"constvolume\">\n      <spectrum name=\"value\" value=\"",
        albedo.x, ", ", albedo.y, ", ", albedo.z, "\"/>\n    </volume>\n",
        "    <phase type=\"microflake\">\n      <float name=\"stddev\" value=\"", stddev,
        "\"/>\n    </phase>\n  </medium>\n  <shape type=\"cube\">\n",
        "    <transform name=\"toWorld\">\n", point("scale", box.size() * 0.5),
        point("translate", middle), "    </transform>\n",
        "    <ref name=\"interior\" id=\"medium\"/>\n  </shape>\n",
        "  <emitter type=\"constant\"/>\n  <sensor type=\"perspective\">\n",
        "    <float name=\"fov\" value=\"40\"/>\n    <transform name=\"toWorld\">\n",
        "      <lookat origin=\"", list(eye), "\" target=\"", list(middle),
        "\" up=\"0, 1, 0\"/>\n    </transform>\n",
        "    <sampler type=\"independent\">\n      <integer name=\"sampleCount\" value=\"64\"/>\n",
        "    </sampler>\n    <film type=\"hdrfilm\"/>\n  </sensor>\n</scene>\n");
}

/// The range of the voxels and their largest extinction.
struct Extent {
    Vec3i lo, hi; ///< [lo, hi]
    double densest = 0.0;
    std::int64_t voxels = 0;
    std::int64_t no_fiber = 0;

    void grow(const Sample& s) {
        for (int a = 0; a < 3; ++a) {
            lo[a] = voxels == 0 ? s.at[a] : std::min(lo[a], s.at[a]);
            hi[a] = voxels == 0 ? s.at[a] : std::max(hi[a], s.at[a]);
        }
        densest = std::max(densest, static_cast<double>(s.density));
        no_fiber += s.theta == kNoDirection ? 1 : 0;
        ++voxels;
    }
};

/// The blocks of the voxels and of a layer of empty samples around them.
Blocks plan_blocks(const Extent& extent, std::int32_t asked) {
    Blocks blocks;
    std::int64_t samples = 1; // per block
    for (int a = 0; a < 3; ++a) {
        blocks.low[a] = extent.lo[a] - 1;
        const std::int32_t steps = extent.hi[a] + 1 - blocks.low[a];
        const std::int32_t pitch = asked == 0 ? steps : asked - 1;
        blocks.samples[a] = pitch + 1;
        blocks.cells[a] = (steps + pitch - 1) / pitch;
        if (blocks.cells[a] > kMaxBlocks) {
            throw Error(ErrorCode::InvalidArgument,
                        str("export: ", blocks.cells[a], " blocks of ", asked, " samples along ",
                            "xyz"[a], " (limit 999)"),
                        "export larger blocks, or a coarser --level");
        }
        samples = std::min(samples * blocks.samples[a], kMaxSamples + 1);
    }
    if (samples > kMaxSamples) {
        throw Error(ErrorCode::InvalidArgument,
                    "export: one block of more than 2^31 samples (limit 2^31)",
                    "export smaller blocks, or a coarser --level");
    }
    return blocks;
}

} // namespace

Mitsuba06Files write_mitsuba06(const VoxelLevel& source,
                               const std::string& folder,
                               const Mitsuba06Options& options,
                               Progress& progress) {
    Extent extent;
    for_each_sample(source, progress, [&](const Sample& s) { extent.grow(s); });
    if (!(extent.densest > 0.0)) {
        throw Error(ErrorCode::InvalidArgument,
                    "export: the volume has no voxels with any coverage",
                    "export a volume that has some");
    }
    Blocks blocks = plan_blocks(extent, options.block_samples);
    for_each_sample(source, progress, [&](const Sample& s) { blocks.add(s, extent.densest); });
    make_folder(folder);
    const Vec3d h = source.info().lattice.voxel_size;
    Mitsuba06Files out{.samples = blocks.first_of(blocks.cells) + Vec3i{1, 1, 1},
                       .block_samples = blocks.samples,
                       .cells = blocks.cells,
                       .blocks = static_cast<std::int64_t>(blocks.placed.size()),
                       .scale = extent.densest,
                       .no_fiber = extent.no_fiber};
    progress.begin("export", "blocks", out.blocks);
    for (const auto& [cell, placed] : blocks.placed) {
        progress.check();
        out.bytes += write_block(blocks, cell, placed, h, folder);
        progress.advance(1);
    }
    out.bytes += write_dictionary(blocks, h, folder);
    Vec3f albedo{0.8f, 0.8f, 0.8f};
    if (!source.info().materials.empty()) albedo = source.info().materials[0].albedo;
    OutputFile scene(folder + "/scene.xml");
    const std::string text = scene_text(bounds_of(blocks.low, {}, blocks.first_of(blocks.cells), h),
                                        extent.densest, options.stddev, albedo);
    scene.write(text.data(), text.size());
    scene.commit();
    out.bytes += static_cast<std::int64_t>(text.size());
    return out;
}

} // namespace heddle
