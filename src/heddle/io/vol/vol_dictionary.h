#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/bounds.h>

#include <optional>
#include <string>
#include <vector>

namespace heddle {

/// A Mitsuba 0.6 hgridvolume dictionary: a coarse grid and the list of its cells that have a block.
struct VolDictionary {
    Bounds bounds;             ///< scene units, of all cells
    Vec3i cells;               ///< per axis, >= 1
    std::vector<Vec3i> blocks; ///< cells that have a block, as listed: at least one, no duplicates
};

/// Reads a dictionary: f32[6] bounds, i32[3] cells, then i32[3] per block to the end of the file.
/// @throws Error  as InputFile; BadFile: not a dictionary, truncated inside an entry, a block
///                outside the cells or listed twice
[[nodiscard]] VolDictionary read_vol_dictionary(const std::string& path);

/// The parts of a block's file name: prefix + "XXX_YYY_ZZZ" + postfix.
struct BlockName {
    std::string prefix;
    std::string postfix;
    Vec3i block;

    /// The name of another block of the same set.
    [[nodiscard]] std::string of(Vec3i other) const;
};

/// Splits a file name into its parts; nothing if it does not contain a block.
/// @param name  without folder
[[nodiscard]] std::optional<BlockName> parse_block_name(const std::string& name);

} // namespace heddle
