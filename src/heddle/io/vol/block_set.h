#pragma once

#include <heddle/io/vol/vol_dictionary.h>
#include <heddle/io/vol/vol_file.h>

#include <optional>
#include <string>

namespace heddle {

/// Throws Error{BadFile} unless the file holds one channel.
void expect_density(const VolFile& file);

/// Throws Error{BadFile} unless the file holds directions, or three floats that may be some.
void expect_directions(const VolFile& file);

/// Files of one name but for the block's place.
struct BlockSet {
    std::string folder; ///< empty: the current one
    BlockName name;
    VolHeader header; ///< of one of its files

    [[nodiscard]] std::string path_of(Vec3i block) const;
};

/// The files that a dictionary means.
struct VolSets {
    BlockSet density;
    std::optional<BlockSet> orientation;
};

/// Chooses among the sets that stand beside a dictionary, as find_vol_layout says; all listed blocks
/// are there.
/// @param path         of the dictionary
/// @param orientation  as find_vol_layout takes it
/// @throws Error  BadFile: no set or several, files missing; as VolFile
[[nodiscard]] VolSets find_vol_sets(const std::string& path,
                                    const VolDictionary& dictionary,
                                    const std::string& orientation);

} // namespace heddle
