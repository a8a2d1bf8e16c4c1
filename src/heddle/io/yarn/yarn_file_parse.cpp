#include <heddle/io/yarn/yarn_file.h>

#include <heddle/base/error.h>
#include <heddle/io/file/toml_text.h>
#include <heddle/io/yarn/yarn_file_form.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace heddle {
namespace {

using yarn_form::Field;
using yarn_form::FileProblems;

YarnFile finish(YarnType yarn, FileProblems& problems) {
    const std::string note = yarn_form::complete(yarn, problems);
    problems.all().throw_if_any();
    YarnFile file{std::move(yarn), {}};
    if (!note.empty()) file.notes.push_back(note);
    return file;
}

std::string_view trim(std::string_view s) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!s.empty() && blank(s.front())) s.remove_prefix(1);
    while (!s.empty() && blank(s.back())) s.remove_suffix(1);
    return s;
}

/// Numbers separated by blanks, commas and brackets; nothing if one of them is not a number.
std::optional<std::vector<double>> parse_numbers(std::string_view text) {
    std::vector<double> numbers;
    const char* p = text.data();
    const char* end = p + text.size();
    while (true) {
        while (p != end && std::string_view(" \t,[]").find(*p) != std::string_view::npos) ++p;
        if (p == end) return numbers;
        double x = 0.0;
        const auto [next, error] = std::from_chars(p, end, x);
        if (error == std::errc::invalid_argument) return std::nullopt;
        if (error == std::errc::result_out_of_range) x = std::numeric_limits<double>::infinity();
        if (next != end && std::string_view(" \t,[]").find(*next) == std::string_view::npos) {
            return std::nullopt;
        }
        numbers.push_back(x);
        p = next;
    }
}

/// Settings of how the fit was sampled; they say nothing about the yarn.
constexpr std::array<std::string_view, 5> kFitSettings{"aabb_min", "aabb_max", "z_step_size",
                                                       "z_step_num", "fly_step_size"};

using Lines = std::map<std::string, std::int64_t, std::less<>>; ///< key to its line

void read_fit_line(
    std::string_view line, std::int64_t n, YarnType& yarn, Lines& seen, FileProblems& p) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) {
        p.add(n, "is not a line 'key: value'");
        return;
    }
    const std::string_view key = trim(line.substr(0, colon));
    const auto [at, fresh] = seen.emplace(key, n);
    if (!fresh) {
        p.add(n, str("'", key, "' stands on line ", at->second, " already"));
        return;
    }
    const auto numbers = parse_numbers(line.substr(colon + 1));
    if (!numbers || numbers->empty()) {
        p.add(n, str("'", key, "' needs numbers"));
        return;
    }
    if (std::find(kFitSettings.begin(), kFitSettings.end(), key) != kFitSettings.end()) return;
    std::vector<std::string_view> known;
    for (const Field& field : yarn_form::fields()) {
        if (field.fit_key.empty()) continue;
        if (field.fit_key == key) return set_field(yarn, field, key, *numbers, n, p);
        known.push_back(field.fit_key);
    }
    p.add(n, str("unknown key '", key.substr(0, 64), "'", yarn_form::suggest(key, known)));
}

void require_fit_keys(const YarnType& yarn, const Lines& seen, FileProblems& problems) {
    for (const Field& field : yarn_form::fields()) {
        const std::string_view key = field.fit_key;
        const bool migration = key == "s_i" || key.substr(0, 4) == "rho_";
        const bool flyaway = key.substr(0, 8) == "flyaway_";
        const bool needed =
            field.fit_needs || (migration && yarn.migration) || (flyaway && yarn.flyaways);
        if (needed && seen.find(key) == seen.end()) problems.add(0, str("'", key, "' is missing"));
    }
}

/// The numbers of a TOML value: of a number, a flag or an array of numbers.
std::optional<std::vector<double>> toml_numbers(const toml::node& node) {
    std::vector<double> numbers;
    const auto add = [&](const toml::node& n) {
        const auto x = n.is_number() ? n.value<double>() : std::nullopt;
        if (x) numbers.push_back(*x);
        return x.has_value();
    };
    if (const auto flag = node.value_exact<bool>()) return std::vector<double>{*flag ? 1.0 : 0.0};
    if (const toml::array* array = node.as_array()) {
        for (const toml::node& n : *array) {
            if (!add(n)) return std::nullopt;
        }
        return numbers;
    }
    if (!add(node)) return std::nullopt;
    return numbers;
}

std::int64_t line_of(const toml::node& node) {
    return static_cast<std::int64_t>(node.source().begin.line);
}

void read_model(const toml::table& table, YarnType& yarn, FileProblems& problems) {
    const toml::node* node = table.get("model");
    if (node == nullptr) {
        problems.add(0, "'model' is missing; it is \"procedural\", \"slice\" or \"solid\"");
        return;
    }
    const auto text = node->value_exact<std::string>();
    for (const YarnModel m : {YarnModel::Solid, YarnModel::Procedural, YarnModel::Slice}) {
        if (text == yarn_form::to_string(m)) {
            yarn.model = m;
            return;
        }
    }
    problems.add(line_of(*node), "'model' must be \"procedural\", \"slice\" or \"solid\"");
}

