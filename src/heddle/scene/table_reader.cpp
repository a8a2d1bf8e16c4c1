#include <heddle/scene/table_reader.h>

#include <heddle/base/error.h>
#include <heddle/base/nearest_name.h>
#include <heddle/io/file/input_file.h>
#include <heddle/io/yarn/yarn_file_form.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

namespace heddle::scene_form {
namespace {

std::string show(const Range& range) {
    std::string text;
    if (range.least > kAnyNumber.least) {
        text = range.above ? str("above ", range.least) : str(range.least, " or more");
    }
    if (range.most < kAnyNumber.most) {
        text += str(text.empty() ? "" : ", ", range.below ? "below " : "at most ", range.most);
    }
    return text.empty() ? "finite numbers" : text;
}

std::string join(const auto& items, const char* between, const char* quote) {
    std::string text;
    for (const auto& item : items) text += str(text.empty() ? "" : between, quote, item, quote);
    return text;
}

} // namespace

bool Range::holds(double x) const {
    return (above ? x > least : x >= least) && (below ? x < most : x <= most);
}

FileLocation location_of(const toml::node& node, const std::string& path) {
    return {path, static_cast<std::int64_t>(node.source().begin.line)};
}

std::string resolve_path(const std::string& text, const std::string& from) {
    return (std::filesystem::path(from).parent_path() / text).lexically_normal().string();
}

TableReader::TableReader(const toml::table& table,
                         FileLocation location,
                         std::string what,
                         Problems& problems)
    : table_(table), location_(std::move(location)), what_(std::move(what)), problems_(problems) {}

FileLocation TableReader::location_of(std::string_view key) const {
    const toml::node* node = table_.get(key);
    return node == nullptr ? location_ : scene_form::location_of(*node, location_.path);
}

void TableReader::problem(std::string_view key,
                          const std::string& what,
                          const std::string& fix) const {
    problems_.add(location_of(key), what, fix);
}

void TableReader::require(std::string_view key, const std::string& fix) const {
    if (!has(key)) problem(key, str(what_, " needs '", key, "'"), fix);
}

const toml::node* TableReader::take(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    return table_.get(key);
}

void TableReader::wrong_type(std::string_view key,
                             const toml::node& node,
                             const std::string& needs) const {
    problem(key, str("'", key, "' is of type ", node.type(), ", it takes ", needs),
            str("write ", needs));
}

bool TableReader::in_range(std::string_view key, double x, const Range& range) const {
    if (range.holds(x)) return true;
    problem(key, str("'", key, "' holds ", x, ", allowed: ", show(range)), "change it");
    return false;
}

std::optional<std::vector<double>>
TableReader::numbers(std::string_view key, std::initializer_list<int> counts, const Range& range) {
    const toml::node* node = take(key);
    if (node == nullptr) return std::nullopt;
    std::vector<double> values;
    const toml::array* array = node->as_array();
    const std::size_t count = array != nullptr ? array->size() : 1;
    const std::string needs =
        str(join(counts, " or ", ""), *counts.begin() == 1 ? " number" : " numbers");
    for (std::size_t i = 0; i < count; ++i) {
        const toml::node& item = array != nullptr ? *array->get(i) : *node;
        if (!item.is_number()) {
            wrong_type(key, item, needs);
            return std::nullopt;
        }
        values.push_back(item.value<double>().value());
        if (!in_range(key, values.back(), range)) return std::nullopt;
    }
    const auto same = [&](int n) { return static_cast<std::size_t>(n) == count; };
    if (std::none_of(counts.begin(), counts.end(), same)) {
        problem(key,
                str("'", key, "' has ", count, " numbers, it takes ", join(counts, " or ", "")),
                "add or drop some");
        return std::nullopt;
    }
    return values;
}

void TableReader::number(std::string_view key, double& out, const Range& range) {
    if (const auto values = numbers(key, {1}, range)) out = (*values)[0];
}

void TableReader::number(std::string_view key, float& out, const Range& range) {
    if (const auto values = numbers(key, {1}, range)) out = static_cast<float>((*values)[0]);
}

void TableReader::angle(std::string_view key, float& out, const Range& range_deg) {
    if (const auto values = numbers(key, {1}, range_deg)) {
        out = static_cast<float>((*values)[0] * (std::numbers::pi / 180.0));
    }
}

void TableReader::integer(std::string_view key,
                          std::int64_t& out,
                          std::int64_t least,
                          std::int64_t most) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    const auto x = node->value_exact<std::int64_t>();
    if (!x) {
        wrong_type(key, *node, "1 whole number");
    } else if (*x < least || *x > most) {
        problem(key, str("'", key, "' is ", *x, ", allowed: ", least, " to ", most), "change it");
    } else {
        out = *x;
    }
}

