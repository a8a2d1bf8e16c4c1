#pragma once

#include <heddle/base/vec.h>
#include <heddle/io/file/problems.h>
#include <heddle/io/file/toml_text.h>

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heddle::scene_form {

/// The numbers that a key accepts. By default they are limited to those of a float, so that they
/// can be stored in one.
struct Range {
    double least = -static_cast<double>(std::numeric_limits<float>::max());
    double most = static_cast<double>(std::numeric_limits<float>::max());
    bool above = false; ///< `least` itself is excluded
    bool below = false; ///< `most` itself is excluded

    [[nodiscard]] bool holds(double x) const; ///< false for NaN
};
inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{.least = 0.0, .above = true};
inline constexpr Range kNotNegative{.least = 0.0};
inline constexpr Range kUnit{.least = 0.0, .most = 1.0};

/// Reads a table of a scene file; every function reads one key. A value of the wrong type or out of
/// range becomes a problem and leaves `out` unchanged, as an absent key does. `finish` reports keys
/// that nobody read, with the nearest name of those that were.
class TableReader {
public:
    /// @param what  for messages: "a light of kind 'point'"
    TableReader(const toml::table& table,
                FileLocation location,
                std::string what,
                Problems& problems);

    [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
    [[nodiscard]] const FileLocation& location() const { return location_; }
    [[nodiscard]] Problems& problems() const { return problems_; }
    /// The location of the key, or that of the table if the key is absent.
    [[nodiscard]] FileLocation location_of(std::string_view key) const;
    void set_what(std::string what) { what_ = std::move(what); }
    void problem(std::string_view key, const std::string& what, const std::string& fix) const;
    /// Adds a problem if the key is absent.
    void require(std::string_view key, const std::string& fix) const;

    void number(std::string_view key, double& out, const Range& range = kAnyNumber);
    void number(std::string_view key, float& out, const Range& range = kAnyNumber);
    /// The key is in degrees, `out` in radians.
    void angle(std::string_view key, float& out, const Range& range_deg);
    void integer(std::string_view key, std::int64_t& out, std::int64_t least, std::int64_t most);
    void integer(std::string_view key, int& out, std::int64_t least, std::int64_t most);
    void vector(std::string_view key, Vec3d& out);
    /// Reads three numbers, or one that stands for all three.
    /// @return  false if it became a problem
    bool color(std::string_view key, Vec3f& out, const Range& range = kNotNegative);
    /// `counts`: the allowed numbers of numbers; a bare number is a list of one.
    [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key,
                                                             std::initializer_list<int> counts,
                                                             const Range& range = kAnyNumber);
    void text(std::string_view key, std::string& out);
    /// Reads a path and makes it relative to the scene file; a problem if there is no such file, or
    /// if its suffix is not one of `suffixes` (lower case, with the dot; empty: any).
    void
    path(std::string_view key, std::string& out, std::initializer_list<std::string_view> suffixes);
    /// The index of the value in `names`.
    [[nodiscard]] std::optional<std::size_t> choose(std::string_view key,
                                                    const std::vector<std::string_view>& names);
    [[nodiscard]] const toml::table* table(std::string_view key);
    /// The tables in an array of tables.
    [[nodiscard]] std::vector<const toml::table*> tables(std::string_view key);
    /// The texts in an array of texts.
    [[nodiscard]] std::vector<std::string> texts(std::string_view key);

    /// Call it once, at the end: it adds a problem for each key that was not read.
    void finish() const;

private:
    const toml::node* take(std::string_view key);
    void wrong_type(std::string_view key, const toml::node& node, const std::string& needs) const;
    [[nodiscard]] bool in_range(std::string_view key, double x, const Range& range) const;

    const toml::table& table_;
    FileLocation location_;
    std::string what_;
    Problems& problems_;
    std::vector<std::string> known_;
};

/// The location of a node.
[[nodiscard]] FileLocation location_of(const toml::node& node, const std::string& path);

/// `text` resolved relative to the folder of the scene file `from`.
[[nodiscard]] std::string resolve_path(const std::string& text, const std::string& from);

} // namespace heddle::scene_form
