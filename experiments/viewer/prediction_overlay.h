// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/viewer/evaluation_thread.h"

namespace limen::viewer {

/// Paints what the request asks for over its picture: EvaluationResult::overlay and its note. Needs no GL. Of
/// popping, the second picture is the one replaced; without one it is the reference.
void paintOverlay(const EvaluationRequest& request, EvaluationResult& result);

}  // namespace limen::viewer
