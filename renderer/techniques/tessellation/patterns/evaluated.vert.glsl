// SPDX-License-Identifier: BSD-3-Clause
// A vertex that the pixel shader evaluated before. `place`: see texel.vert.glsl.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(location = 2) in uint place;
layout(std430, binding = kEvaluatedPositionsBuffer) readonly buffer Positions { uvec4 positions[]; };
layout(std430, binding = kEvaluatedNormalsBuffer) readonly buffer Normals { uvec4 normals[]; };
uniform mat4 anchorToClip;
out vec3 normal;
out float distance_;
flat out uint material;

void main() {
  const uint at = place + uint(gl_VertexID);
  const uvec4 found = positions[at];
  precise const vec4 clip = anchorToClip * vec4(uintBitsToFloat(found.xyz), 1.0);
  gl_Position = clip;
  normal = uintBitsToFloat(normals[at].xyz);
  distance_ = clip.w;
  material = found.w;
}
