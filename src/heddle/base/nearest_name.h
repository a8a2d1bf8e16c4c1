#pragma once

#include <cstddef>
#include <string_view>

namespace heddle {

/// The number of edits that turn `a` into `b`: letters inserted, deleted, replaced or swapped.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name that is the fewest edits away from `word`, for "did you mean". Empty if no name is
/// nearer than half of the word's length, and for words of more than 64 letters.
/// @param names  a range of std::string or std::string_view; the first of equally near names wins
template <typename Names>
[[nodiscard]] std::string_view nearest_name(std::string_view word, const Names& names) {
    std::string_view best;
    if (word.size() > 64) return best;
    std::size_t least = word.size() / 2 + 1;
    for (const std::string_view name : names) {
        const std::size_t distance = edit_distance(word, name);
        if (distance < least) {
            least = distance;
            best = name;
        }
    }
    return best;
}

} // namespace heddle
