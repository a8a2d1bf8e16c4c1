#include <heddle/base/error.h>
#include <heddle/base/format_number.h>
#include <heddle/cli/terminal/option_words.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace heddle::cli {
namespace {

std::string key_of(std::string label, const std::string& unit) {
    std::replace(label.begin(), label.end(), ' ', '_');
    return unit.empty() ? label : label + "_" + unit;
}

std::string with_unit(std::string text, const std::string& unit) {
    return unit.empty() ? text : text + " " + unit;
}

} // namespace

void Report::add(const std::string& key,
                 const std::string& label,
                 nlohmann::ordered_json value,
                 const std::string& shown) {
    values_[key] = std::move(value);
    rows_.emplace_back(label, shown);
}

void Report::data(const std::string& key, nlohmann::ordered_json value) {
    values_[key] = std::move(value);
}
void Report::text(const std::string& label, const std::string& value) {
    add(key_of(label, ""), label, value, value);
}
void Report::count(const std::string& label, std::int64_t value, const std::string& unit) {
    add(key_of(label, ""), label, value, with_unit(format_count(static_cast<double>(value)), unit));
}
void Report::number(const std::string& label, double value, const std::string& unit) {
    add(key_of(label, ""), label, value, with_unit(str(value), unit));
}
void Report::bytes(const std::string& label, std::int64_t value) {
    add(key_of(label, "bytes"), label, value, format_bytes(static_cast<double>(value)));
}
void Report::seconds(const std::string& label, double value) {
    add(key_of(label, "seconds"), label, value, format_seconds(value));
}

void Report::table(const std::string& key,
                   nlohmann::ordered_json value,
                   const std::vector<std::string>& headings,
                   const std::vector<std::vector<std::string>>& rows) {
    values_[key] = std::move(value);
    std::vector<std::size_t> widths;
    for (const std::string& heading : headings) widths.push_back(heading.size());
    for (const std::vector<std::string>& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    const auto add_line = [&](const std::vector<std::string>& row) {
        std::string line;
        for (std::size_t i = 1; i < row.size(); ++i) {
            line += row[i];
            if (i + 1 < row.size()) line += std::string(widths[i] + 2 - row[i].size(), ' ');
        }
        rows_.emplace_back(row[0], line);
    };
    add_line(headings);
    for (const std::vector<std::string>& row : rows) add_line(row);
}

void Report::note(const std::string& sentence) {
    values_["notes"].push_back(in_option_words(sentence, option_keys));
    say(sentence);
}

void Report::say(const std::string& sentence) {
    const std::string text = in_option_words(sentence, option_keys);
    const bool first = said_->insert(text).second;
    if (!quiet && first) std::fprintf(stderr, "note: %s\n", text.c_str());
}

Report Report::part() const {
    Report out;
    out.json = json;
    out.quiet = quiet;
    out.option_keys = option_keys;
    out.said_ = said_;
    return out;
}

void Report::print() const {
    if (json) {
        // a file name that is not UTF-8 must not make the whole result fail
        print_out(values_.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
        return;
    }
    if (quiet) return;
    if (!page_.empty()) return print_out(page_);
    std::size_t width = 0;
    for (const auto& [label, shown] : rows_) width = std::max(width, label.size());
    std::string out;
    for (const auto& [label, shown] : rows_) {
        out += label + std::string(width + 2 - label.size(), ' ') + shown + "\n";
    }
    print_out(out);
}

void print_out(const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0) {
        throw Error(ErrorCode::Internal, str("stdout cannot be written: ", std::strerror(errno)));
    }
}

} // namespace heddle::cli
