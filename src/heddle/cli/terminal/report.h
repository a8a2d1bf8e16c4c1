#pragma once

#include <nlohmann/json.hpp>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace heddle::cli {

/// What a command found out, row by row: printed as an aligned table, or as one JSON object.
///
/// Keys in JSON are the labels with '_' for ' ' and the unit: "peak memory" is "peak_memory_bytes".
class Report {
public:
    void text(const std::string& label, const std::string& value);
    /// @param unit  printed behind the number; "" for none
    void count(const std::string& label, std::int64_t value, const std::string& unit = {});
    void number(const std::string& label, double value, const std::string& unit = {});
    void bytes(const std::string& label, std::int64_t value);
    void seconds(const std::string& label, double value);
    /// Any JSON value, printed as `shown`.
    void add(const std::string& key,
             const std::string& label,
             nlohmann::ordered_json value,
             const std::string& shown);
    /// Rows under headings, the first cell of each as label; `value` says the same in JSON.
    void table(const std::string& key,
               nlohmann::ordered_json value,
               const std::vector<std::string>& headings,
               const std::vector<std::vector<std::string>>& rows);
    /// Any JSON value, in JSON alone.
    void data(const std::string& key, nlohmann::ordered_json value);
    /// Text that is printed as it is in place of the table; JSON does not hold it.
    void page(const std::string& text) { page_ = text; }
    /// One sentence that the user should see: in the JSON's "notes", and as say().
    void note(const std::string& sentence);
    /// On stderr at once, but once.
    void say(const std::string& sentence);

    /// An empty report of a part of the work: what one of them said on stderr, the others do not
    /// repeat.
    [[nodiscard]] Report part() const;
    /// All that JSON holds.
    [[nodiscard]] const nlohmann::ordered_json& values() const { return values_; }

    /// @throws Error  Internal: stdout cannot be written
    void print() const;

    bool json = false;
    bool quiet = false;                   ///< no notes, and no table
    std::vector<std::string> option_keys; ///< that notes may name: see in_option_words()

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
