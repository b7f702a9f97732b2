// SPDX-License-Identifier: BSD-3-Clause
// Attributes of all drawn vertices, from the patch that draws each, once for a level: they do not move. Weights are those of
// positions where no seam is near (Holländer 2013, section 2.2.2).
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kSubdivisionPatchesBuffer) readonly buffer Patches { uvec4 patches[]; };  // MeshPatch, of attributes
layout(std430, binding = kSubdivisionPointsBuffer) readonly buffer Points { uint points[]; };
layout(std430, binding = kSubdivisionTablesBuffer) readonly buffer Weights { float weights[]; };
layout(std430, binding = kSubdivisionSourcesBuffer) readonly buffer Sources { uvec2 sources[]; };
layout(std430, binding = kAttributeValuesBuffer) readonly buffer Values { vec4 values[]; };
layout(std430, binding = kFineAttributesBuffer) writeonly buffer FineAttributes { vec4 fineAttributes[]; };
layout(std430, binding = kPackedAttributesBuffer) writeonly buffer PackedAttributes { uint packedAttributes[]; };

uniform uint rows, innerRows, firstBorderRow, cornerCount, edgeCount, vertexCount;
uniform int level;

// Patch and row of a drawn vertex: see fine_vertices.comp.glsl.
uvec2 rowOfVertex(uint vertex) {
  const uint each = (1u << level) - 1u;
  if (vertex < cornerCount) {
    const uint source = sources[edgeCount + vertex].y;
    return uvec2(source >> 2, firstBorderRow + uint(CORNERS) * each + (source & 3u));
  }
  vertex -= cornerCount;
  if (vertex < edgeCount * each) {
    const uint source = sources[vertex / each].y;
    return uvec2(source >> 3, firstBorderRow + (source >> 1 & 3u) * each + vertex % each);
  }
  vertex -= edgeCount * each;
  const uint inner = vertex % innerRows, block = uint(ROWS * kMeshLanes), inBlock = inner % block;
  return uvec2(vertex / innerRows, inner - inBlock + uint(ROWS) * (inBlock % uint(kMeshLanes)) + inBlock / uint(kMeshLanes));
}

void main() {
  const uint vertex = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * uint(kSubdivisionGroup);
  if (vertex >= vertexCount) return;
  const uvec2 found = rowOfVertex(vertex);
  const uvec4 head = patches[found.x];
  precise vec3 sum = vec3(0.0);
  for (uint s = 0u; s < head.y; ++s) sum = fma(vec3(weights[head.z + s * rows + found.y]), values[points[head.x + s]].xyz, sum);
  fineAttributes[vertex] = vec4(sum, 0.0);
  packedAttributes[vertex] = packUnorm2x16(sum.xy);
}
