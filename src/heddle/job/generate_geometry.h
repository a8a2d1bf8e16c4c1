#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/generate.h>
#include <heddle/job/phase_clock.h>

#include <cstdint>
#include <string>

namespace heddle::job {

/// What was generated, and how long it took.
struct GenerateReport {
    GenerateOptions options; ///< with all defaults filled in
    std::int64_t nodes = 0;  ///< control points of curves, or vertices of meshes
    PhaseTimes phases{};
};

/// Returns the suffix of the file format for this kind of geometry: ".bcc", ".hair" or ".glb".
[[nodiscard]] std::string suffix_for(GenerateKind kind);

/// Generates procedural cloth, hair or meshes in memory.
/// @throws Error  as resolve; OutOfMemory: the geometry exceeds the free memory; Cancelled
[[nodiscard]] Geometry generate_geometry(const GenerateOptions& options, Progress& progress);

/// Generates geometry and writes it to a file.
/// @param output        a path that ends in suffix_for(options.kind)
/// @throws OptionError  `output` has another suffix
/// @throws Error        as generate_geometry; CannotWrite
GenerateReport
generate_to_file(const GenerateOptions& options, const std::string& output, Progress& progress);

} // namespace heddle::job
