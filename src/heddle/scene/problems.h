#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heddle::scene_form {

/// Where something stands in a scene file.
struct Place {
    std::string path;
    std::int64_t line = 0; ///< 1-based; 0: the file as a whole
};

/// "scene.toml:12".
[[nodiscard]] std::string to_string(const Place& place);

/// Collects what is wrong with a scene file and what it includes.
class Problems {
public:
    /// @param what  with the number or name found and what is allowed
    /// @param fix   what to do; may be empty
    void add(const Place& place, const std::string& what, const std::string& fix = {});
    /// @throws Error  BadFile when there is any problem: one a line, in the order of the files and
    /// of their lines
    void throw_if_any();

private:
    struct Problem {
        std::size_t file; ///< files are numbered as their first problems come
        std::int64_t line;
        std::string text;
    };
    std::vector<std::string> files_;
    std::vector<Problem> problems_;
};

} // namespace heddle::scene_form
