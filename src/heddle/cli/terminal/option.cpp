#include <heddle/cli/terminal/option.h>

#include <algorithm>

namespace heddle::cli {

std::string Option::key() const {
    const std::size_t at = names.rfind("--");
    return at == std::string::npos ? names : names.substr(at + 2);
}

std::vector<Option> grouped(const std::string& group, std::vector<Option> rows) {
    for (Option& row : rows) row.group = group;
    return rows;
}

std::vector<Option> joined(const std::vector<std::vector<Option>>& lists) {
    std::vector<Option> rows;
    for (const std::vector<Option>& list : lists) rows.insert(rows.end(), list.begin(), list.end());
    std::vector<std::string> groups;
    const auto rank = [&groups](const Option& row) {
        return std::find(groups.begin(), groups.end(), row.group);
    };
    for (const Option& row : rows) {
        if (rank(row) == groups.end()) groups.push_back(row.group);
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [&](const Option& a, const Option& b) { return rank(a) < rank(b); });
    return rows;
}

} // namespace heddle::cli
