#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace heddle {

/// A checked .obj file: only the statements that the parser needs.
struct ObjText {
    std::string statements;             ///< lines of v, vt, vn, f, l, usemtl
    std::vector<std::string> libraries; ///< the rest of each mtllib line
};

/// Reads an .obj file and checks what tinyobjloader does not: that numbers are finite, and that
/// every index of a face or line is in range. Lines may end with "\n", "\r\n" or "\r". Statements
/// that heddle does not use are dropped here, so that their parsers need not be trusted.
/// @throws NotFound, BadFile with the line
[[nodiscard]] ObjText read_obj_text(const std::filesystem::path& path);

} // namespace heddle
