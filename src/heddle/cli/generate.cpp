#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/report.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/geom/generate.h>
#include <heddle/io/curve/curve_files.h>
#include <heddle/io/mesh/write_glb.h>

namespace heddle::cli {
namespace {

/// The suffix of the format that holds what this kind makes.
std::string suffix_for(GenerateKind kind) {
    switch (kind) {
    case GenerateKind::Hair:
    case GenerateKind::Curls: return ".hair";
    case GenerateKind::Brushed:
    case GenerateKind::Grass: return ".glb";
    default: return ".bcc";
    }
}

GenerateOptions generate_options(const Arguments& arguments) {
    GenerateOptions options;
    options.kind = generate_kind_from(arguments.text("KIND")).value();
    const std::string& shape = arguments.text("shape");
    options.shape = shape == "folded"    ? GenerateShape::Folded
                    : shape == "hanging" ? GenerateShape::Hanging
                                         : GenerateShape::Flat;
    if (arguments.given("counts")) {
        const std::vector<std::string> counts = split(arguments.text("counts"), ',');
        const std::optional<std::int64_t> nx = parse_integer(counts[0]);
        const std::optional<std::int64_t> ny = parse_integer(counts[1]);
        if (!nx || !ny) throw UsageError("--counts: both values must be whole numbers");
        options.nx = *nx;
        options.ny = *ny;
    }
    options.seed = static_cast<std::uint64_t>(arguments.integer("seed"));
    if (arguments.given("radius")) options.radius = arguments.number("radius");
    if (arguments.given("spacing")) options.spacing = arguments.number("spacing");
    return resolve(options);
}

void write_geometry(const Geometry& geometry, GenerateKind kind, const std::string& path) {
    const std::string suffix = suffix_for(kind);
    if (suffix == ".glb") return write_glb(geometry, path);
    if (suffix == ".bcc") return write_bcc(geometry.curves, path);
    if (geometry.curves.size() != 1) {
        throw Error(ErrorCode::Internal, str("generate: ", geometry.curves.size(),
                                             " sets of strands, a .hair file takes one"));
    }
    write_hair(geometry.curves.front(), path);
}

void run_generate(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string output = arguments.text("output");
    const GenerateOptions options = generate_options(arguments);
    check_output(output, suffix_for(options.kind));
    const std::int64_t bytes = predict_bytes(options);
    if (const std::int64_t free = available_bytes(); free > 0 && bytes > free) {
        throw Error(ErrorCode::OutOfMemory,
                    str("generate: ", show_bytes(static_cast<double>(bytes)), " are needed and ",
                        show_bytes(static_cast<double>(free)), " are free"),
                    "give smaller --counts");
    }
    bar.begin("generate", "nodes", predict_nodes(options));
    const Geometry geometry = generate(options);
    bar.check();
    bar.begin("write", "nodes", predict_nodes(options));
    write_output([&] { write_geometry(geometry, options.kind, output); });
    bar.finish();
    report.text("output", output);
    report.text("kind", std::string(to_string(options.kind)));
    report.add("counts", "counts", {options.nx, options.ny}, str(options.nx, " x ", options.ny));
    report.count("nodes", predict_nodes(options));
    report.number("radius", options.radius, "scene units");
    report.number("spacing", options.spacing, "scene units");
    for (const auto& [stage, seconds] : bar.stages()) report.seconds(stage, seconds);
}

} // namespace

Command generate_command() {
    return {
        "generate", "Makes a procedural test object: knit, weave, hair, grass or a brushed plate.",
        joined({
            grouped(
                "Input and output",
                {
                    {"KIND", "", "",
                     one_of({"knit", "rib", "cable", "plain", "twill", "satin", "hair", "curls",
                             "brushed", "grass"}),
                     "", "Kind of object; knit to satin are cloth.", true},
                    {"-o, --output", "FILE", "", any_text(), "",
                     "Output file: .bcc for cloth, .hair for hair and curls, .glb for brushed and grass.",
                     true},
                }),
            grouped(
                "Shape",
                {
                    {"--counts", "NX,NY", "(a small swatch)", numbers(2, 2, 1, 1e9), "",
                     "Knits: loops per row, rows. Weaves: warp yarns, weft yarns. Hair and curls: strands, points per strand. Brushed: texels. Grass: blades, quads per blade."},
                    {"--shape", "SHAPE", "flat", one_of({"flat", "folded", "hanging"}), "",
                     "How the cloth lies; other kinds are flat only."},
                    {"--radius", "R", "(depends on KIND)", positive(), "scene units",
                     "Radius of a yarn or strand, or half the width of a grass blade."},
                    {"--spacing", "S", "(depends on KIND)", positive(), "scene units",
                     "Distance between neighbouring yarns, roots or texels."},
                }),
        }),
        run_generate};
}

} // namespace heddle::cli
