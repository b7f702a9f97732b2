// SPDX-License-Identifier: BSD-3-Clause
// Morton codes of the triangles' centres, kAxisBits bits an axis, in two words (low, high). What does not belong into the
// tree comes last.
#include "renderer/ray_tracing/tree_triangles.glsl"

layout(local_size_x = kTreeGroup) in;
layout(std430, binding = kTreeControlBuffer) readonly buffer Control { TreeControl control; };
layout(std430, binding = kTreeKeysBuffer) writeonly buffer Keys { uvec2 keys[]; };
layout(std430, binding = kTreeOrderBuffer) writeonly buffer Order { uint order[]; };

uniform uint triangleCount;

float numberOf(uint word) { return uintBitsToFloat((word & 0x80000000u) != 0u ? word & 0x7fffffffu : ~word); }

// Ten bits, each followed by two zeros.
uint spread(uint v) {
  v = (v | (v << 16)) & 0x030000ffu;
  v = (v | (v << 8)) & 0x0300f00fu;
  v = (v | (v << 4)) & 0x030c30c3u;
  return (v | (v << 2)) & 0x09249249u;
}

uint interleaved(uvec3 v) { return spread(v.x) << 2 | spread(v.y) << 1 | spread(v.z); }

uvec2 codeOf(vec3 centre) {
  // In double precision no extent overflows.
  const dvec3 low = dvec3(numberOf(~control.low[0]), numberOf(~control.low[1]), numberOf(~control.low[2]));
  const dvec3 high = dvec3(numberOf(control.high[0]), numberOf(control.high[1]), numberOf(control.high[2]));
  const dvec3 extents = high - low;
  const double extent = max(extents.x, max(extents.y, extents.z));
  const uint most = (1u << uint(AXIS_BITS)) - 1u;
  uvec3 cell = uvec3(0u);
  // Cells are cubes.
  if (extent > 0.0lf)
    cell = uvec3(clamp((dvec3(centre) - low) / extent * double(most + 1u), dvec3(0.0lf), dvec3(double(most))));
  cell = min(cell, uvec3(most));
  const uint first = interleaved(cell & 1023u), second = interleaved((cell >> 10) & 1023u),
             third = interleaved(cell >> 20);
  uvec2 code = uvec2(first | second << 30, second >> 2 | third << 28);
  // All ones are what comes last.
  if (cell == uvec3(most)) --code.x;
  return code;
}

void main() {
  const uint triangle = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(kTreeGroup) +
                        gl_LocalInvocationIndex;
  if (triangle >= triangleCount) return;
  const uvec3 t = treeTriangle(triangle);
  const vec3 a = treeVertex(t.x), b = treeVertex(t.y), c = treeVertex(t.z);
  keys[triangle] = treeIsValid(a, b, c) ? codeOf(treeCentre(treeBox(a, b, c))) : uvec2(0xffffffffu);
  order[triangle] = triangle;
}
