#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heddle::cli {

/// The values that the user gave, checked against the table. An option that was not given has the
/// preset of its row.
class Arguments {
public:
    /// @param values  at least one; several only if the option may be repeated
    void set(const std::string& key, const std::vector<std::string>& values) {
        given_[key] = values;
    }
    void set_preset(const std::string& key, const std::string& value) { preset_[key] = value; }

    [[nodiscard]] bool given(const std::string& key) const { return given_.contains(key); }
    [[nodiscard]] const std::string& text(const std::string& key) const;
    /// Returns all values of an option that may be repeated, in their order; none if it is not
    /// given.
    [[nodiscard]] std::vector<std::string> texts(const std::string& key) const;
    [[nodiscard]] std::int64_t integer(const std::string& key) const;
    [[nodiscard]] double number(const std::string& key) const;
    [[nodiscard]] std::vector<double> numbers(const std::string& key, char separator = ',') const;
    [[nodiscard]] std::int64_t bytes(const std::string& key) const;

    /// Return the value if the option is given, else nothing. An option that the command does not
    /// have is never given.
    [[nodiscard]] std::optional<std::string> find_text(const std::string& key) const;
    [[nodiscard]] std::optional<std::int64_t> find_integer(const std::string& key) const;
    [[nodiscard]] std::optional<double> find_number(const std::string& key) const;
    [[nodiscard]] std::optional<std::int64_t> find_bytes(const std::string& key) const;

    std::string command_line; ///< as the user typed it, with the quotes that a shell needs

private:
    std::map<std::string, std::vector<std::string>> given_;
    std::map<std::string, std::string> preset_;
};

} // namespace heddle::cli
