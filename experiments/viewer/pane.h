// SPDX-License-Identifier: BSD-3-Clause
// What panes have in common: what they are given, and the widgets that several of them show.
#pragma once

#include <imgui.h>

#include <string>

#include "experiments/viewer/controls.h"
#include "experiments/viewer/viewer_command.h"
#include "experiments/viewer/viewer_state.h"

namespace limen::viewer {

/// A pane reads the state, asks for changes by commands and notes where its controls are.
struct PaneContext {
  const ViewerState& state;
  CommandQueue& commands;
  ControlMap& controls;
};

/// A window at a fixed place, without decoration.
constexpr ImGuiWindowFlags kFixedWindow =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings;
const ImVec4 kInProgressColour(1.0F, 0.8F, 0.4F, 1.0F);

/// The heading of a section that can be folded; true if it is open.
bool heading(const char* text);
void errorText(const std::string& text);
/// A name in the first column, which gives way, and numbers in the others, which do not. True if it is
/// visible: then it needs ImGui::EndTable().
bool numberTable(const char* id, int columns);
/// A name that may be too long for its column.
void label(const std::string& text);
/// Enough digits to compare by eye; "" for NaN.
std::string numberText(double value);
std::string bytesText(int64_t bytes);

}  // namespace limen::viewer
