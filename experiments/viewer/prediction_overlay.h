// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/viewer/evaluation_thread.h"

namespace limen::viewer {

/// Paints what the request asks for over its picture: EvaluationResult::overlay and its note. Needs no GL.
/// For popping, the second picture is the one replaced, or the reference if there is none.
/// If there is no picture, the note says why.
void paintOverlay(const EvaluationRequest& request, EvaluationResult& result);

/// Whether what the request asks for can be painted only over a reference.
bool overlayNeedsReference(const EvaluationRequest& request);

}  // namespace limen::viewer
