#include <heddle/io/gltf/gltf_material.h>

#include <heddle/base/error.h>
#include <heddle/io/image/image.h>
#include <heddle/io/mesh/add_parts.h>
#include <heddle/io/mesh/find_image.h>

#include <algorithm>
#include <cmath>

namespace heddle {
namespace {

float unit(double value) {
    return value >= 0.0 ? static_cast<float>(std::min(value, 1.0)) : 0.0f; // NaN gives 0
}

void set_color(const std::vector<double>& rgba, Material& to) {
    if (rgba.size() < 3) return;
    to.albedo = {unit(rgba[0]), unit(rgba[1]), unit(rgba[2])};
    if (rgba.size() > 3) to.alpha = unit(rgba[3]);
}

double array_number(const tinygltf::Value* array, std::size_t i, double fallback) {
    if (array == nullptr || !array->IsArray() || i >= array->ArrayLen()) return fallback;
    const tinygltf::Value& value = array->Get(static_cast<int>(i));
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : fallback;
    return std::isfinite(number) ? number : fallback;
}

/// @param transform  KHR_texture_transform; may be null
UvSource uv_source(int set, const tinygltf::Value* transform) {
    UvSource uv;
    uv.set = set;
    if (transform == nullptr) return uv;
    const tinygltf::Value* offset = find_member(*transform, "offset");
    const tinygltf::Value* scale = find_member(*transform, "scale");
    uv.offset_u = array_number(offset, 0, 0.0);
    uv.offset_v = array_number(offset, 1, 0.0);
    uv.scale_u = array_number(scale, 0, 1.0);
    uv.scale_v = array_number(scale, 1, 1.0);
    uv.rotation = number_or(*transform, "rotation", 0.0);
    uv.set = static_cast<int>(std::clamp(number_or(*transform, "texCoord", set), 0.0, 1e6));
    return uv;
}

Wrap wrap_from(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::Clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::Mirror : Wrap::Repeat;
}

/// Decodes `%20` and the like into bytes.
std::string decode_uri(const std::string& uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const auto hex = [&](std::size_t k) {
            return std::string("0123456789abcdef")
                .find(static_cast<char>(std::tolower(static_cast<unsigned char>(uri[k]))));
        };
        if (uri[i] == '%' && i + 2 < uri.size() && hex(i + 1) < 16 && hex(i + 2) < 16) {
            out.push_back(static_cast<char>(hex(i + 1) * 16 + hex(i + 2)));
            i += 2;
        } else {
            out.push_back(uri[i]);
        }
    }
    return out;
}

} // namespace

Uv UvSource::apply(Uv uv) const {
    const double u = double{uv.u} * scale_u;
    const double v = double{uv.v} * scale_v;
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    return {static_cast<float>(c * u + s * v + offset_u),
            static_cast<float>(c * v - s * u + offset_v)};
}

GltfMaterials::Used GltfMaterials::use(int material) {
    if (const auto place = used_.find(material); place != used_.end()) return place->second;
    const auto& materials = model_->materials;
    if (material >= static_cast<int>(materials.size()) || material < -1)
        model_.fail(str("names material ", material, " of ", materials.size()));
    tinygltf::Material plain;
    plain.name = "default";
    const Used used = convert(material < 0 ? plain : materials[static_cast<std::size_t>(material)]);
    used_[material] = used;
    return used;
}

GltfMaterials::Used GltfMaterials::convert(const tinygltf::Material& from) {
    sources_.clear();
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    Material to;
    to.name = from.name.empty() ? str("material ", geometry_.materials.size()) : from.name;
    set_color(pbr.baseColorFactor, to);
    to.roughness = unit(pbr.roughnessFactor);
    to.metalness = unit(pbr.metallicFactor);
    to.albedo_map = map(pbr.baseColorTexture, true);
    if (const auto* old = find_extension(from.extensions, "KHR_materials_pbrSpecularGlossiness"))
        read_specular_glossiness(*old, to);
    to.normal_map = map(from.normalTexture, false);
    to.normal_scale = static_cast<float>(from.normalTexture.scale);
    to.metal_rough_map = map(pbr.metallicRoughnessTexture, false);
    if (const auto* extension = find_extension(from.extensions, "KHR_materials_anisotropy"))
        read_anisotropy(*extension, to);
    read_alpha(from, to);
    Used used;
    if (!sources_.empty()) used.uv = sources_.front();
    if (std::count(sources_.begin(), sources_.end(), used.uv) < std::ssize(sources_))
        geometry_.notes.push_back(str("material '", to.name, "': its maps differ in uv transform; ",
                                      "all are read with the uv of the first"));
    used.index =
        add_material(geometry_, std::move(to), (model_.folder() / geometry_.name).string());
    return used;
}

