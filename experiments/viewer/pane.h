// SPDX-License-Identifier: BSD-3-Clause
// What panes have in common: their inputs, and the widgets that several of them show.
#pragma once

#include <imgui.h>

#include <string>

#include "experiments/base/quantity.h"
#include "experiments/viewer/controls.h"
#include "experiments/viewer/number_text.h"
#include "experiments/viewer/viewer_command.h"
#include "experiments/viewer/viewer_state.h"

namespace limen::viewer {

/// A pane reads the state, requests changes by commands and records where its controls are.
struct PaneContext {
  const ViewerState& state;
  CommandQueue& commands;
  ControlMap& controls;
};

/// A window at a fixed position, without decoration.
constexpr ImGuiWindowFlags kFixedWindow =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings;
const ImVec4 kInProgressColour(1.0F, 0.8F, 0.4F, 1.0F);

/// The heading of a collapsible section; true if it is open.
bool heading(const char* text);
void errorText(const std::string& text);
/// Of secondary importance; wraps where the pane is narrow, so that no figure is cut.
void dimText(const std::string& text);
/// A table with names in the first column, which shrinks, and numbers in the others, which do not. If it
/// returns true (visible), call ImGui::EndTable().
bool numberTable(const char* id, int columns);
/// A name that may be too long for its column.
void label(const std::string& text);
/// A number as numberText() prints it; more digits in the tooltip.
void numberCell(double value, const std::string& unit);
/// "lower is better"; "" for neither.
std::string directionText(Direction direction);

}  // namespace limen::viewer
