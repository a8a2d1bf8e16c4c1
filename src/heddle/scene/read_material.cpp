#include <heddle/scene/scene_parts.h>

#include <heddle/base/error.h>
#include <heddle/scatter/scatter_material.h>

#include <array>

namespace heddle::scene_form {
namespace {

const std::vector<std::string_view> kModels{"fiber", "lobe_fiber", "hair", "surface", "microflake"};

constexpr Range kTiltDeg{.least = -45.0, .most = 45.0};
constexpr Range kWidthDeg{.least = 0.0, .most = 180.0, .above = true};

/// The two lobes must not emit more light than comes in: with a fiber that creates light, paths
/// never end and brightness has no bound. An absent key counts with its default value.
void check_lobe_energy(const TableReader& reader, const ScatterMaterial& m) {
    constexpr double kRounding = 1e-4; // of colours given to four decimals
    constexpr std::array<const char*, 3> kChannels{"red", "green", "blue"};
    const auto sum = [&m](int k) { return double{m.color_r[k]} + double{m.color_tt[k]}; };
    int worst = 0;
    for (int k = 1; k < 3; ++k) {
        if (sum(k) > sum(worst)) worst = k;
    }
    if (sum(worst) <= 1.0 + kRounding) return;
    reader.problem(reader.has("color_tt") ? "color_tt" : "color_r",
                   str("'color_r' and 'color_tt' sum to ", sum(worst), " in ",
                       kChannels[static_cast<std::size_t>(worst)], " (", m.color_r[worst], " + ",
                       m.color_tt[worst], "), allowed: at most 1"),
                   "lower one of them; where TT is given of what enters, color_tt is "
                   "(1 - color_r) TT");
}

void read_lobe_fiber(TableReader& reader, ScatterMaterial& m) {
    m.model = ScatterModel::LobeFiber;
    const bool knows_r = reader.color("color_r", m.color_r, kUnit);
    const bool knows_tt = reader.color("color_tt", m.color_tt, kUnit);
    if (knows_r && knows_tt) check_lobe_energy(reader, m);
    reader.angle("width_r", m.width_r, kWidthDeg);
    reader.angle("width_tt", m.width_tt, kWidthDeg);
    reader.angle("azimuth_tt", m.azimuth_tt, kWidthDeg);
    reader.angle("tilt", m.tilt, kTiltDeg);
}

void read_hair(TableReader& reader, ScatterMaterial& m) {
    m.model = ScatterModel::Hair;
    reader.number("width_m", m.width_m, kUnit);
    reader.number("width_n", m.width_n, kUnit);
    reader.number("eta", m.eta, {.least = 1.0, .most = 4.0, .above = true});
    reader.angle("tilt", m.tilt, kTiltDeg);
    int given = 0;
    for (const char* key : {"absorption", "melanin", "color"}) {
        if (!reader.has(key)) continue;
        if (++given == 2) {
            reader.problem(key, "'absorption', 'melanin' and 'color' define the same thing",
                           "keep one");
        }
    }
    reader.color("absorption", m.absorption);
    if (const auto v = reader.numbers("melanin", {2}, {.least = 0.0, .most = 1e6})) {
        m.absorption =
            absorption_from_melanin(static_cast<float>((*v)[0]), static_cast<float>((*v)[1]));
    }
    if (reader.has("color")) {
        Vec3f color{1, 1, 1};
        reader.color("color", color, {.least = 1e-6, .most = 1.0}); // ln 0 is not finite
        m.absorption = absorption_from_color(color, m.width_n);
    }
}

void read_surface(TableReader& reader, ScatterMaterial& m) {
    m.model = ScatterModel::Surface;
    reader.color("albedo", m.albedo, kUnit);
    reader.number("roughness", m.roughness, kUnit);
    reader.number("metalness", m.metalness, kUnit);
    reader.number("anisotropy", m.anisotropy, kUnit);
    reader.number("specular", m.specular, kUnit);
}

void read_microflake(TableReader& reader, ScatterMaterial& m) {
    const std::optional<std::size_t> flake = reader.choose("flake", {"specular", "diffuse"});
    m.model = flake == std::size_t{1} ? ScatterModel::MicroflakeDiffuse
                                      : ScatterModel::MicroflakeSpecular;
    reader.color("albedo", m.albedo, kUnit);
}

} // namespace

ScatterMaterial read_material(TableReader& reader) {
    ScatterMaterial m;
    reader.require("model", "write 'model = \"fiber\"', or lobe_fiber, hair, surface, microflake");
    const std::optional<std::size_t> model = reader.choose("model", kModels);
    if (!model) return m; // the allowed keys depend on it
    reader.set_what(str("a material of model '", kModels[*model], "'"));
    switch (*model) {
    case 0:
        m.model = ScatterModel::LambertFiber;
        reader.color("albedo", m.albedo, kUnit);
        break;
    case 1: read_lobe_fiber(reader, m); break;
    case 2: read_hair(reader, m); break;
    case 3: read_surface(reader, m); break;
    default: read_microflake(reader, m); break;
    }
    reader.finish();
    return m;
}

} // namespace heddle::scene_form
