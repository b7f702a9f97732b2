// SPDX-License-Identifier: BSD-3-Clause
// The panes on the right that show what was measured, and the line of messages.
#pragma once

#include "experiments/viewer/pane.h"

namespace limen::viewer {

/// `widthPx`: of the pane; a narrow one omits columns.
void timePane(const PaneContext& pane, float widthPx);
void errorPane(const PaneContext& pane);
void counterPane(const PaneContext& pane);
void pixelPane(const PaneContext& pane);

/// What the message bar needs on a surface of this width, so that all of it is in sight.
float messageBarHeight(const ViewerState& state, float widthPx);
/// At the lower edge of a surface of `sizePx`.
void messageBar(const PaneContext& pane, glm::vec2 sizePx, float heightPx);
/// Over the picture, if a changed shader was refused.
void shaderFailureWindow(const PaneContext& pane, glm::vec2 leastPx, float widthPx);

}  // namespace limen::viewer
