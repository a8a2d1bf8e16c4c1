#include <heddle/job/generate_geometry.h>

#include <heddle/base/format_number.h>
#include <heddle/base/memory.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/gltf/write_glb.h>
#include <heddle/job/write_output.h>

namespace heddle::job {
namespace {

void check_memory(const GenerateOptions& options) {
    const std::int64_t bytes = predict_bytes(options);
    const std::int64_t free = available_bytes();
    if (free <= 0 || bytes <= free) return;
    throw Error(ErrorCode::OutOfMemory,
                str("generate: ", format_bytes(static_cast<double>(bytes)), " are needed and ",
                    format_bytes(static_cast<double>(free)), " are free"),
                "give smaller `counts`");
}

void write_geometry(const Geometry& geometry, GenerateKind kind, const std::string& path) {
    const std::string suffix = suffix_for(kind);
    if (suffix == ".glb") return write_glb(geometry, path);
    if (suffix == ".bcc") return write_bcc(geometry.curves, path);
    if (geometry.curves.size() != 1) {
        throw Error(ErrorCode::Internal, str("generate: ", geometry.curves.size(),
                                             " sets of strands, but a .hair file holds one"));
    }
    write_hair(geometry.curves.front(), path);
}

} // namespace

std::string suffix_for(GenerateKind kind) {
    switch (kind) {
    case GenerateKind::Hair:
    case GenerateKind::Curls: return ".hair";
    case GenerateKind::Brushed:
    case GenerateKind::Grass: return ".glb";
    default: return ".bcc";
    }
}

Geometry generate_geometry(const GenerateOptions& options, Progress& progress) {
    const GenerateOptions whole = resolve(options);
    check_memory(whole);
    progress.check();
    progress.begin("generate", "nodes", predict_nodes(whole));
    Geometry geometry = generate(whole);
    progress.check();
    return geometry;
}

GenerateReport
generate_to_file(const GenerateOptions& options, const std::string& output, Progress& progress) {
    PhaseClock clock(progress);
    GenerateReport report;
    report.options = resolve(options);
    report.nodes = predict_nodes(report.options);
    check_output(output, suffix_for(report.options.kind));
    const Geometry geometry = generate_geometry(report.options, clock);
    clock.begin("write", "nodes", report.nodes);
    write_output([&] { write_geometry(geometry, report.options.kind, output); });
    clock.finish();
    report.phases = clock.phases();
    return report;
}

} // namespace heddle::job
