#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/bounds.h>
#include <heddle/io/vol/vol_file.h>

#include <optional>
#include <string>
#include <vector>

namespace heddle {

/// A block of a volume: samples at * (n - 1) to at * (n - 1) + n - 1 per axis, n of a block.
struct VolBlock {
    Vec3i at;                ///< in blocks
    std::string density;     ///< path
    std::string orientation; ///< path; empty where the volume has no directions
};

/// Which files make a volume, and where its samples lie. Neighbouring blocks share a layer of samples.
struct VolLayout {
    std::string name;
    bool hierarchical = false;      ///< a hgridvolume; false: one grid, as one block
    Bounds bounds;                  ///< scene units; the outermost samples lie on it
    Vec3i cells{1, 1, 1};           ///< blocks per axis, those that are not there included
    Vec3i block_samples;            ///< samples of a block per axis
    Vec3d pitch;                    ///< scene units between samples
    std::vector<VolBlock> blocks;   ///< ascending (x, y, z); not empty
    VolEncoding density_encoding{}; ///< of the first block
    std::optional<VolEncoding> orientation_encoding;

    /// Samples of the whole box per axis, at most 2^30.
    [[nodiscard]] Vec3i samples() const {
        Vec3i n;
        for (int a = 0; a < 3; ++a) n[a] = cells[a] * (block_samples[a] - 1) + 1;
        return n;
    }
};

/// Finds the files of a volume and checks all their headers; reads no sample.
///
/// Beside a dictionary stand `prefixXXX_YYY_ZZZpostfix.vol` files: of the sets that hold a listed
/// block, the one of one channel is the density (of several, the one with "density" in its name),
/// the one of quantized directions the orientation (else the one of three floats with "orientation"
/// or "direction" in its name). Beside a grid, the file with "orientation" for "density" in its name.
///
/// Pitches that agree within the rounding of the float bounds are taken as one, the shortest decimal
/// that does: voxels are cubes where they were meant to be.
/// @param path         a grid volume of density, or a hgridvolume dictionary
/// @param orientation  of a grid: the file with its directions; of a dictionary: any one of the files
///                     with a block's directions; "none": without; empty: found by name
/// @throws Error  as VolFile and read_vol_dictionary; BadFile: blocks missing, of another size, with
///                other bounds, no or several sets of files; NotFound: no such file
[[nodiscard]] VolLayout find_vol_layout(const std::string& path,
                                        const std::string& orientation = {});

} // namespace heddle
