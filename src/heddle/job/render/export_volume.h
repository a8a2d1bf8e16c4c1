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

enum class ExportFormat : std::uint8_t {
    Mitsuba3, ///< grids of sigma_t, S and albedo, and a scene
    Mitsuba06 ///< blocks of density and direction, and a scene
};

/// How a volume is written for another renderer. Nothing is required.
struct ExportOptions {
    ExportFormat to = ExportFormat::Mitsuba3;
    int level = 0;               ///< of detail; 0: the finest
    std::optional<double> pad{}; ///< of Mitsuba3: grows the box on each axis, >= 1; none: 1
    std::optional<double>
        stddev{}; ///< of Mitsuba06: how far flakes stray from the fiber; none: 0.3
    std::optional<std::int32_t>
        block_samples{}; ///< of Mitsuba06: along a block's edge, 2 to 512; 0:
                         ///< one block holds all; none: 64
};

/// What was written: of the format that was asked for.
struct ExportReport {
    std::optional<MitsubaBox> box{};       ///< of Mitsuba3
    std::optional<Mitsuba06Files> files{}; ///< of Mitsuba06
    std::vector<std::string> notes{};
    double seconds = 0.0;
    std::int64_t peak_bytes = 0; ///< resident, of the process so far
};

/// Writes voxels into a folder, which is made.
/// @throws OptionError  options that do not go together or are out of range
/// @throws Error        InvalidArgument: no voxels; OutOfMemory, CannotWrite, Cancelled
ExportReport export_volume(const VoxelLevel& voxels,
                           const std::string& folder,
                           const ExportOptions& options,
                           Progress& progress);

/// Writes one level of a .vdb.
/// @throws Error  also as read_vdb; BadFile: it holds no voxels
ExportReport export_volume(const std::string& path,
                           const std::string& folder,
                           const ExportOptions& options,
                           Progress& progress);

} // namespace heddle::job
