// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/glm.hpp>

namespace limen::techniques {

/// Pixels through which the line of sight does not leave closed surfaces as often as it enters them: those of
/// cracks, seen or hidden, and of holes that the surfaces have anyway. Folds do not count. `draw` draws all
/// triangles, backs too, with crossings.frag.glsl. Waits for the GPU.
uint32_t unevenCrossings(glm::ivec2 sizePx, const std::function<void()>& draw);

}  // namespace limen::techniques
