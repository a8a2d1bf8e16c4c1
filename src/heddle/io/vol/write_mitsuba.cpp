#include <heddle/io/vol/write_mitsuba.h>

#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/io/file/output_file.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <vector>

namespace heddle {
namespace {

constexpr std::int32_t kLayers = 8; ///< layers that are written at once

Vec3d corner(Vec3i index, Vec3d h) {
    return Vec3d{static_cast<double>(index.x), static_cast<double>(index.y),
                 static_cast<double>(index.z)} *
           h;
}

void write_head(OutputFile& file, const MitsubaBox& box, std::int32_t channels) {
    file.write("VOL\3", 4);
    for (const std::int32_t v : {1, box.size.x, box.size.y, box.size.z, channels}) {
        file.write_value(v); // 1: f32
    }
    for (const Vec3d& p : {box.bounds.lo, box.bounds.hi}) {
        for (int a = 0; a < 3; ++a) file.write_value(static_cast<float>(p[a]));
    }
}

/// Formats "x, y, z" with all digits.
std::string list(Vec3d v) {
    std::ostringstream out;
    out.precision(9);
    out << v.x << ", " << v.y << ", " << v.z;
    return out.str();
}

std::string grid_element(const char* name, const char* file, const MitsubaBox& box) {
    return str("      <volume name=\"", name, "\" type=\"gridvolume\">\n",
               "        <string name=\"filename\" value=\"", file, "\"/>\n",
               "        <boolean name=\"raw\" value=\"true\"/>\n",
               "        <transform name=\"to_world\">\n", "          <scale value=\"",
               list(box.bounds.size()), "\"/>\n", "          <translate value=\"",
               list(box.bounds.lo), "\"/>\n", "        </transform>\n      </volume>\n");
}

/// A camera in front, to a side and above, with the content's bounding ball in view.
std::string camera_element(const Bounds& content) {
    constexpr double kAngleDeg = 35.0;
    constexpr double kTight = 1.15; // moves closer: the ball around a box leaves too much room
    const Vec3d target = (content.lo + content.hi) * 0.5;
    const double radius = 0.5 * length(content.size());
    const double away = radius / std::sin(0.5 * kAngleDeg * std::numbers::pi / 180.0) / kTight;
    const Vec3d eye = target + normalize(Vec3d{0.5, 0.35, 1.0}) * away;
    return str(
        "  <sensor type=\"perspective\">\n", "    <float name=\"fov\" value=\"", kAngleDeg,
        "\"/>\n    <string name=\"fov_axis\" value=\"y\"/>\n",
        "    <float name=\"near_clip\" value=\"", 0.01 * radius, "\"/>\n",
        "    <float name=\"far_clip\" value=\"", 100.0 * radius, "\"/>\n",
        "    <transform name=\"to_world\">\n      <lookat origin=\"", list(eye), "\" target=\"",
        list(target), "\" up=\"0, 1, 0\"/>\n    </transform>\n", "    <film type=\"hdrfilm\">\n",
        "      <integer name=\"width\" value=\"$width\"/>\n",
        "      <integer name=\"height\" value=\"$height\"/>\n",
        "      <string name=\"pixel_format\" value=\"rgb\"/>\n",
        "      <rfilter type=\"box\"/>\n    </film>\n", "    <sampler type=\"independent\">\n",
        "      <integer name=\"sample_count\" value=\"$spp\"/>\n    </sampler>\n", "  </sensor>\n");
}

std::string scene_text(const FlakeField& field, const MitsubaBox& box) {
    const Vec3d centre = (box.bounds.lo + box.bounds.hi) * 0.5;
    const std::string albedo =
        field.albedo_varies()
            ? grid_element("albedo", "albedo.vol", box)
            : str("      <rgb name=\"albedo\" value=\"", list(to_double(field.albedo())), "\"/>\n");
    return str(
        "<!-- mitsuba scene.xml; -Dspp=64 -Dwidth=512 -Dheight=512 change the defaults -->\n",
        "<scene version=\"3.0.0\">\n", "  <default name=\"spp\" value=\"64\"/>\n",
        "  <default name=\"width\" value=\"512\"/>\n",
        "  <default name=\"height\" value=\"512\"/>\n", "  <integrator type=\"volpath\">\n",
        "    <integer name=\"max_depth\" value=\"64\"/>\n",
        "    <integer name=\"rr_depth\" value=\"5\"/>\n  </integrator>\n",
        camera_element(box.content), //
        "  <emitter type=\"constant\">\n",
        "    <rgb name=\"radiance\" value=\"0.35, 0.4, 0.5\"/>\n  </emitter>\n",
        "  <emitter type=\"directional\">\n",
        "    <vector name=\"direction\" value=\"-0.7, -1, -0.25\"/>\n",
        "    <rgb name=\"irradiance\" value=\"4, 3.8, 3.4\"/>\n  </emitter>\n",
        "  <shape type=\"cube\">\n    <transform name=\"to_world\">\n", "      <scale value=\"",
        list(box.bounds.size() * 0.5), "\"/>\n", "      <translate value=\"", list(centre),
        "\"/>\n    </transform>\n", "    <bsdf type=\"null\"/>\n",
        "    <medium name=\"interior\" type=\"heterogeneous\">\n",
        grid_element("sigma_t", "sigma_t.vol", box), albedo, "      <phase type=\"sggx\">\n",
        grid_element("S", "S.vol", box), "      </phase>\n    </medium>\n  </shape>\n</scene>\n");
}

/// The .vol files to which layers are appended.
struct GridFiles {
    OutputFile sigma_t, S;
    std::unique_ptr<OutputFile> albedo;

