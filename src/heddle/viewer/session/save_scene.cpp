#include <heddle/viewer/session/save_scene.h>

#include <iomanip>
#include <numbers>
#include <sstream>

namespace heddle::viewer {
namespace {

std::string list(Vec3d v) {
    std::ostringstream out;
    out << std::setprecision(12) << '[' << v.x << ", " << v.y << ", " << v.z << ']';
    return out.str();
}

/// The text as a basic string of TOML.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

} // namespace

std::string scene_text(const std::string& volume,
                       const CameraParameters& camera,
                       Vec3d light,
                       std::int32_t width,
                       std::int32_t height) {
    std::ostringstream out;
    out << std::setprecision(12);
    out << "# written by heddle view; heddle render makes the picture\n[camera]\nkind = \""
        << (camera.orthographic ? "orthographic" : "perspective")
        << "\"\neye = " << list(camera.eye) << "\ntarget = " << list(camera.target)
        << "\nup = " << list(camera.up) << '\n';
    if (camera.orthographic)
        out << "view_height = " << camera.view_height << '\n';
    else
        out << "view_angle = " << camera.view_angle * 180.0 / std::numbers::pi << '\n';
    out << "\n[film]\nsize = [" << width << ", " << height << "]\n"
        << "\n[[light]]\nkind = \"directional\"\ndirection = " << list(normalize(light) * -1.0)
        << "\ncolor = " << 0.75 * std::numbers::pi
        << "\n\n[[light]]\nkind = \"constant\"\ncolor = 0.25\n\n[object.view]\nvolume = "
        << quoted(volume) << '\n';
    return out.str();
}

} // namespace heddle::viewer
