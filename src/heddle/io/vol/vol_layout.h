#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/bounds.h>
#include <heddle/io/vol/vol_file.h>

#include <optional>
#include <string>
#include <vector>

namespace heddle {

/// A block of a volume with samples at * (n - 1) to at * (n - 1) + n - 1 per axis; n is per block.
struct VolBlock {
    Vec3i at;                ///< block index
    std::string density;     ///< path
    std::string orientation; ///< path; empty if the volume has no directions
};

/// The files of a volume, and the positions of its samples. Neighbouring blocks share a layer.
struct VolLayout {
    std::string name;
    bool hierarchical = false;      ///< true: a hgridvolume; false: one grid, as one block
    Bounds bounds;                  ///< scene units; the outermost samples are on it
    Vec3i cells{1, 1, 1};           ///< blocks per axis, including missing ones
    Vec3i block_samples;            ///< samples per block and axis
    Vec3d pitch;                    ///< scene units between samples
    std::vector<VolBlock> blocks;   ///< ascending (x, y, z); not empty
    VolEncoding density_encoding{}; ///< of the first block
    std::optional<VolEncoding> orientation_encoding;

    /// Samples of the whole volume per axis, at most 2^30.
    [[nodiscard]] Vec3i samples() const {
        Vec3i n;
        for (int a = 0; a < 3; ++a) n[a] = cells[a] * (block_samples[a] - 1) + 1;
        return n;
    }
};

/// Finds the files of a volume and checks all their headers; reads no samples.
///
/// Beside a dictionary there are `prefixXXX_YYY_ZZZpostfix.vol` files. Of the sets that have a
/// listed block, the one with one channel is the density (of several, the one with "density" in its
/// name), the one with quantized directions is the orientation (else the one with three floats and
/// "orientation" or "direction" in its name). A grid's orientation is the file beside it with
/// "orientation" for "density" in its name.
///
/// Pitches that agree within the rounding of the float bounds are made equal: the shortest decimal
/// that fits, so that voxels that are meant as cubes are cubes.
/// @param path         a grid volume of density, or a hgridvolume dictionary
/// @param orientation  for a grid: the file of its directions; for a dictionary: any one of the
///                     files with a block's directions; "none": no directions; empty: found by name
/// @throws Error  as VolFile and read_vol_dictionary; BadFile: blocks missing, of another size,
///                with other bounds, no or several sets of files; NotFound: no such file
[[nodiscard]] VolLayout find_vol_layout(const std::string& path,
                                        const std::string& orientation = {});

} // namespace heddle
