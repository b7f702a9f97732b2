// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_dispatch.h"

#include <epoxy/gl.h>

#include "renderer/techniques/global_illumination/illumination_bindings.h"

namespace limen::techniques {

void dispatchVoxels(glm::ivec3 size) {
  const glm::ivec3 groups = (size + kPropagateGroup - 1) / kPropagateGroup;
  glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                    static_cast<GLuint>(groups.z));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques
