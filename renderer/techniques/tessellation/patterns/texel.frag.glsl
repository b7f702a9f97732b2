// SPDX-License-Identifier: BSD-3-Clause
// Evaluates a vertex; as pattern.vert.glsl does. ADAPTED: see there.
#include "renderer/techniques/tessellation/evaluate.glsl"

layout(std430, binding = kFactorsBuffer) readonly buffer Factors { PatchFactors factors[]; };
flat in uint patch_;
flat in ivec4 at;
layout(location = 0) out uvec4 position;  // bits, and the material
layout(location = 1) out uvec4 normal;    // bits, and the rung

void main() {
  const TessellatedPatch record = patches[patch_];
  const uint shape = shapeOf(record);
#ifdef ADAPTED
  const ivec4 s = adaptedSample(isRectangle(shape) ? 1 : 0, at, unpackedSegments(factors[patch_].segments));
#else
  const ivec4 s = at;
#endif
  const TessellatedVertex vertex = surfaceVertex(record, domainPoint(shape, s));
  position = uvec4(floatBitsToUint(vertex.position), vertex.material);
  normal = uvec4(floatBitsToUint(vertex.normal), vertex.rung);
}
