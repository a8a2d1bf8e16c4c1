#pragma once

#include <tiny_gltf.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace heddle {

/// A glTF file as read by tinygltf, with the checks that tinygltf omits. Images stay encoded.
class GltfModel {
public:
    /// @throws NotFound, BadFile; Unsupported for geometry compressed by Draco or meshopt
    explicit GltfModel(const std::filesystem::path& path);

    [[nodiscard]] const tinygltf::Model& operator*() const { return model_; }
    [[nodiscard]] const tinygltf::Model* operator->() const { return &model_; }
    [[nodiscard]] std::filesystem::path folder() const { return path_.parent_path(); }

    /// The values of an accessor, element by element: floats unchanged, normalized integers divided
    /// by their largest value, other integers converted; sparse parts inserted.
    /// @param components  numbers per element that are wanted; the element may have more
    /// @param what        the attribute's name, for messages
    /// @throws BadFile: it exceeds its buffer, or a value is not finite
    [[nodiscard]] std::vector<float>
    floats(int accessor, int components, const std::string& what) const;

    /// The values of an index accessor.
    /// @param limit  every index must be below it
    /// @throws BadFile
    [[nodiscard]] std::vector<std::uint32_t> indices(int accessor, std::uint64_t limit) const;

    /// The bytes of a buffer view.
    /// @throws BadFile: it exceeds its buffer
    [[nodiscard]] std::span<const unsigned char> view(int buffer_view) const;

    /// Throws BadFile with the path of the file.
    [[noreturn]] void fail(const std::string& what) const;

private:
    [[nodiscard]] std::string_view json_in(std::span<const std::byte> bytes, bool binary) const;
    void parse(std::span<const std::byte> bytes);
    const tinygltf::Accessor& accessor(int index) const;
    void
    put_sparse(const tinygltf::Accessor& from, int components, std::vector<float>& values) const;

    std::filesystem::path path_;
    tinygltf::Model model_;
    std::uint64_t held_bytes_ = 0; ///< of all buffers
};

/// The member `key` of a JSON object; nullptr if there is none.
[[nodiscard]] const tinygltf::Value* find_member(const tinygltf::Value& object, const char* key);

/// The extension with this name; nullptr if there is none or it is not an object.
[[nodiscard]] const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& map,
                                                    const char* name);

/// The number `key` of a JSON object; `fallback` if there is none, or it is not finite.
[[nodiscard]] double number_or(const tinygltf::Value& object, const char* key, double fallback);

} // namespace heddle
