#pragma once

#include <heddle/io/vol/vol_dictionary.h>
#include <heddle/io/vol/vol_file.h>

#include <optional>
#include <string>

namespace heddle {

/// Throws Error{BadFile} unless the file has one channel.
void expect_density(const VolFile& file);

/// Throws Error{BadFile} unless the file has directions, or three floats that may be directions.
void expect_directions(const VolFile& file);

/// Files whose names differ only in the index of their block.
struct BlockSet {
    std::string folder; ///< empty: the current folder
    BlockName name;
    VolHeader header; ///< header of one of its files

    [[nodiscard]] std::string path_of(Vec3i block) const;
};

/// The sets of files that belong to a dictionary.
struct VolSets {
    BlockSet density;
    std::optional<BlockSet> orientation;
};

/// Chooses among the sets beside a dictionary, as find_vol_layout describes; all listed blocks
/// exist.
/// @param path         of the dictionary
/// @param orientation  as in find_vol_layout
/// @throws Error  BadFile: no set or several, missing files; as VolFile
[[nodiscard]] VolSets find_vol_sets(const std::string& path,
                                    const VolDictionary& dictionary,
                                    const std::string& orientation);

} // namespace heddle
