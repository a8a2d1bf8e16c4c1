#include <heddle/cli/view_rows.h>

#include <heddle/cli/rows/geometry_rows.h>

#include <limits>
#include <utility>

namespace heddle::cli {

std::vector<Option> view_rows() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    std::vector<Option> yarn = joined({load_rows(), model_rows()});
    std::erase_if(yarn, [](const Option& row) { return row.key().starts_with("height-"); });
    return joined({
        grouped(
            "Input and output",
            {
                {"FILE", "", "", any_text(), "",
                 "Curves (.bcc .hair .data .pyp) or a .vdb written by heddle.", true},
                {"--volume", "X.vdb", "", any_text(), "",
                 "A volume to show beside the curves of FILE."},
                {"-o, --output", "DIR", "(the current folder)", any_text(), "",
                 "Folder for saved files; required with --headless, which writes frame_0000.png and so on."},
            }),
        grouped(
            "Without a window",
            {
                {"--headless", "", "", flag(), "",
                 "Writes pictures instead of opening a window; needs no display."},
                {"--frames", "N", "1", integer(1, 10000), "pictures",
                 "Number of pictures, once around the object; needs --headless."},
                {"--scene", "", "", flag(), "",
                 "Also writes a scene for render with the first picture's camera and light; needs --headless."},
            }),
        grouped(
            "Camera",
            {
                {"--size", "WxH", "960x960", numbers(2, 2, 1, 8192, 'x'), "pixels",
                 "Size of the window or of a picture."},
                {"--from", "X,Y,Z", "0.3,-0.6,1", numbers(3, 3, -kInf, kInf), "any length",
                 "Direction from the object to the camera, in the first picture."},
                {"--up", "AXIS", "auto", one_of({"auto", "x", "y", "z"}), "",
                 "Axis that points up and that the pictures turn around; auto: z for a flat object, else y."},
                {"--target", "X,Y,Z", "(the centre of the object)", numbers(3, 3, -kInf, kInf),
                 "scene units", "Point in the middle of the picture."},
                {"--zoom", "Z", "1", positive(), "",
                 "Magnification; at 1 the whole object fits from any side."},
                {"--view-angle", "A", "35", number(0, 170), "degrees",
                 "Field of view across the picture's height; 0 = parallel projection."},
            }),
        grouped(
            "Look",
            {
                {"--show", "WHAT", "slices", one_of({"slices", "voxels"}), "",
                 "What to show of curves with --volume; a .vdb alone is shown as voxels."},
                {"--color", "MODE", "shaded",
                 one_of({"shaded", "direction", "grid", "density", "tangent", "width", "material",
                         "block", "level"}),
                 "",
                 "Slices: shaded, direction (x^2, y^2, z^2 of the fiber direction as red, green, blue) or grid (the same of the direction stored in the voxels). Voxels: all modes but direction and grid."},
                {"--light", "X,Y,Z", "-0.5,0.6,1", numbers(3, 3, -kInf, kInf), "any length",
                 "Direction from the object to the light."},
                {"--opacity", "K", "1", positive(), "",
                 "Multiplies the density of slices and voxels."},
                {"--no-shadows", "", "", flag(), "", "Draws without shadows."},
                {"--no-occlusion", "", "", flag(), "",
                 "Draws slices without the occlusion between fibers of the same cross-section."},
            }),
        std::move(yarn),
        grouped(
            "Levels and blocks",
            {
                {"--level", "N", "(from the width of each pixel)", integer(0, 1000), "",
                 "Level of detail of voxels; 0 = the finest."},
                {"--blocks", "", "", flag(), "",
                 "Draws the edges of occupied blocks of 32^3 voxels."},
                {"--white-block", "X,Y,Z", "", numbers(3, 3, -1e6, 1e6), "blocks",
                 "Shows this block in white, voxel by voxel; slices show it with --color grid only."},
            }),
        grouped(
            "Blending and memory",
            {
                {"--blend", "MODE", "sorted", one_of({"sorted", "weighted", "placed"}), "",
                 "Draw order of slices. sorted: by depth; weighted: independent of order, also used if slices exceed --memory; placed: unsorted, for comparison."},
                {"--memory", "BYTES", "(size of the driver's largest buffer)", bytes(),
                 "bytes; suffix K, M, G or T",
                 "Limit of the memory for visible slices and their order."},
            }),
    });
}

} // namespace heddle::cli
