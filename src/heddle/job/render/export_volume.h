#pragma once

#include <heddle/base/progress.h>
#include <heddle/io/vol/write_mitsuba.h>
#include <heddle/io/vol/write_mitsuba06.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heddle::job {

/// The renderer that a volume is exported for.
enum class ExportFormat : std::uint8_t {
    Mitsuba3, ///< grids of sigma_t, S and albedo, and a scene file
    Mitsuba06 ///< blocks of density and direction, and a scene file
};

/// How a volume is written for another renderer. Nothing is required.
struct ExportOptions {
    ExportFormat to = ExportFormat::Mitsuba3;
    int level = 0;                  ///< of detail; 0: the finest
    std::optional<double> pad{};    ///< Mitsuba3: scales the box, >= 1; none: 1
    std::optional<double> stddev{}; ///< Mitsuba06: deviation of flakes from the fiber; none: 0.3
    std::optional<std::int32_t>
        block_samples{}; ///< Mitsuba06: samples along a block's edge, 2 to 512;
                         ///< 0: a single block; none: 64
};

/// What was written.
struct ExportReport {
    std::optional<MitsubaBox> box{};       ///< Mitsuba3 only
    std::optional<Mitsuba06Files> files{}; ///< Mitsuba06 only
    std::vector<std::string> notes{};
    double seconds = 0.0;
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

/// Writes voxels into a folder, which is created if necessary.
/// @throws OptionError  options cannot be used together or are out of range
/// @throws Error        InvalidArgument: there are no voxels; OutOfMemory, CannotWrite, Cancelled
ExportReport export_volume(const VoxelLevel& voxels,
                           const std::string& folder,
                           const ExportOptions& options,
                           Progress& progress);

/// Reads one level of a .vdb and exports it.
/// @throws Error  also as read_vdb; BadFile: the file holds no voxels
ExportReport export_volume(const std::string& path,
                           const std::string& folder,
                           const ExportOptions& options,
                           Progress& progress);

} // namespace heddle::job
