#pragma once

#include <heddle/geom/yarn.h>
#include <heddle/io/file/problems.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Shared by both textual formats of a yarn: the fields, their ranges and the problems found.
namespace heddle::yarn_form {

inline constexpr std::int64_t kMaxFibers = 1'000'000;

/// A pointer to a number, flag or pair of YarnType.
using Member = std::variant<float YarnType::*,
                            std::int32_t YarnType::*,
                            bool YarnType::*,
                            MeanSd YarnType::*,
                            Vec3f YarnType::*>;

/// A field: its key in TOML (the member's name) and in a fit (empty: none), its model and range.
struct Field {
    std::string_view key;
    std::string_view fit_key;
    YarnModel model; ///< the model that has the field; Solid: every model
    Member member;
    double least = 0.0, most = 0.0;
    bool above = false;     ///< `least` itself is excluded
    bool fit_needs = false; ///< required in a fit
};

[[nodiscard]] const std::vector<Field>& fields();
[[nodiscard]] std::string_view to_string(YarnModel model);

/// The problems of one file, by line.
class FileProblems {
public:
    explicit FileProblems(std::string path) : path_(std::move(path)) {}
    /// @param line  1-based; 0: the whole file
    void add(std::int64_t line, const std::string& text) { all_.add({path_, line}, text); }
    [[nodiscard]] Problems& all() { return all_; }

private:
    std::string path_;
    Problems all_;
};

/// Sets a field from its numbers (of a flag: 0 or 1), or adds a problem.
void set_field(YarnType& yarn,
               const Field& field,
               std::string_view key,
               const std::vector<double>& numbers,
               std::int64_t line,
               FileProblems& problems);

/// Checks combinations of fields, and fills in the fiber radius if it is 0.
/// @return a note on the fiber radius, or nothing
[[nodiscard]] std::string complete(YarnType& yarn, FileProblems& problems);

/// "; did you mean 'x'?" with the nearest known key, then all known keys if they are few.
[[nodiscard]] std::string suggest(std::string_view key, const std::vector<std::string_view>& known);

} // namespace heddle::yarn_form
