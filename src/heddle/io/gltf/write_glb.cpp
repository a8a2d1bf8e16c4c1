#include <heddle/io/gltf/write_glb.h>

#include <heddle/base/error.h>
#include <heddle/geom/bounds.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/image/image.h>

#include <nlohmann/json.hpp>
#include <array>
#include <deque>
#include <limits>

namespace heddle {
namespace {

using Json = nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr std::array<std::byte, 4> kPadding{};

/// Builds the JSON and the list of parts of the binary chunk, which are borrowed until written.
class GlbBuilder {
public:
    explicit GlbBuilder(const Geometry& geometry) : geometry_(geometry) {
        json_["asset"] = {{"version", "2.0"}, {"generator", "heddle"}};
        json_["scene"] = 0;
        json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
        for (const Texture& texture : geometry.textures) add_texture(texture);
        for (const Material& material : geometry.materials) add_material(material);
        for (const Mesh& mesh : geometry.meshes) {
            if (!mesh.triangles.empty()) add_mesh(mesh);
        }
        if (has_anisotropy_) json_["extensionsUsed"] = {"KHR_materials_anisotropy"};
        json_["buffers"] = {{{"byteLength", size_}}};
    }

    void write(const std::filesystem::path& path) const {
        std::string text = json_.dump();
        while (text.size() % 4 != 0) text.push_back(' ');
        const std::uint64_t total = 12 + 8 + text.size() + 8 + size_;
        if (total > std::numeric_limits<std::uint32_t>::max())
            throw Error(ErrorCode::InvalidArgument,
                        str("the mesh needs ", total, " bytes, a .glb holds fewer than 2^32"),
                        "write fewer elements");
        std::string head = "glTF";
        for (const std::uint64_t word : {std::uint64_t{2}, total, std::uint64_t{text.size()}})
            append_u32(head, word);
        head += "JSON" + text;
        append_u32(head, size_);
        head += std::string("BIN\0", 4);
        OutputFile file(path.string());
        file.write(head.data(), head.size());
        for (const std::span<const std::byte> part : parts_) file.write_array(part);
        file.commit();
    }

private:
    static void append_u32(std::string& to, std::uint64_t value) {
        for (int k = 0; k < 4; ++k) to.push_back(static_cast<char>(value >> (8 * k) & 0xFF));
    }

    /// Adds bytes to the binary chunk; returns their buffer view.
    std::size_t add_view(std::span<const std::byte> bytes, int target) {
        Json view{{"buffer", 0}, {"byteOffset", size_}, {"byteLength", bytes.size()}};
        if (target != 0) view["target"] = target;
        parts_.push_back(bytes);
        const std::size_t padding = (4 - bytes.size() % 4) % 4;
        if (padding != 0) parts_.push_back(std::span(kPadding).first(padding));
        size_ += bytes.size() + padding;
        return push("bufferViews", std::move(view));
    }

    std::size_t push(const char* array, Json value) {
        json_[array].push_back(std::move(value));
        return json_[array].size() - 1;
    }

    template <typename T>
    std::size_t add_accessor(const std::vector<T>& values, const char* type) {
        const std::size_t view = add_view(std::as_bytes(std::span{values}), kArrayBuffer);
        return push("accessors", {{"bufferView", view},
                                  {"componentType", kFloat},
                                  {"count", values.size()},
                                  {"type", type}});
    }

    void add_texture(const Texture& texture) {
        const auto wrap = [](Wrap w) {
            return w == Wrap::Clamp ? 33071 : w == Wrap::Mirror ? 33648 : 10497;
        };
        encoded_.push_back(
            encode_png(texture.width, texture.height, texture.channels, texture.texels));
        const std::size_t view = add_view(std::as_bytes(std::span{encoded_.back()}), 0);
        const std::size_t image = push(
            "images", {{"bufferView", view}, {"mimeType", "image/png"}, {"name", texture.name}});
        const std::size_t sampler =
            push("samplers", {{"wrapS", wrap(texture.wrap_u)}, {"wrapT", wrap(texture.wrap_v)}});
        push("textures", {{"source", image}, {"sampler", sampler}});
    }

    Json texture_info(std::int32_t index) const {
        if (static_cast<std::size_t>(index) >= geometry_.textures.size())
            throw Error(ErrorCode::InvalidArgument,
                        str("a material names texture ", index, " of ", geometry_.textures.size()));
        return {{"index", index}};
    }