    GridFiles(const FlakeField& field, const MitsubaBox& box, const std::string& folder)
        : sigma_t(folder + "/sigma_t.vol"), S(folder + "/S.vol") {
        write_head(sigma_t, box, 1);
        write_head(S, box, 6);
        if (!field.albedo_varies()) return;
        albedo = std::make_unique<OutputFile>(folder + "/albedo.vol");
        write_head(*albedo, box, 3);
    }
    void append(const FlakeBlock& block) {
        sigma_t.write_array(std::span<const float>(block.sigma_t));
        std::vector<float> entries;
        entries.reserve(6 * block.S.size());
        for (const PackedFlake& p : block.S) {
            for (const std::int16_t v : p) entries.push_back(kFlakeUnit * static_cast<float>(v));
        }
        S.write_array(std::span<const float>(entries));
        if (albedo) albedo->write_array(std::span<const Vec3f>(block.albedo));
    }
    void commit() {
        sigma_t.commit();
        S.commit();
        if (albedo) albedo->commit();
    }
};

} // namespace

MitsubaBox plan_mitsuba(const FlakeField& field, double pad) {
    if (field.lo() == field.hi()) {
        throw Error(ErrorCode::InvalidArgument, "export: the volume has no voxels",
                    "export a volume that has some");
    }
    MitsubaBox box{};
    const Vec3d h = field.voxel_size();
    box.content = {corner(field.lo(), h), corner(field.hi(), h)};
    double voxels = 1.0;
    for (int a = 0; a < 3; ++a) {
        const double n = field.hi()[a] - field.lo()[a] + 2.0;
        const double extra = std::min(std::round(0.5 * n * (pad - 1.0)), 1e8);
        box.low[a] = field.lo()[a] - 1 - static_cast<std::int32_t>(extra);
        box.size[a] = static_cast<std::int32_t>(n + 2.0 * extra);
        voxels *= box.size[a];
    }
    box.bounds = {corner(box.low, h), corner(box.low + box.size, h)};
    constexpr double kMax = 1e17; // more than any memory, and its bytes fit 64 bits
    box.voxels = static_cast<std::int64_t>(std::min(voxels, kMax));
    box.bytes = box.voxels * (field.albedo_varies() ? 40 : 28);
    return box;
}

void write_mitsuba(const FlakeField& field,
                   const MitsubaBox& box,
                   const std::string& folder,
                   Progress& progress) {
    const std::int64_t free = available_bytes();
    if (free > 0 && box.bytes > free) {
        throw Error(ErrorCode::OutOfMemory,
                    str("export: ", box.size.x, " x ", box.size.y, " x ", box.size.z,
                        " dense voxels are ", box.bytes >> 20, " MiB, ", free >> 20,
                        " MiB are free"),
                    "export a coarser --level");
    }
    make_folder(folder);
    GridFiles files(field, box, folder);
    progress.begin("export", "voxels", box.voxels);
    FlakeBlock block;
    for (std::int32_t z = 0; z < box.size.z; z += kLayers) {
        progress.check();
        const Vec3i size{box.size.x, box.size.y, std::min(kLayers, box.size.z - z)};
        field.fill(box.low + Vec3i{0, 0, z}, size, block);
        files.append(block);
        progress.advance(static_cast<std::int64_t>(block.sigma_t.size()));
    }
    files.commit();
    OutputFile scene(folder + "/scene.xml");
    const std::string text = scene_text(field, box);
    scene.write(text.data(), text.size());
    scene.commit();
}

} // namespace heddle
