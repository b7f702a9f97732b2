// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

namespace limen::ray_tracing {

/// Nodes or triangles of a tree in a buffer. Throws Error if the device cannot hold them.
template <class T>
gl::Buffer uploadTree(const std::vector<T>& data) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  const auto bytes = static_cast<int64_t>(data.size() * sizeof(T));
  if (bytes > most)
    throw Error("a tree for rays takes " + std::to_string(bytes) +
                    " bytes in one buffer; this device allows " + std::to_string(most),
                {}, "use a smaller scene, or trace rays on the CPU");
  return gl::Buffer(data);
}

/// Loop iterations that an invocation may take; beyond it a software renderer would leave loops silently.
inline int mostRayIterations(const gl::Context& context) {
  return context.device().software ? 60000 : 0x7fffffff;
}

}  // namespace limen::ray_tracing
