// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/viewer/viewer.h"
#include "renderer/window/offscreen_ui.h"

namespace limen::viewer {

/// Runs frames of the interface until everything requested is on screen, then `frames` more.
/// Throws Error if it is not there after `seconds`.
void runToRest(window::OffscreenUi& ui, Viewer& viewer, int frames, double seconds = 600.0);

/// The same, then writes what is on screen as PNG. Needs no display.
void writeScreenshot(window::OffscreenUi& ui, Viewer& viewer, int frames, const std::string& path);

}  // namespace limen::viewer
