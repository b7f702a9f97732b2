// SPDX-License-Identifier: BSD-3-Clause
// A stored pattern's vertex as the texel in which the pixel shader evaluates it. `place`: of the instance's first vertex, less
// the number of the pattern's.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(location = 0) in ivec4 sample_;
layout(location = 1) in uint number;
layout(location = 2) in uint place;
uniform int rows;
flat out uint patch_;
flat out ivec4 at;

void main() {
  const uint texel = place + uint(gl_VertexID);
  const vec2 centre = vec2(texel % uint(kEvaluationTexels), texel / uint(kEvaluationTexels)) + 0.5;
  const vec2 share = centre / vec2(kEvaluationTexels, rows);
  gl_Position = vec4(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y, 0.5, 1.0);  // row 0 lies at the top
  gl_PointSize = 1.0;
  patch_ = number;
  at = sample_;
}
