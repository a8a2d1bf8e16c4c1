#include <heddle/cli/terminal/option_words.h>

#include <algorithm>

namespace heddle::cli {

std::string in_option_words(const std::string& text, const std::vector<std::string>& keys) {
    std::string out;
    std::size_t at = 0;
    while (true) {
        const std::size_t open = text.find('`', at);
        const std::size_t close = text.find('`', std::min(open, text.size() - 1) + 1);
        if (open == std::string::npos || close == std::string::npos) return out + text.substr(at);
        std::string name = text.substr(open + 1, close - open - 1);
        std::replace(name.begin(), name.end(), '_', '-');
        const bool known = std::find(keys.begin(), keys.end(), name) != keys.end();
        out += text.substr(at, open - at);
        out += known ? "--" + name : text.substr(open, close - open + 1);
        at = close + 1;
    }
}

} // namespace heddle::cli
