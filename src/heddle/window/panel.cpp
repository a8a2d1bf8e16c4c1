#include <heddle/window/panel.h>

#include <imgui.h>

#include <algorithm>
#include <array>

namespace heddle::window {
namespace {

constexpr float kWidth = 300.0f;

bool slide(const char* label, double& value, double lo, double hi, const char* format, bool log) {
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &lo, &hi, format,
                               log ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

template <std::size_t N>
bool choose(const char* label, int& value, const std::array<const char*, N>& names) {
    return ImGui::Combo(label, &value, names.data(), static_cast<int>(N));
}

void yarn_controls(const viewer::Session& session, viewer::Settings& s, PanelState& state) {
    if (!session.has_slices() || !ImGui::CollapsingHeader("Yarn", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    state.kind = std::clamp(state.kind, 0, static_cast<int>(session.kinds().size()) - 1);
    const auto at = static_cast<std::size_t>(state.kind);
    if (session.kinds().size() > 1 && ImGui::BeginCombo("kind", session.kinds()[at].c_str())) {
        for (std::size_t k = 0; k < session.kinds().size(); ++k) {
            if (ImGui::Selectable(session.kinds()[k].c_str(), k == at)) {
                state.kind = static_cast<int>(k);
            }
        }
        ImGui::EndCombo();
    }
    viewer::YarnEdit& edit = s.yarns[at];
    slide("radius", edit.radius, 0.1, 10.0, "x %.2f", true);
    slide("twist", edit.twist, -6.0, 6.0, "%+.2f rad", false);
    float tint[3] = {edit.tint.x, edit.tint.y, edit.tint.z};
    if (ImGui::ColorEdit3("tint", tint, ImGuiColorEditFlags_Float)) {
        edit.tint = {tint[0], tint[1], tint[2]};
    }
    slide("density", s.slices.opacity, 0.05, 20.0, "x %.2f", true);
}

void volume_controls(const viewer::Session& session, viewer::Settings& s) {
    ImGui::SameLine();
    ImGui::Checkbox("blocks", &s.volume.blocks);
    if (s.show == viewer::Show::Slices) return;
    int color = static_cast<int>(s.volume.color);
    if (choose("color", color,
               std::array{"shaded", "density", "tangent", "width", "material", "block", "level"})) {
        s.volume.color = static_cast<viewer::VoxelColor>(color);
    }
    ImGui::SliderInt("level", &s.volume.level, -1, session.level_count() - 1,
                     s.volume.level < 0 ? "by footprint" : "%d");
    slide("density##volume", s.volume.density_scale, 0.05, 20.0, "x %.2f", true);
}

void look_controls(const viewer::Session& session, viewer::Settings& s) {
    if (!ImGui::CollapsingHeader("Look", ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (session.has_slices() && session.has_voxels()) {
        int show = static_cast<int>(s.show);
        if (choose("show", show, std::array{"slices", "voxels"}))
            s.show = static_cast<viewer::Show>(show);
    }
    ImGui::Checkbox("shadows",
                    s.show == viewer::Show::Slices ? &s.slices.shadows : &s.volume.shadows);
    if (s.show == viewer::Show::Slices) {
        ImGui::SameLine();
        ImGui::Checkbox("occlusion", &s.slices.occlusion);
        int color = static_cast<int>(s.slices.color);
        if (session.has_voxels()
                ? choose("color", color, std::array{"shaded", "direction", "of the voxels"})
                : choose("color", color, std::array{"shaded", "direction"})) {
            s.slices.color = static_cast<viewer::SliceColor>(color);
        }
        int blend = s.slices.weighted ? 1 : s.slices.sorted ? 0 : 2;
        if (choose("blend", blend, std::array{"sorted", "weighted", "as placed"})) {
            s.slices.weighted = blend == 1;
            s.slices.sorted = blend != 2;
        }
    }
    if (session.has_voxels()) volume_controls(session, s);
    double degrees = s.orbit.view_angle * 57.29577951308232;
    if (slide("view angle", degrees, 0.0, 120.0, "%.0f deg", false)) {
        s.orbit.view_angle = degrees / 57.29577951308232;
    }
}

void voxel_controls(viewer::Session& session, viewer::Settings& s) {
    if (!session.has_slices() ||
        !ImGui::CollapsingHeader("Voxels", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    slide("edge", s.voxels.edge_px, 0.25, 32.0, "%.2f px", true);
    int backend = s.voxels.raster ? 1 : 0;
    if (choose("backend", backend, std::array{"sample", "raster"})) s.voxels.raster = backend == 1;
    int composition = static_cast<int>(s.voxels.composition);
    if (s.voxels.raster &&
        choose("composition", composition, std::array{"last", "average", "max", "accumulate"})) {
        s.voxels.composition = static_cast<raster::Composition>(composition);
    }
    ImGui::Checkbox("only the visible part", &s.voxels.only_seen);
    if (const viewer::Job* job = session.job(); job != nullptr) {
        ImGui::ProgressBar(static_cast<float>(job->part()), ImVec2(190.0f, 0.0f),
                           job->stage().c_str());
        ImGui::SameLine();
        if (ImGui::Button("stop")) session.stop_job();
    } else if (ImGui::Button("voxelize (V)")) {
        session.voxelize();
    }
}

void save_controls(viewer::Session& session) {
    if (!ImGui::CollapsingHeader("Save", ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (ImGui::Button("picture (S)")) session.save_picture();
    if (!session.has_voxels()) return;
    ImGui::SameLine();
    if (ImGui::Button(".vdb (W)")) session.save_voxels();
    ImGui::SameLine();
    if (ImGui::Button("scene (E)")) session.save_scene();
}

} // namespace

void draw_panel(viewer::Session& session, PanelState& state) {
    ImGui::SetNextWindowPos(ImVec2(8.0f, 8.0f), ImGuiCond_Once);
    ImGui::SetNextWindowSize(ImVec2(kWidth, 0.0f), ImGuiCond_Always);
    ImGui::Begin("heddle", nullptr, ImGuiWindowFlags_NoResize);
    ImGui::PushItemWidth(0.62f * kWidth);
    viewer::Settings next = session.settings();
    yarn_controls(session, next, state);
    look_controls(session, next);
    voxel_controls(session, next);
    session.set(next);
    save_controls(session);
    ImGui::PopItemWidth();
    ImGui::Separator();
    if (session.has_slices())
        ImGui::Text("%lld slices", static_cast<long long>(session.slice_count()));
    ImGui::Text("answered in %.0f ms%s", state.answer_ms, session.busy() ? ", refining" : "");
    if (!session.message().empty()) ImGui::TextWrapped("%s", session.message().c_str());
    ImGui::End();
}

} // namespace heddle::window
