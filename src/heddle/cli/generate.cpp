#include <heddle/base/error.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/rows/report_parts.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/text.h>
#include <heddle/job/generate_geometry.h>

namespace heddle::cli {
namespace {

GenerateOptions generate_options_from(const Arguments& arguments) {
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
    options.radius = arguments.find_number("radius").value_or(0.0);
    options.spacing = arguments.find_number("spacing").value_or(0.0);
    return options;
}

void run_generate(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const std::string& output = arguments.text("output");
    const job::GenerateReport done =
        job::generate_to_file(generate_options_from(arguments), output, bar);
    const GenerateOptions& options = done.options;
    report.text("output", output);
    report.text("kind", std::string(to_string(options.kind)));
    report.add("counts", "counts", {options.nx, options.ny}, str(options.nx, " x ", options.ny));
    report.count("nodes", done.nodes);
    report.number("radius", options.radius, "scene units");
    report.number("spacing", options.spacing, "scene units");
    report_phases(report, done.phases);
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