/// Reads name and slice, the keys whose values are text.
void read_text_key(const toml::node& node,
                   std::string_view key,
                   const std::string& path,
                   const LoadTexture& load,
                   YarnType& yarn,
                   FileProblems& problems) {
    const auto text = node.value_exact<std::string>();
    if (!text || text->empty()) {
        problems.add(line_of(node), str("'", key, "' must be text that is not empty"));
    } else if (key == "name") {
        yarn.name = *text;
    } else if (yarn.model != YarnModel::Slice) {
        problems.add(line_of(node), "'slice' belongs to the model \"slice\"");
    } else if (!load) {
        problems.add(line_of(node), "a slice yarn cannot be used here, no image can be loaded");
    } else {
        yarn.slice = load((std::filesystem::path(path).parent_path() / *text).string());
        if (yarn.slice.channels != 4) {
            problems.add(line_of(node), str("the image '", *text, "' has ", yarn.slice.channels,
                                            " channels, a slice needs RGB and alpha"));
            yarn.slice = {};
        }
        yarn.slice.name = *text; // as in the file, so that it can be written again
    }
}

void read_number_key(const toml::node& node,
                     std::string_view key,
                     YarnType& yarn,
                     FileProblems& problems) {
    std::vector<std::string_view> known{"model", "name", "slice"};
    for (const Field& field : yarn_form::fields()) {
        known.push_back(field.key);
        if (field.key != key) continue;
        const bool flag = std::holds_alternative<bool YarnType::*>(field.member);
        const auto numbers = toml_numbers(node);
        if (field.model != YarnModel::Solid && field.model != yarn.model) {
            problems.add(line_of(node), str("'", key, "' belongs to the model \"",
                                            yarn_form::to_string(field.model), "\", this one is \"",
                                            yarn_form::to_string(yarn.model), "\""));
        } else if (flag != node.is_boolean() || !numbers) {
            problems.add(line_of(node),
                         str("'", key, flag ? "' must be true or false" : "' needs numbers"));
        } else {
            set_field(yarn, field, key, *numbers, line_of(node), problems);
        }
        return;
    }
    problems.add(line_of(node),
                 str("unknown key '", key.substr(0, 64), "'", yarn_form::suggest(key, known)));
}

/// The shortest decimal that is read as the same float.
std::string shortest(float x) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x).ptr};
}

std::string toml_value(const YarnType& yarn, const Field& field) {
    if (const auto* m = std::get_if<float YarnType::*>(&field.member)) return shortest(yarn.**m);
    if (const auto* m = std::get_if<std::int32_t YarnType::*>(&field.member)) return str(yarn.**m);
    if (const auto* m = std::get_if<bool YarnType::*>(&field.member)) {
        return yarn.**m ? "true" : "false";
    }
    if (const auto* m = std::get_if<MeanSd YarnType::*>(&field.member)) {
        const MeanSd v = yarn.**m;
        return str("[", shortest(v.mean), ", ", shortest(v.sd), "]");
    }
    const Vec3f v = yarn.*std::get<Vec3f YarnType::*>(field.member);
    return str("[", shortest(v.x), ", ", shortest(v.y), ", ", shortest(v.z), "]");
}

} // namespace

YarnFile parse_yarn_fit(const std::string& text, const std::string& path) {
    FileProblems problems(path);
    YarnType yarn;
    yarn.model = YarnModel::Procedural;
    yarn.name = std::filesystem::path(path).stem().string();
    Lines seen;
    std::string_view rest = text;
    for (std::int64_t n = 1; !rest.empty(); ++n) {
        const std::size_t end = rest.find('\n');
        const std::string_view line = trim(rest.substr(0, end));
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        if (!line.empty()) read_fit_line(line, n, yarn, seen, problems);
    }
    require_fit_keys(yarn, seen, problems);
    yarn.ply_offset = 0.5f * yarn.model_radius;
    return finish(std::move(yarn), problems);
}

YarnFile
parse_yarn_toml(const std::string& text, const std::string& path, const LoadTexture& load) {
    FileProblems problems(path);
    const auto table = parse_toml(text, path, problems.all());
    problems.all().throw_if_any();
    YarnType yarn;
    yarn.name = std::filesystem::path(path).stem().string();
    read_model(*table, yarn, problems);
    problems.all().throw_if_any(); // the allowed keys depend on the model
    for (const auto& [key, node] : *table) {
        if (key == "model") continue;
        if (key == "name" || key == "slice") {
            read_text_key(node, key, path, load, yarn, problems);
        } else {
            read_number_key(node, key, yarn, problems);
        }
    }
    if (yarn.model == YarnModel::Slice && !table->contains("slice")) {
        problems.add(0, "'slice' is missing, the path of the cross-section's image");
    }
    return finish(std::move(yarn), problems);
}

std::string write_yarn_toml(const YarnType& yarn) {
    const auto quote = [](const std::string& s) { return str(toml::value<std::string>(s)); };
    std::string out =
        str("model = \"", yarn_form::to_string(yarn.model), "\"\nname = ", quote(yarn.name), "\n");
    if (yarn.model == YarnModel::Slice) out += str("slice = ", quote(yarn.slice.name), "\n");
    for (const Field& field : yarn_form::fields()) {
        if (field.model != YarnModel::Solid && field.model != yarn.model) continue;
        // 0 means "not known yet" and would be rejected
        const bool unset = field.key == "fiber_radius" && yarn.fiber_radius == 0.0f;
        if (!unset) out += str(field.key, " = ", toml_value(yarn, field), "\n");
    }
    return out;
}

} // namespace heddle
