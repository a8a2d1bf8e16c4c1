#include <heddle/io/mesh/obj_material.h>

#include <heddle/base/error.h>
#include <heddle/io/mesh/add_parts.h>
#include <heddle/io/mesh/find_image.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heddle {
namespace {

float unit(float value) {
    return value >= 0.0f ? std::min(value, 1.0f) : 0.0f; // NaN gives 0
}

/// A tangent-space normal map is mostly (128, 128, 255); a bump map is grey.
bool looks_like_normals(const Texture& image) {
    const auto channels = static_cast<std::size_t>(image.channels);
    if (channels < 3) return false;
    std::uint64_t red = 0;
    std::uint64_t blue = 0;
    for (std::size_t i = 0; i + 2 < image.texels.size(); i += channels) {
        red += image.texels[i];
        blue += image.texels[i + 2];
    }
    return blue > red + red / 4;
}

/// The alpha that map_d gives to texel (x, y) of an image of another size: nearest texel; its alpha
/// channel if it has one, else its first channel.
std::uint8_t alpha_at(const Texture& mask, std::int64_t x, std::int64_t y, const Texture& like) {
    const std::int64_t mask_x = x * mask.width / like.width;
    const std::int64_t mask_y = y * mask.height / like.height;
    const std::int64_t channel = mask.channels == 4 ? 3 : 0;
    return mask
        .texels[static_cast<std::size_t>((mask_y * mask.width + mask_x) * mask.channels + channel)];
}

/// `color` with its alpha replaced by `mask`.
Texture with_alpha(const Texture& color, const Texture& mask) {
    Texture out = color;
    out.channels = 4;
    out.name = color.name + " + " + mask.name;
    out.texels.clear();
    out.texels.reserve(4 * static_cast<std::size_t>(color.width) *
                       static_cast<std::size_t>(color.height));
    const auto channels = static_cast<std::size_t>(color.channels);
    for (std::size_t i = 0; i + channels <= color.texels.size(); i += channels) {
        const auto texel = static_cast<std::int64_t>(i / channels);
        for (std::size_t k = 0; k < 3; ++k) out.texels.push_back(color.texels[i + k]);
        out.texels.push_back(alpha_at(mask, texel % color.width, texel / color.width, color));
    }
    return out;
}

Texture white_like(const Texture& mask) {
    Texture out = mask;
    out.channels = 3;
    out.name = "white";
    out.texels.assign(
        3 * static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height), 255);
    return out;
}

} // namespace

std::int32_t ObjMaterials::load(const std::string& name, bool srgb, bool clamp) {
    if (name.empty()) return -1;
    const auto [place, is_new] = loaded_.try_emplace({name, srgb}, -1);
    if (is_new) {
        if (auto image = find_image(folder_, name, geometry_.notes)) {
            image->srgb = srgb;
            image->wrap_u = image->wrap_v = clamp ? Wrap::Clamp : Wrap::Repeat;
            place->second = add_texture(geometry_, std::move(*image));
        }
    }
    return place->second;
}

std::int32_t ObjMaterials::normal_map(const tinyobj::material_t& from) {
    if (!from.normal_texname.empty())
        return load(from.normal_texname, false, from.normal_texopt.clamp);
    if (from.bump_texname.empty()) return -1;
    const std::size_t before = geometry_.textures.size();
    const std::int32_t index = load(from.bump_texname, false, from.bump_texopt.clamp);
    if (index < 0 || looks_like_normals(geometry_.textures[static_cast<std::size_t>(index)]))
        return index;
    geometry_.notes.push_back(
        str("material '", from.name, "': bump map '", from.bump_texname,
            "' is grey, not a normal map: left out (a height map can be given by option)"));
    if (geometry_.textures.size() > before) {
        geometry_.textures.pop_back();
        loaded_[{from.bump_texname, false}] = -1;
    }
    return -1;
}

std::int32_t ObjMaterials::albedo_with_alpha(std::int32_t albedo, const tinyobj::material_t& from) {
    const auto mask = find_image(folder_, from.alpha_texname, geometry_.notes);
    if (!mask) return albedo;
    const bool plain = albedo < 0;
    const Texture color =
        plain ? white_like(*mask) : geometry_.textures[static_cast<std::size_t>(albedo)];
    Texture merged = with_alpha(color, *mask);
    merged.srgb = true;
    return add_texture(geometry_, std::move(merged));
}

Material ObjMaterials::convert(const tinyobj::material_t& from) {
    Material to;
    to.name = from.name;
    to.albedo = {unit(from.diffuse[0]), unit(from.diffuse[1]), unit(from.diffuse[2])};
    to.albedo_map = load(from.diffuse_texname, true, from.diffuse_texopt.clamp);
    // Exporters write `Kd 0 0 0` beside a map that is meant to be visible.
    if (to.albedo_map >= 0 && to.albedo == Vec3f{}) to.albedo = {1.0f, 1.0f, 1.0f};
    to.alpha = unit(from.dissolve);
    if (to.alpha < 1.0f) to.alpha_mode = AlphaMode::Blend;
    if (!from.alpha_texname.empty()) {
        to.albedo_map = albedo_with_alpha(to.albedo_map, from);
        to.alpha_mode = AlphaMode::Mask;
    }
    to.normal_map = normal_map(from);
    // Blinn's exponent to roughness: alpha^2 = 2 / (Ns + 2), glTF's roughness^2 = alpha
    to.roughness = from.roughness > 0.0f
                       ? unit(from.roughness)
                       : unit(std::pow(2.0f / (std::max(from.shininess, 0.0f) + 2.0f), 0.25f));
    to.metalness = unit(from.metallic);
    to.anisotropy = unit(from.anisotropy);
    to.anisotropy_rotation = unit(from.anisotropy_rotation) * 2.0f * std::numbers::pi_v<float>;
    for (const auto& [map, name] : {std::pair{"disp", &from.displacement_texname},
                                    std::pair{"map_Pr", &from.roughness_texname},
                                    std::pair{"map_Pm", &from.metallic_texname}}) {
        if (!name->empty())
            geometry_.notes.push_back(
                str("material '", from.name, "': ", map, " '", *name, "' is left out"));
    }
    return to;
}

} // namespace heddle
