#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace heddle {

enum class PlyFormat : std::uint8_t { Ascii, LittleEndian, BigEndian };
enum class PlyType : std::uint8_t { I8, U8, I16, U16, I32, U32, F32, F64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::F32;
    bool is_list = false;
    PlyType count_type = PlyType::U8; ///< type of a list's length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Index of the first property with one of these names; -1: there is none.
    [[nodiscard]] int find(std::initializer_list<const char*> names) const;
};

/// A .ply file: its header, then its values in order, whatever their encoding.
///
/// Debian has no package of a small PLY library, and Assimp (which reads PLY) drops edges and would
/// add 100 MB of dependencies to replace one page of code.
class PlyData {
public:
    /// Reads the file and its header.
    /// @throws NotFound, BadFile
    explicit PlyData(const std::filesystem::path& path);

    [[nodiscard]] const std::vector<PlyElement>& elements() const { return elements_; }

    /// The next value; a double holds each of the eight types exactly.
    /// @throws BadFile: the file ends, or the text is not a number
    double next(PlyType type);

    /// The length of the list that starts here, checked against the rest of the file.
    std::uint64_t next_count(const PlyProperty& property);

    /// Skips the value of a property.
    void skip(const PlyProperty& property);

    /// Checks that the rows of `element` fit into the rest of the file.
    void check_rows(const PlyElement& element) const;

    /// Throws BadFile at the current position.
    [[noreturn]] void fail(const std::string& what) const;

private:
    void read_header();
    void read_header_line(const std::string& line);
    double next_number();
    [[nodiscard]] std::uint64_t least_bytes(PlyType type) const;

    std::string path_;
    std::string text_; ///< the whole file, binary or not
    std::size_t at_ = 0;
    PlyFormat format_ = PlyFormat::Ascii;
    bool has_format_ = false;
    std::vector<PlyElement> elements_;
};

} // namespace heddle