void TableReader::integer(std::string_view key, int& out, std::int64_t least, std::int64_t most) {
    std::int64_t value = out;
    integer(key, value, least, most);
    out = static_cast<int>(value);
}

void TableReader::vector(std::string_view key, Vec3d& out) {
    if (const auto v = numbers(key, {3})) out = {(*v)[0], (*v)[1], (*v)[2]};
}

bool TableReader::color(std::string_view key, Vec3f& out, const Range& range) {
    const auto v = numbers(key, {1, 3}, range);
    if (v)
        out =
            to_float(v->size() == 1 ? Vec3d{1, 1, 1} * (*v)[0] : Vec3d{(*v)[0], (*v)[1], (*v)[2]});
    return v || !has(key);
}

void TableReader::text(std::string_view key, std::string& out) {
    const toml::node* node = take(key);
    if (node == nullptr) return;
    const auto value = node->value_exact<std::string>();
    if (!value || value->empty()) {
        wrong_type(key, *node, "text that is not empty, in quotes");
    } else {
        out = *value;
    }
}

void TableReader::path(std::string_view key,
                       std::string& out,
                       std::initializer_list<std::string_view> suffixes) {
    std::string given;
    text(key, given);
    if (given.empty()) return;
    const std::string suffix = suffix_of(given);
    if (suffixes.size() > 0 &&
        std::find(suffixes.begin(), suffixes.end(), suffix) == suffixes.end()) {
        problem(key,
                str("'", key, "' names '", given, "'; no reader for the suffix '", suffix, "'"),
                str("known: ", join(suffixes, " ", "")));
        return;
    }
    std::string found = resolve_path(given, location_.path);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(found, ignored)) {
        problem(key, str("'", key, "': no file '", found, "'"),
                "name an existing file, relative to the scene file");
        return;
    }
    out = std::move(found);
}

std::optional<std::size_t> TableReader::choose(std::string_view key,
                                               const std::vector<std::string_view>& names) {
    const toml::node* node = take(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value_exact<std::string>();
    if (!value) {
        wrong_type(key, *node, str("one of ", join(names, ", ", "\"")));
        return std::nullopt;
    }
    const auto at = std::find(names.begin(), names.end(), *value);
    if (at == names.end()) {
        const std::string_view near = nearest_name(*value, names);
        problem(key, str("'", key, "' is '", value->substr(0, 64), "'"),
                str(near.empty() ? "" : str("did you mean '", near, "'? "),
                    "known: ", join(names, ", ", "")));
        return std::nullopt;
    }
    return static_cast<std::size_t>(at - names.begin());
}

const toml::table* TableReader::table(std::string_view key) {
    const toml::node* node = take(key);
    if (node != nullptr && !node->is_table()) wrong_type(key, *node, str("a table, [", key, "]"));
    return node == nullptr ? nullptr : node->as_table();
}

std::vector<const toml::table*> TableReader::tables(std::string_view key) {
    std::vector<const toml::table*> out;
    const toml::node* node = take(key);
    if (node == nullptr) return out;
    const toml::array* array = node->as_array();
    if (array == nullptr) wrong_type(key, *node, str("tables, each under [[", key, "]]"));
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
        const toml::node& item = *array->get(i);
        if (!item.is_table()) wrong_type(key, item, str("tables, each under [[", key, "]]"));
        if (item.is_table()) out.push_back(item.as_table());
    }
    return out;
}

std::vector<std::string> TableReader::texts(std::string_view key) {
    std::vector<std::string> out;
    const toml::node* node = take(key);
    if (node == nullptr) return out;
    const toml::array* array = node->as_array();
    if (array == nullptr) wrong_type(key, *node, "texts in brackets");
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
        const auto value = array->get(i)->value_exact<std::string>();
        if (!value || value->empty()) wrong_type(key, *array->get(i), "texts in brackets");
        if (value && !value->empty()) out.push_back(*value);
    }
    return out;
}

void TableReader::finish() const {
    const std::vector<std::string_view> known(known_.begin(), known_.end());
    for (const auto& [key, node] : table_) {
        const std::string_view name = key.str();
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        problem(name,
                str("unknown key '", name.substr(0, 64), "' in ", what_,
                    yarn_form::suggest(name, known)),
                {});
    }
}

} // namespace heddle::scene_form