void GltfMaterials::read_anisotropy(const tinygltf::Value& extension, Material& to) {
    to.anisotropy = unit(number_or(extension, "anisotropyStrength", 0.0));
    to.anisotropy_rotation = static_cast<float>(number_or(extension, "anisotropyRotation", 0.0));
    if (const auto* info = find_member(extension, "anisotropyTexture");
        info && to.anisotropy > 0.0f)
        to.anisotropy_map = map(*info, false);
}

void GltfMaterials::read_specular_glossiness(const tinygltf::Value& extension, Material& to) {
    const tinygltf::Value* factor = find_member(extension, "diffuseFactor");
    set_color({array_number(factor, 0, 1.0), array_number(factor, 1, 1.0),
               array_number(factor, 2, 1.0), array_number(factor, 3, 1.0)},
              to);
    to.roughness = unit(1.0 - number_or(extension, "glossinessFactor", 1.0));
    to.metalness = 0.0f;
    if (const auto* info = find_member(extension, "diffuseTexture"))
        to.albedo_map = map(*info, true);
    geometry_.notes.push_back(str("material '", to.name,
                                  "': specular and glossiness maps are left ",
                                  "out, its diffuse colour is the albedo"));
}

void GltfMaterials::read_alpha(const tinygltf::Material& from, Material& to) {
    if (from.alphaMode == "MASK") to.alpha_mode = AlphaMode::Mask;
    if (from.alphaMode == "BLEND") to.alpha_mode = AlphaMode::Blend;
    to.alpha_cutoff = static_cast<float>(from.alphaCutoff);
}

std::int32_t GltfMaterials::map(const tinygltf::Value& info, bool srgb) {
    const tinygltf::Value* extensions = find_member(info, "extensions");
    const tinygltf::Value* transform =
        extensions != nullptr ? find_member(*extensions, "KHR_texture_transform") : nullptr;
    const auto whole = [&](const char* key, double fallback) {
        return static_cast<int>(std::clamp(number_or(info, key, fallback), -1.0, 1e9));
    };
    return map(whole("index", -1.0), uv_source(whole("texCoord", 0.0), transform), srgb);
}

template <typename Info>
std::int32_t GltfMaterials::map(const Info& info, bool srgb) {
    const auto* transform = find_extension(info.extensions, "KHR_texture_transform");
    return map(info.index, uv_source(info.texCoord, transform), srgb);
}

std::int32_t GltfMaterials::map(int texture, const UvSource& uv, bool srgb) {
    if (texture == -1) return -1;
    if (texture < 0 || static_cast<std::size_t>(texture) >= model_->textures.size())
        model_.fail(str("names texture ", texture, " of ", model_->textures.size()));
    const auto [place, is_new] = loaded_.try_emplace({texture, srgb}, -1);
    if (is_new) place->second = load(texture, srgb);
    if (place->second >= 0) sources_.push_back(uv);
    return place->second;
}

std::int32_t GltfMaterials::load(int texture, bool srgb) {
    const tinygltf::Texture& from = model_->textures[static_cast<std::size_t>(texture)];
    std::optional<Texture> to = image(from.source);
    if (!to) return -1;
    to->srgb = srgb;
    if (from.sampler >= 0 && static_cast<std::size_t>(from.sampler) < model_->samplers.size()) {
        const tinygltf::Sampler& sampler = model_->samplers[static_cast<std::size_t>(from.sampler)];
        to->wrap_u = wrap_from(sampler.wrapS);
        to->wrap_v = wrap_from(sampler.wrapT);
    }
    return add_texture(geometry_, std::move(*to));
}

std::optional<Texture> GltfMaterials::image(int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= model_->images.size()) {
        geometry_.notes.push_back(str("a texture names image ", index, " of ",
                                      model_->images.size(), ": its map is left out"));
        return std::nullopt;
    }
    const tinygltf::Image& from = model_->images[static_cast<std::size_t>(index)];
    if (!from.uri.empty())
        return find_image(model_.folder(), decode_uri(from.uri), geometry_.notes);
    const std::span<const unsigned char> bytes =
        from.bufferView >= 0 ? model_.view(from.bufferView) : std::span(from.image);
    const std::string name = str("image ", index, " of ", geometry_.name);
    try {
        Texture to = decode_image(std::as_bytes(bytes), name);
        widen_grey(to);
        return to;
    } catch (const Error& e) {
        if (e.code() == ErrorCode::OutOfMemory) throw;
        geometry_.notes.push_back(str("image left out: ", e.what()));
        return std::nullopt;
    }
}

} // namespace heddle
