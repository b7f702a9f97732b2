// SPDX-License-Identifier: BSD-3-Clause
// A scene's patches as PatchBuffers binds them.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(std430, binding = kPatchesBuffer) readonly buffer Patches { TessellatedPatch patches[]; };
layout(std430, binding = kPatchPointsBuffer) readonly buffer PatchPoints { vec4 patchPoints[]; };

// SHAPE, if defined, is that of all patches: loops over their points are then unrolled.
#ifdef SHAPE
uint shapeOf(TessellatedPatch patch_) { return uint(SHAPE); }
#else
uint shapeOf(TessellatedPatch patch_) { return patch_.shape; }
#endif

bool isRectangle(uint shape) { return (shape & 1u) != 0u; }
int degreeU(uint shape) { return int(shape >> 1 & 15u); }
int degreeV(uint shape) { return int(shape >> 5 & 15u); }
int normalDegree(uint shape) { return int(shape >> 9 & 3u); }

int pointCount(uint shape) {
  return isRectangle(shape) ? (degreeU(shape) + 1) * (degreeV(shape) + 1)
                            : (degreeU(shape) + 1) * (degreeU(shape) + 2) / 2;
}

// Place of the point (i, j, k), i + j + k = n, among those of a triangle.
int trianglePlace(int n, int i, int k) { return (n - i) * (n - i + 1) / 2 + k; }

ivec4 unpackedSegments(uint word) {
  return ivec4(word & 255u, word >> 8 & 255u, word >> 16 & 255u, word >> 24);
}
uint packedSegments(ivec4 segments) {
  return uint(segments.x) | uint(segments.y) << 8 | uint(segments.z) << 16 | uint(segments.w) << 24;
}
ivec4 unpackedUnits(uvec2 words) {
  return ivec4(words.x & 65535u, words.x >> 16, words.y & 65535u, words.y >> 16);
}
uvec2 packedUnits(ivec4 units) {
  return uvec2(uint(units.x) | uint(units.y) << 16, uint(units.z) | uint(units.w) << 16);
}
