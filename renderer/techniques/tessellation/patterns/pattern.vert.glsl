// SPDX-License-Identifier: BSD-3-Clause
// A stored pattern's vertex on the patch of its instance. ADAPTED: the pattern is uniform, and samples on a side go to the
// nearest of the side's own (Schwarz 2009, section 7.5.4; SC-65, SC-66).
#include "renderer/techniques/tessellation/evaluate.glsl"

layout(location = 0) in ivec4 sample_;
layout(location = 1) in uint number;
layout(std430, binding = kFactorsBuffer) readonly buffer Factors { PatchFactors factors[]; };
uniform mat4 anchorToClip;
out vec3 normal;
out float distance_;
flat out uint material;

#ifdef ADAPTED
ivec4 adapted(ivec4 s, int rectangle, ivec4 segments) {
  const int side = sideOfSample(rectangle, s);
  if (side < 0) return s;
  int q, n = s.w;
  if (rectangle == 1) {
    n = side % 2 == 0 ? s.y : s.w;
    q = side == 0 ? s.x : (side == 1 ? s.z : (side == 2 ? n - s.x : n - s.z));
  } else {
    q = side == 0 ? s.y : (side == 1 ? s.z : s.x);
  }
  const int m = segments[side];
  // The nearer end on either half, so that it does not matter which way the side runs.
  const int nearest = 2 * q < n ? (2 * m * q - n + 2 * n - 1) / (2 * n) : (2 * m * q + n) / (2 * n);
  return patternSideSample(rectangle, side, nearest, m);
}
#endif

void main() {
  const TessellatedPatch patch_ = patches[number];
  const uint shape = shapeOf(patch_);
#ifdef ADAPTED
  const ivec4 s = adapted(sample_, isRectangle(shape) ? 1 : 0, unpackedSegments(factors[number].segments));
#else
  const ivec4 s = sample_;
#endif
  const TessellatedVertex vertex = surfaceVertex(patch_, domainPoint(shape, s));
  precise const vec4 clip = anchorToClip * vec4(vertex.position, 1.0);
  gl_Position = clip;
  normal = vertex.normal;
  distance_ = clip.w;
  material = vertex.material;
}
