// SPDX-License-Identifier: BSD-3-Clause
// The panes on the left that choose what is rendered.
#pragma once

#include "experiments/viewer/pane.h"

namespace limen::viewer {

void scenePane(const PaneContext& pane);
void techniquePane(const PaneContext& pane);
void referencePane(const PaneContext& pane);
void secondTechniquePane(const PaneContext& pane);
void exportPane(const PaneContext& pane);

}  // namespace limen::viewer
