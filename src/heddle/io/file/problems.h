#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heddle {

/// A line of a text file, for messages.
struct FileLocation {
    std::string path;
    std::int64_t line = 0; ///< 1-based; 0: the whole file
};

/// "scene.toml:12".
[[nodiscard]] std::string to_string(const FileLocation& location);

/// Collects the problems of a file and of the files that it includes.
class Problems {
public:
    /// @param what  the problem, with the number or name that was found and what is allowed
    /// @param fix   what to do; may be empty
    void add(const FileLocation& location, const std::string& what, const std::string& fix = {});
    /// @throws Error  BadFile if there is any problem: one per line, in the order of the files and
    ///                of their lines; problems of a whole file are last
    void throw_if_any();

private:
    struct Problem {
        std::size_t file; ///< files are numbered in the order of their first problems
        std::int64_t line;
        std::string text;
    };
    std::vector<std::string> files_;
    std::vector<Problem> problems_;
};

} // namespace heddle
