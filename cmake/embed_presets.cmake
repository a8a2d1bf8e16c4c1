# cmake -DOUT=<.cpp> -DPRESETS=<.toml,.toml...> -P embed_presets.cmake
# Writes a table of the names and texts of the files as C++, ascending by name.
string(REPLACE "," ";" PRESETS "${PRESETS}")
set(code "// Written by cmake/embed_presets.cmake from io/yarn/presets.\n")
string(APPEND code "#include <heddle/io/yarn/presets.h>\n\nnamespace heddle {\n\n")
string(APPEND code "std::span<const YarnPreset> yarn_presets() {\n")
string(APPEND code "    static constexpr YarnPreset kPresets[] = {\n")
foreach(file IN LISTS PRESETS)
  cmake_path(GET file STEM name)
  file(READ ${file} text)
  string(APPEND code "        {\"${name}\", R\"toml(${text})toml\"},\n")
endforeach()
string(APPEND code "    };\n    return kPresets;\n}\n\n} // namespace heddle\n")
file(WRITE ${OUT} "${code}")
