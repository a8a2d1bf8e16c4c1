#include <heddle/io/gltf/gltf_model.h>

#include <heddle/base/error.h>
#include <heddle/io/file/input_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

namespace heddle {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxBytes = 0xFFFFFFFF; // a .glb counts its bytes in 32 bits
constexpr int kMaxNesting = 64;                 // of JSON; tinygltf recurses once per level

/// tinygltf also looks into the working folder: only the model's folder may answer.
struct Files {
    std::string prefix;
    static bool exists(const std::string& name, void* self) {
        std::error_code error;
        return name.starts_with(static_cast<const Files*>(self)->prefix) &&
               fs::is_regular_file(name, error);
    }
    static std::string expand(const std::string& name, void*) { return name; }
    static bool
    read(std::vector<unsigned char>* out, std::string* error, const std::string& name, void*) {
        try {
            const std::string bytes = read_whole_file(name, kMaxBytes);
            out->assign(bytes.begin(), bytes.end());
            return true;
        } catch (const Error& e) {
            *error = e.what();
            return false;
        }
    }
};

/// Keeps the bytes of images inside the JSON; those in buffers and files are found when used.
bool keep_image(tinygltf::Image* image,
                const int,
                std::string*,
                std::string*,
                int,
                int,
                const unsigned char* bytes,
                int size,
                void*) {
    if (image->bufferView < 0 && image->uri.empty()) image->image.assign(bytes, bytes + size);
    return true;
}

bool starts_as_json(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{';
}

bool is_nested_too_deep(std::string_view json) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > kMaxNesting) return true;
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return false;
}

std::uint32_t u32_at(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;)
        value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + k]);
    return value;
}

double component(const unsigned char* at, int type, bool normalized) {
    const auto load = [at](auto value) {
        std::memcpy(&value, at, sizeof value);
        return value;
    };
    const auto scaled = [normalized](auto value) {
        const double largest = std::numeric_limits<decltype(value)>::max();
        return normalized ? std::max(static_cast<double>(value) / largest, -1.0)
                          : static_cast<double>(value);
    };
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled(load(std::int8_t{}));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scaled(load(std::uint8_t{}));
    case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled(load(std::int16_t{}));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return scaled(load(std::uint16_t{}));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return scaled(load(std::uint32_t{}));
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return static_cast<double>(load(float{}));
    default: return std::numeric_limits<double>::quiet_NaN();
    }
}

/// An array inside a buffer view, after its checks.
struct Array {
    const unsigned char* data = nullptr;
    std::size_t stride = 0;
    std::size_t component_size = 0;
};

Array array_in(const GltfModel& model,
               int buffer_view,
               std::uint64_t offset,
               std::uint64_t count,
               int component_type,
               int components,
               const std::string& what) {
    const std::span<const unsigned char> bytes = model.view(buffer_view);
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type));
    if (size <= 0 || components <= 0) model.fail(str(what, " has an unknown type"));
    const auto element = static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(components);
    const std::uint64_t named =
        model->bufferViews[static_cast<std::size_t>(buffer_view)].byteStride;
    const std::uint64_t stride = named == 0 ? element : named;
    if (stride < element)
        model.fail(str(what, " has elements of ", element, " bytes every ", stride));
    const std::uint64_t most = offset > bytes.size() || bytes.size() - offset < element
                                   ? 0
                                   : (bytes.size() - offset - element) / stride + 1;
    if (count > most)
        model.fail(str(what, " has ", count, " elements, and its buffer view holds only ", most));
    return {bytes.data() + offset, stride, static_cast<std::size_t>(size)};
}

/// The parser's message without the name of its exception and its full stop.
std::string parser_words(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    if (text.starts_with("[json.exception")) text.erase(0, text.find("] ") + 2);
    return text.empty() ? "is not a glTF 2.0 file" : text;
}

} // namespace

GltfModel::GltfModel(const fs::path& path) : path_(path) {
    const std::string bytes = read_whole_file(path.string(), kMaxBytes);
    parse(std::as_bytes(std::span{bytes}));
    for (const auto& buffer : model_.buffers) held_bytes_ += buffer.data.size();
    for (const std::string& name : model_.extensionsRequired) {
        if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression")
            throw Error(ErrorCode::Unsupported, str("its geometry is compressed by ", name),
                        "export it without compression", {.path = path_.string()});
    }
}

/// The JSON of a .gltf or .glb, after checking the sizes of the .glb.
std::string_view GltfModel::json_in(std::span<const std::byte> bytes, bool binary) const {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!binary) return text;
    if (bytes.size() < 20) fail(str("has ", bytes.size(), " bytes, a .glb has 20 or more"));
    if (u32_at(bytes, 8) != bytes.size())
        fail(str("says ", u32_at(bytes, 8), " bytes and has ", bytes.size()));
    if (u32_at(bytes, 12) > bytes.size() - 20)
        fail(str("says ", u32_at(bytes, 12), " bytes of JSON and has ", bytes.size() - 20));
    return text.substr(20, u32_at(bytes, 12));
}

void GltfModel::parse(std::span<const std::byte> bytes) {
    const bool binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
    if (!binary && !starts_as_json(bytes))
        fail("is not a glTF file: it starts with neither 'glTF' nor '{'");
    if (is_nested_too_deep(json_in(bytes, binary)))
        fail(str("JSON is nested deeper than ", kMaxNesting, " levels"));
    const std::string folder = path_.has_parent_path() ? path_.parent_path().string() : ".";
    Files files{folder + "/"};
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&keep_image, nullptr);
    loader.SetFsCallbacks({&Files::exists, &Files::expand, &Files::read, nullptr, &files});
    std::string error;
    std::string warning;
    const auto size = static_cast<unsigned int>(bytes.size());
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const bool loaded =
        binary ? loader.LoadBinaryFromMemory(&model_, &error, &warning, data, size, folder)
               : loader.LoadASCIIFromString(&model_, &error, &warning, text, size, folder);
    if (!loaded || !error.empty()) fail(parser_words(error));
}

