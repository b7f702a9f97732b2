// SPDX-License-Identifier: BSD-3-Clause
// A stored pattern's vertex on the patch of its instance. ADAPTED: the pattern is uniform, and samples on a side go to the
// nearest of the side's own (Schwarz 2009, section 7.5.4; SC-65, SC-66). CONNECTING: the pattern lies along a side alone, of
// which there are 4 for each patch.
#include "renderer/techniques/tessellation/evaluate.glsl"

layout(location = 0) in ivec4 sample_;
layout(location = 1) in uint number;
layout(std430, binding = kFactorsBuffer) readonly buffer Factors { PatchFactors factors[]; };
uniform mat4 anchorToClip;
out vec3 normal;
out float distance_;
flat out uint material;

void main() {
#ifdef CONNECTING
  const TessellatedPatch patch_ = patches[number / 4u];
#else
  const TessellatedPatch patch_ = patches[number];
#endif
  const uint shape = shapeOf(patch_);
#ifdef CONNECTING
  const ivec4 s = patternSideSample(isRectangle(shape) ? 1 : 0, int(number & 3u), sample_.x, sample_.y);
#elif defined(ADAPTED)
  const ivec4 s = adaptedSample(isRectangle(shape) ? 1 : 0, sample_, unpackedSegments(factors[number].segments));
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
