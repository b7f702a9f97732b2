// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/viewer/judge_thread.h"

namespace limen::viewer {

/// Paints what the request asks for over its picture: JudgeResult::overlay and its note. Needs no GL. Of
/// popping, the second picture is the one replaced; without one it is the reference.
void paintOverlay(const JudgeRequest& request, JudgeResult& result);

}  // namespace limen::viewer
