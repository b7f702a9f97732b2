// SPDX-License-Identifier: BSD-3-Clause
// A vertex of a divided triangle at its own reflection point. COUNT: only counts.
#include "renderer/techniques/reflections/vertex_reflection/reflected.glsl"

layout(triangles, equal_spacing, ccw) in;
in vec3 patchPosition[];
in vec4 patchReflected[];
out vec3 reflectedPosition, reflectionPoint;
out float pathLength, validity;
uniform mat4 anchorToClip;
#ifdef COUNT
layout(std430, binding = kReflectionCountsBuffer) buffer Counts { ReflectionCounts counts; };
#endif

void main() {
  const vec3 at = gl_TessCoord;
  // A corner is known; along an edge, the same arithmetic from both sides.
  vec3 position = at.x * patchPosition[0] + at.y * patchPosition[1] + at.z * patchPosition[2];
  vec4 found;
  const int corner = at.x == 1.0 ? 0 : at.y == 1.0 ? 1 : at.z == 1.0 ? 2 : -1;
  if (corner >= 0) {
    position = patchPosition[corner];
    found = patchReflected[corner];
  } else {
    found = reflectedVertex(position, vec4(0.0));
#ifdef COUNT
    atomicAdd(counts.evaluated, 1u);
    atomicAdd(counts.iterations, statusOf(found) & 255u);
    if (usable(found)) atomicAdd(counts.found, 1u);
#endif
  }
  reflectedPosition = position;
  reflectionPoint = found.xyz;
  pathLength = length(found.xyz - position);
  validity = usable(found) ? 1.0 : 0.0;
  gl_Position = anchorToClip * vec4(found.xyz, 1.0);
}