void GltfModel::fail(const std::string& what) const {
    throw Error(ErrorCode::BadFile, what, "export the file again", {.path = path_.string()});
}

const tinygltf::Accessor& GltfModel::accessor(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size())
        fail(str("names accessor ", index, " of ", model_.accessors.size()));
    return model_.accessors[static_cast<std::size_t>(index)];
}

std::span<const unsigned char> GltfModel::view(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.bufferViews.size())
        fail(str("names buffer view ", index, " of ", model_.bufferViews.size()));
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size())
        fail(str("buffer view ", index, " names buffer ", view.buffer, " of ",
                 model_.buffers.size()));
    const std::vector<unsigned char>& data =
        model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        fail(str("buffer view ", index, " has ", view.byteLength, " bytes from byte ",
                 view.byteOffset, ", its buffer has ", data.size()));
    return std::span(data).subspan(view.byteOffset, view.byteLength);
}

std::vector<float> GltfModel::floats(int index, int components, const std::string& what) const {
    const tinygltf::Accessor& from = accessor(index);
    const int held = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(from.type));
    if (held < components) fail(str(what, " has ", held, " components, expected ", components));
    const auto width = static_cast<std::size_t>(components);
    std::vector<float> out;
    if (from.bufferView < 0) {
        // Zeros, as glTF says; a count that no bytes of the file confirm must not allocate memory.
        if (from.count > held_bytes_)
            fail(str(what, " has ", from.count, " elements and no buffer view"));
        out.resize(from.count * width);
    } else {
        const Array array = array_in(*this, from.bufferView, from.byteOffset, from.count,
                                     from.componentType, held, what);
        out.reserve(from.count * width);
        for (std::size_t i = 0; i < from.count; ++i) {
            for (std::size_t k = 0; k < width; ++k)
                out.push_back(static_cast<float>(
                    component(array.data + i * array.stride + k * array.component_size,
                              from.componentType, from.normalized)));
        }
    }
    if (from.sparse.isSparse) put_sparse(from, components, out);
    const auto bad =
        std::find_if_not(out.begin(), out.end(), [](float v) { return std::isfinite(v); });
    if (bad != out.end())
        fail(str(what, " of vertex ", (bad - out.begin()) / components, " has the value ", *bad,
                 ", all must be finite"));
    return out;
}

void GltfModel::put_sparse(const tinygltf::Accessor& from,
                           int components,
                           std::vector<float>& values) const {
    const auto& sparse = from.sparse;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        fail("a sparse accessor has a negative count or offset");
    const int held = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(from.type));
    const auto count = static_cast<std::uint64_t>(sparse.count);
    const auto at = array_in(*this, sparse.indices.bufferView,
                             static_cast<std::uint64_t>(sparse.indices.byteOffset), count,
                             sparse.indices.componentType, 1, "a sparse accessor's indices");
    const auto put = array_in(*this, sparse.values.bufferView,
                              static_cast<std::uint64_t>(sparse.values.byteOffset), count,
                              from.componentType, held, "a sparse accessor's values");
    const auto width = static_cast<std::size_t>(components);
    for (std::size_t i = 0; i < count; ++i) {
        const double element =
            component(at.data + i * at.stride, sparse.indices.componentType, false);
        if (!(element >= 0.0 && element < static_cast<double>(from.count)))
            fail(str("a sparse accessor names element ", element, " of ", from.count));
        for (std::size_t k = 0; k < width; ++k)
            values[static_cast<std::size_t>(element) * width + k] =
                static_cast<float>(component(put.data + i * put.stride + k * put.component_size,
                                             from.componentType, from.normalized));
    }
}

std::vector<std::uint32_t> GltfModel::indices(int index, std::uint64_t limit) const {
    const tinygltf::Accessor& from = accessor(index);
    if (from.type != TINYGLTF_TYPE_SCALAR || from.sparse.isSparse ||
        (from.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
         from.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         from.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
        fail(str("accessor ", index, " is used for indices but has no unsigned integers"));
    const Array array = array_in(*this, from.bufferView, from.byteOffset, from.count,
                                 from.componentType, 1, "an index accessor");
    std::vector<std::uint32_t> out;
    out.reserve(from.count);
    for (std::size_t i = 0; i < from.count; ++i) {
        const double value = component(array.data + i * array.stride, from.componentType, false);
        if (value >= static_cast<double>(limit))
            fail(str("index ", i, " names vertex ", value, " of ", limit));
        out.push_back(static_cast<std::uint32_t>(value));
    }
    return out;
}

const tinygltf::Value* find_member(const tinygltf::Value& object, const char* key) {
    return object.IsObject() && object.Has(key) ? &object.Get(key) : nullptr;
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& map, const char* name) {
    const auto place = map.find(name);
    return place != map.end() && place->second.IsObject() ? &place->second : nullptr;
}

double number_or(const tinygltf::Value& object, const char* key, double fallback) {
    const tinygltf::Value* value = find_member(object, key);
    if (value == nullptr || !value->IsNumber()) return fallback;
    const double number = value->GetNumberAsDouble();
    return std::isfinite(number) ? number : fallback;
}

} // namespace heddle
