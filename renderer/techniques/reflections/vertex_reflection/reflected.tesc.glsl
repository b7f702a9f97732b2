// SPDX-License-Identifier: BSD-3-Clause
// Segments of the edges of a reflected triangle: by the distance in the picture between the reflection of an edge's
// middle and the middle of the reflected edge, which falls with the square of the segments (Roger 2008, section 2.3.4).
#include "renderer/techniques/reflections/vertex_reflection/reflected.glsl"

layout(vertices = 3) out;
in vec3 cornerPosition[];
in vec4 cornerReflected[];
out vec3 patchPosition[];
out vec4 patchReflected[];
out float edgeSegments[];  // of the edge that the corner is not on
uniform float tolerancePx;
uniform int mostSegments;
uniform float nearness;  // of points that project, as clip w

float segmentsOf(int i, int j) {
  const bool first = usable(cornerReflected[i]), second = usable(cornerReflected[j]);
  const vec4 middle = reflectedVertex(0.5 * (cornerPosition[i] + cornerPosition[j]), vec4(0.0));
  const bool third = usable(middle);
  if (!first && !second && !third) return 1.0;
  if (!first || !second || !third) {
    // The reflection ends somewhere along the edge.
#if POLICY == POLICY_SUBDIVIDE
    return float(mostSegments);
#else
    return 1.0;
#endif
  }
  vec2 a, b;
  const vec3 chord = 0.5 * (cornerReflected[i].xyz + cornerReflected[j].xyz);
  const bool seen = placeOf((middle.xyz - reflectorCentre) / reflectorUnit, a) &&
                    placeOf((chord - reflectorCentre) / reflectorUnit, b);
  if (!seen) return float(mostSegments);
  const float segments = ceil(sqrt(length(a - b) / tolerancePx));
  return segments > 1.0 ? min(segments, float(mostSegments)) : 1.0;
}

void main() {
  const int i = gl_InvocationID, j = (i + 1) % 3, k = (i + 2) % 3;
  patchPosition[gl_InvocationID] = cornerPosition[i];
  patchReflected[gl_InvocationID] = cornerReflected[i];
  edgeSegments[gl_InvocationID] = segmentsOf(min(j, k), max(j, k));
  barrier();
  if (gl_InvocationID != 0) return;
  // Outer level i belongs to the edge that corner i is not on.
  gl_TessLevelOuter[0] = edgeSegments[0];
  gl_TessLevelOuter[1] = edgeSegments[1];
  gl_TessLevelOuter[2] = edgeSegments[2];
  gl_TessLevelInner[0] = max(edgeSegments[0], max(edgeSegments[1], edgeSegments[2]));
}
