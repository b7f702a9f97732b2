// SPDX-License-Identifier: BSD-3-Clause
// A stored pattern's vertex on the patch of its instance. ADAPTED: the pattern is uniform, and samples on a side go to the
// nearest of the side's own (Schwarz 2009, section 7.5.4; SC-65, SC-66). CONNECTING: the pattern lies along a side alone, of
// which there are 4 for each patch. GAPS: along two sides with the same ends. INSTANCES: each vertex has a patch and a
// sample of its own (SC-76). CAPTURE: transform feedback stores vertices as TessellatedVertex.
// COARSE: patches with more than one segment vanish. BORDER: of a band along a side (with CONNECTING; SC-64).
#include "renderer/techniques/tessellation/evaluate.glsl"

#ifdef INSTANCES
layout(location = 0) in uvec2 numberAndSample;
#else
layout(location = 0) in ivec4 sample_;
layout(location = 1) in uint number;
#endif
layout(std430, binding = kFactorsBuffer) readonly buffer Factors { PatchFactors factors[]; };
#ifdef GAPS
layout(std430, binding = kGapStripsBuffer) readonly buffer GapStrips { uvec2 gapStrips[]; };  // 4 patch + side, of both
#endif
uniform mat4 anchorToClip;
#ifdef BORDER
uniform vec2 sizePx;
uniform float borderPx;
#endif
#ifdef CAPTURE
layout(xfb_buffer = 0, xfb_stride = 32) out;
layout(xfb_offset = 0) out vec3 position;
layout(xfb_offset = 12) flat out uint material;
layout(xfb_offset = 16) out vec3 normal;
layout(xfb_offset = 28) flat out uint rung;
#else
out vec3 normal;
flat out uint material;
#endif
out float distance_;

#ifdef GAPS
TessellatedVertex sideVertex(uint side, int q, int n) {
  const TessellatedPatch patch_ = patches[side / 4u];
  const uint shape = shapeOf(patch_);
  return surfaceVertex(patch_, domainPoint(shape, patternSideSample(isRectangle(shape) ? 1 : 0, int(side & 3u), q, n)));
}

// sample_: (q, segments, 1 on the other side, 0). Normals come from one of the two patches.
TessellatedVertex gapVertex() {
  const uvec2 strip = gapStrips[number];
  const int q = sample_.x, n = sample_.y;
  const TessellatedVertex own = sideVertex(strip.x & ~kGapNormalsOfOwn, q, n), other = sideVertex(strip.y, n - q, n);
  TessellatedVertex vertex = (strip.x & kGapNormalsOfOwn) != 0u ? own : other;
  vertex.position = sample_.z == 0 ? own.position : other.position;
  return vertex;
}
#endif

#ifdef BORDER
vec4 clipOf(TessellatedPatch patch_, int q) {
  const uint shape = shapeOf(patch_);
  const ivec4 s = patternSideSample(isRectangle(shape) ? 1 : 0, int(number & 3u), q, sample_.y);
  return anchorToClip * vec4(positionOf(jetAt(patch_, domainPoint(shape, s)).p), 1.0);
}

// Away from the side on the screen, and a little behind it, so that surfaces cover bands that they lie beside.
vec4 besideSide(TessellatedPatch patch_, vec4 clip) {
  const vec4 from = clipOf(patch_, max(sample_.x - 1, 0)), to = clipOf(patch_, min(sample_.x + 1, sample_.y));
  const vec2 along = (to.xy * from.w - from.xy * to.w) * sizePx;
  const float length_ = length(along);
  if (length_ == 0.0 || from.w <= 0.0 || to.w <= 0.0) return clip;
  const vec2 across = vec2(-along.y, along.x) / length_ * (sample_.z == 0 ? borderPx : -borderPx);
  return vec4(clip.xy + across * 2.0 / sizePx * clip.w, clip.z * (1.0 - 1e-4), clip.w);
}
#endif

void main() {
#ifdef INSTANCES
  const uint number = numberAndSample.x;
  const ivec4 sample_ = unpackedSegments(numberAndSample.y);
#endif
#ifdef GAPS
  const TessellatedVertex vertex = gapVertex();
#else
#ifdef CONNECTING
  const TessellatedPatch patch_ = patches[number / 4u];
#else
  const TessellatedPatch patch_ = patches[number];
#endif
  const uint shape = shapeOf(patch_);
#ifdef COARSE
  const uint sides = isRectangle(shape) ? 0xffffffffu : 0xffffffu;
  if ((factors[number].segments & sides) != (0x01010101u & sides)) {
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
    normal = vec3(0.0);
    distance_ = 1.0;
    material = 0u;
    return;
  }
#endif
#ifdef CONNECTING
  const ivec4 s = patternSideSample(isRectangle(shape) ? 1 : 0, int(number & 3u), sample_.x, sample_.y);
#elif defined(ADAPTED)
  const ivec4 s = adaptedSample(isRectangle(shape) ? 1 : 0, sample_, unpackedSegments(factors[number].segments));
#else
  const ivec4 s = sample_;
#endif
  const TessellatedVertex vertex = surfaceVertex(patch_, domainPoint(shape, s));
#endif
  precise const vec4 clip = anchorToClip * vec4(vertex.position, 1.0);
#ifdef BORDER
  gl_Position = besideSide(patch_, clip);
#else
  gl_Position = clip;
#endif
  normal = vertex.normal;
  distance_ = clip.w;
  material = vertex.material;
#ifdef CAPTURE
  position = vertex.position;
  rung = vertex.rung;
#endif
}
