#include <heddle/cli/terminal/arguments.h>

#include <heddle/cli/terminal/text.h>

namespace heddle::cli {

const std::string& Arguments::text(const std::string& key) const {
    const auto it = given_.find(key);
    return it != given_.end() ? it->second.front() : preset_.at(key);
}
std::vector<std::string> Arguments::texts(const std::string& key) const {
    const auto it = given_.find(key);
    return it != given_.end() ? it->second : std::vector<std::string>{};
}
std::int64_t Arguments::integer(const std::string& key) const {
    return parse_integer(text(key)).value();
}
double Arguments::number(const std::string& key) const {
    return parse_number(text(key)).value();
}
std::vector<double> Arguments::numbers(const std::string& key, char separator) const {
    std::vector<double> values;
    for (const std::string& piece : split(text(key), separator)) {
        values.push_back(parse_number(piece).value());
    }
    return values;
}
std::int64_t Arguments::bytes(const std::string& key) const {
    return parse_bytes(text(key)).value();
}

std::optional<std::string> Arguments::find_text(const std::string& key) const {
    return given(key) ? std::optional(text(key)) : std::nullopt;
}
std::optional<std::int64_t> Arguments::find_integer(const std::string& key) const {
    return given(key) ? std::optional(integer(key)) : std::nullopt;
}
std::optional<double> Arguments::find_number(const std::string& key) const {
    return given(key) ? std::optional(number(key)) : std::nullopt;
}
std::optional<std::int64_t> Arguments::find_bytes(const std::string& key) const {
    return given(key) ? std::optional(bytes(key)) : std::nullopt;
}

} // namespace heddle::cli
