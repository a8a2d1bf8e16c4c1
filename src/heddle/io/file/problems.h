#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// Where something stands in a text file.
struct Place {
    std::string path;
    std::int64_t line = 0; ///< 1-based; 0: the file as a whole
};

/// "scene.toml:12".
[[nodiscard]] std::string to_string(const Place& place);

/// Collects what is wrong with a file, and with others that it includes.
class Problems {
public:
    /// @param what  with the number or name found and what is allowed
    /// @param fix   what to do; may be empty
    void add(const Place& place, const std::string& what, const std::string& fix = {});
    /// @throws Error  BadFile when there is any problem: one a line, in the order of the files and
    /// of their lines, what is wrong with a file as a whole last
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

} // namespace heddle
