// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

#include "experiments/executor.h"
#include "renderer/gl/context.h"
#include "renderer/scene/scene.h"

namespace limen::experiments {

/// Wall time from an empty context, with the scene in memory, until the first frame is finished: all that a
/// program needs which shows this scene with this technique [ms].
struct FirstPicture {
  double allMs = 0.0;
  double uploadMs = 0.0;   ///< of it: the scene's geometry and materials
  double compileMs = 0.0;  ///< of it: shaders, as far as the driver compiles them when they are linked
};

/// In a context of its own on the device of createHeadlessContext(), whose creation does not count. What the
/// process or the driver's cache on disk keeps from earlier contexts is not made again. Makes `current`
/// current again. Throws what the technique throws, and Error if the driver reported a problem.
FirstPicture timeFirstPicture(gl::Context& current, const scene::Scene& scene, glm::ivec2 sizePx,
                              const Configuration& technique);

}  // namespace limen::experiments
