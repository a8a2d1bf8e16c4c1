#pragma once

#include <heddle/base/error.h>

#include <array>
#include <charconv>
#include <string>
#include <string_view>

namespace heddle::viewer {

/// GLSL: a line that defines a constant with a value from C++.
[[nodiscard]] inline std::string glsl_constant(std::string_view name, int value) {
    return str("const int ", name, " = ", value, ";\n");
}
/// The value has as many digits as are needed to read the same float.
[[nodiscard]] inline std::string glsl_constant(std::string_view name, float value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return str("const float ", name, " = ", std::string_view(text.data(), end), ";\n");
}

} // namespace heddle::viewer
