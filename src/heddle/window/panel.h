#pragma once

#include <heddle/viewer/session/session.h>

namespace heddle::window {

/// The state of the panel beside the session's settings.
struct PanelState {
    int kind = 0;           ///< index of the kind of yarn that is edited
    double answer_ms = 0.0; ///< how long the last input took to show
};

/// Draws the controls of a session with Dear ImGui, between its NewFrame and Render, and applies
/// the changes.
void draw_panel(viewer::Session& session, PanelState& state);

} // namespace heddle::window
