#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/generate.h>
#include <heddle/job/stage_clock.h>

#include <cstdint>
#include <string>

namespace heddle::job {

struct GenerateReport {
    GenerateOptions options; ///< with every default in its place
    std::int64_t nodes = 0;  ///< control points of curves, or vertices of meshes
    StageTimes stages{};
};

/// The suffix of the format that holds what a kind makes: ".bcc", ".hair" or ".glb".
[[nodiscard]] std::string suffix_for(GenerateKind kind);

/// Cloth, hair or meshes made from nothing, in memory.
/// @throws Error  as resolve; OutOfMemory: more than is free; Cancelled
[[nodiscard]] Geometry generate_geometry(const GenerateOptions& options, Progress& progress);

/// The same into a file.
/// @throws OptionError  another suffix than suffix_for()
/// @throws Error        as generate_geometry; CannotWrite
GenerateReport
generate_to_file(const GenerateOptions& options, const std::string& output, Progress& progress);

} // namespace heddle::job
