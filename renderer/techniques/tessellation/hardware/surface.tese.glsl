// SPDX-License-Identifier: BSD-3-Clause
// A vertex of the tessellator. See hardware.cpp. SPACING: equal_spacing, fractional_even_spacing, fractional_odd_spacing.
#include "renderer/techniques/tessellation/evaluate.glsl"

#ifdef RECTANGLES
layout(quads, SPACING, ccw) in;
#else
layout(triangles, SPACING, ccw) in;
#endif

in uint patchNumber[];
uniform mat4 anchorToClip;
out vec3 normal;
out float distance_;
flat out uint material;

void main() {
  const TessellatedPatch patch_ = patches[patchNumber[0]];
  // Along a side the tessellator gives both of t and 1 - t or neither, so that the difference is exact.
#ifdef RECTANGLES
  const vec4 at = vec4(gl_TessCoord.xy, 1.0 - gl_TessCoord.xy);
#else
  const vec4 at = vec4(gl_TessCoord, 0.0);
#endif
  const TessellatedVertex vertex = surfaceVertex(patch_, at);
  precise const vec4 clip = anchorToClip * vec4(vertex.position, 1.0);
  gl_Position = clip;
  normal = vertex.normal;
  distance_ = clip.w;
  material = vertex.material;
}