    void add_material(const Material& from) {
        if (from.height_map >= 0)
            throw Error(ErrorCode::InvalidArgument,
                        str("material '", from.name, "' has a height map, glTF cannot hold one"));
        const Vec3f c = from.albedo;
        Json pbr{{"baseColorFactor", {c.x, c.y, c.z, from.alpha}},
                 {"roughnessFactor", from.roughness},
                 {"metallicFactor", from.metalness}};
        if (from.albedo_map >= 0) pbr["baseColorTexture"] = texture_info(from.albedo_map);
        if (from.metal_rough_map >= 0)
            pbr["metallicRoughnessTexture"] = texture_info(from.metal_rough_map);
        Json to{{"name", from.name}, {"doubleSided", true}, {"pbrMetallicRoughness", pbr}};
        if (from.normal_map >= 0) {
            to["normalTexture"] = texture_info(from.normal_map);
            to["normalTexture"]["scale"] = from.normal_scale;
        }
        if (from.alpha_mode == AlphaMode::Blend) to["alphaMode"] = "BLEND";
        if (from.alpha_mode == AlphaMode::Mask) {
            to["alphaMode"] = "MASK";
            to["alphaCutoff"] = from.alpha_cutoff;
        }
        if (from.anisotropy > 0.0f) to["extensions"]["KHR_materials_anisotropy"] = anisotropy(from);
        push("materials", std::move(to));
    }

    Json anisotropy(const Material& from) {
        has_anisotropy_ = true;
        Json to{{"anisotropyStrength", from.anisotropy},
                {"anisotropyRotation", from.anisotropy_rotation}};
        if (from.anisotropy_map >= 0) to["anisotropyTexture"] = texture_info(from.anisotropy_map);
        return to;
    }

    void add_mesh(const Mesh& mesh) {
        if (mesh.material >= geometry_.materials.size())
            throw Error(ErrorCode::InvalidArgument, str("a mesh names material ", mesh.material,
                                                        " of ", geometry_.materials.size()));
        Bounds bounds;
        for (const Vec3f p : mesh.positions) bounds.grow(to_double(p));
        Json attributes;
        const std::size_t position = add_accessor(mesh.positions, "VEC3");
        json_["accessors"][position]["min"] = {bounds.lo.x, bounds.lo.y, bounds.lo.z};
        json_["accessors"][position]["max"] = {bounds.hi.x, bounds.hi.y, bounds.hi.z};
        attributes["POSITION"] = position;
        if (!mesh.normals.empty()) attributes["NORMAL"] = add_accessor(mesh.normals, "VEC3");
        if (!mesh.tangents.empty()) attributes["TANGENT"] = add_accessor(mesh.tangents, "VEC4");
        if (!mesh.uvs.empty()) attributes["TEXCOORD_0"] = add_accessor(mesh.uvs, "VEC2");
        const std::size_t view =
            add_view(std::as_bytes(std::span{mesh.triangles}), kElementArrayBuffer);
        const std::size_t indices = push("accessors", {{"bufferView", view},
                                                       {"componentType", kUnsignedInt},
                                                       {"count", 3 * mesh.triangles.size()},
                                                       {"type", "SCALAR"}});
        Json primitive{
            {"attributes", attributes}, {"indices", indices}, {"material", mesh.material}};
        const std::size_t at = push("meshes", {{"primitives", Json::array({primitive})}});
        const std::size_t node = push("nodes", {{"mesh", at}, {"name", geometry_.name}});
        json_["scenes"][0]["nodes"].push_back(node);
    }

    const Geometry& geometry_;
    Json json_;
    std::vector<std::span<const std::byte>> parts_;
    std::deque<std::vector<std::uint8_t>> encoded_; ///< PNG files; a deque does not move them
    std::uint64_t size_ = 0;
    bool has_anisotropy_ = false;
};

} // namespace

void write_glb(const Geometry& geometry, const std::filesystem::path& path) {
    if (!geometry.curves.empty())
        throw Error(ErrorCode::InvalidArgument,
                    str("'", geometry.name, "' has curves, a .glb holds triangles"),
                    "write curves as .bcc or .hair", {.path = path.string()});
    bool has_triangle = false;
    for (const Mesh& mesh : geometry.meshes) has_triangle |= !mesh.triangles.empty();
    if (!has_triangle)
        throw Error(ErrorCode::InvalidArgument,
                    str("'", geometry.name, "' has no triangle to write"), {},
                    {.path = path.string()});
    GlbBuilder(geometry).write(path);
}

} // namespace heddle
