// SPDX-License-Identifier: BSD-3-Clause
// A level for each edge of the refined mesh: a group a patch, an invocation a side. The ends count alike, so that both sides
// of a sharp edge get the same.
#include "renderer/techniques/subdivision/tables.glsl"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kEdgeLevelsBuffer) writeonly buffer EdgeLevels { float edgeLevels[]; };
uniform uint patchCount;
uniform vec3 eye;
uniform float pxAtDistance, nearest, segmentPx;
uniform int randomLevels, wholeLevels, mostLevel;

float randomOf(vec3 p) {
  uint h = floatBitsToUint(p.x) * 2654435761u ^ floatBitsToUint(p.y) * 2246822519u ^ floatBitsToUint(p.z) * 3266489917u;
  h ^= h >> 15;
  h *= 2246822519u;
  h ^= h >> 13;
  return float(h >> 8) / 16777216.0;
}

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  const int side = int(gl_LocalInvocationIndex);
  if (number >= patchCount || side >= CORNERS) return;
  const SubdivisionPatch record = patches[number];
  if (((record.writes >> side) & 1u) == 0u) return;
  precise const vec3 a = controls[2u * record.corners[side]].xyz, b = controls[2u * record.corners[(side + 1) % CORNERS]].xyz;
  precise const vec3 middle = 0.5 * (a + b);
  precise const float px = distance(a, b) * pxAtDistance / max(nearest, distance(middle, eye));
  float level = clamp(log2(max(px / segmentPx, 1.0)), 0.0, float(mostLevel));
  if (randomLevels != 0) level = randomOf(middle) * float(mostLevel);
  edgeLevels[record.edges[side]] = wholeLevels != 0 ? ceil(level) : level;
}
