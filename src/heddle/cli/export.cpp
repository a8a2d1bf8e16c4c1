#include <heddle/base/error.h>
#include <heddle/base/memory.h>
#include <heddle/cli/commands.h>
#include <heddle/cli/load.h>
#include <heddle/cli/progress_bar.h>
#include <heddle/cli/report.h>
#include <heddle/io/vdb/read_vdb.h>
#include <heddle/io/vol/write_mitsuba.h>
#include <heddle/voxel/flake_field.h>

#include <chrono>

namespace heddle::cli {
namespace {

FlakeField read_field(const std::string& path, int level) {
    const std::unique_ptr<VoxelGrid> grid = read_vdb(path, level);
    if (grid->info().voxel_count == 0) {
        throw Error(ErrorCode::BadFile, "holds no voxels", "export a volume that has some",
                    {.path = path});
    }
    std::vector<Vec3f> albedo;
    for (const Material& material : grid->info().materials) albedo.push_back(material.albedo);
    return {*grid, albedo};
}

void run_export(const Arguments& arguments, Report& report, ProgressBar& bar) {
    const auto start = std::chrono::steady_clock::now();
    const std::string& folder = arguments.text("output");
    bar.begin("read", "files", 1);
    const FlakeField field =
        read_field(arguments.text("FILE"), static_cast<int>(arguments.integer("level")));
    bar.check();
    const MitsubaBox box = plan_mitsuba(field, arguments.number("pad"));
    write_output([&] { write_mitsuba(field, box, folder, bar); });
    bar.finish();
    report.text("output", folder);
    report.add("resolution", "resolution", {box.size.x, box.size.y, box.size.z},
               str(box.size.x, " x ", box.size.y, " x ", box.size.z, " voxels, dense"));
    report.bytes("files", box.bytes);
    const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
    report.seconds("total", total.count());
    report.bytes("peak memory", peak_resident_bytes());
}

} // namespace

Command export_command() {
    return {"export",
            "a volume for another renderer: dense grids and a scene that loads",
            {
                {"FILE", "", "", any_text(), "", "a .vdb that voxelize wrote", true},
                {"--to", "FORMAT", "mitsuba3", one_of({"mitsuba3"}), "",
                 "sigma_t.vol, S.vol (one SGGX of normals a voxel), albedo.vol, scene.xml"},
                {"-o, --output", "DIR", "", any_text(), "", "folder of the files", true},
                {"--level", "N", "0", integer(0, 1000), "", "of detail; 0 = the finest"},
                {"--pad", "F", "1", number(1, 1000), "of the box",
                 "grows it on each axis with emptiness"},
            },
            run_export};
}

} // namespace heddle::cli
