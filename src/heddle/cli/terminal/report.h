#pragma once

#include <nlohmann/json.hpp>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace heddle::cli {

/// The results of a command, row by row. They are printed as an aligned table or as a JSON object.
///
/// A key in JSON is the label with '_' for ' ', followed by the unit: the key of "peak memory" is
/// "peak_memory_bytes".
class Report {
public:
    void text(const std::string& label, const std::string& value);
    /// @param unit  is printed after the number; "" for none
    void count(const std::string& label, std::int64_t value, const std::string& unit = {});
    void number(const std::string& label, double value, const std::string& unit = {});
    void bytes(const std::string& label, std::int64_t value);
    void seconds(const std::string& label, double value);
    /// Adds any JSON value, which the table shows as `shown`.
    void add(const std::string& key,
             const std::string& label,
             nlohmann::ordered_json value,
             const std::string& shown);
    /// Adds rows under headings; the first entry of each is its label. `value` is the same in JSON.
    void table(const std::string& key,
               nlohmann::ordered_json value,
               const std::vector<std::string>& headings,
               const std::vector<std::vector<std::string>>& rows);
    /// Adds any JSON value that the table does not show.
    void data(const std::string& key, nlohmann::ordered_json value);
    /// Sets a text that is printed instead of the table. It is not in JSON.
    void page(const std::string& text) { page_ = text; }
    /// Adds a sentence to the "notes" of the JSON, and prints it as say() does.
    void note(const std::string& sentence);
    /// Prints a sentence on stderr at once, unless it was printed before.
    void say(const std::string& sentence);

    /// Returns an empty report for a part of the work. A sentence that one part has printed on
    /// stderr is not repeated by another.
    [[nodiscard]] Report part() const;
    /// Returns everything that is in JSON.
    [[nodiscard]] const nlohmann::ordered_json& values() const { return values_; }

    /// @throws Error  Internal: stdout cannot be written
    void print() const;

    bool json = false;
    bool quiet = false;                   ///< no notes, and no table
    std::vector<std::string> option_keys; ///< for in_option_words(), which notes pass through

private:
    nlohmann::ordered_json values_ = nlohmann::ordered_json::object();
    std::vector<std::pair<std::string, std::string>> rows_;
    std::string page_;
    std::shared_ptr<std::set<std::string>> said_ = std::make_shared<std::set<std::string>>();
};

/// Writes `text` to stdout.
/// @throws Error  Internal: stdout cannot be written
void print_out(const std::string& text);

} // namespace heddle::cli
