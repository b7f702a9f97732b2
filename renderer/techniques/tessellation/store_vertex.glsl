// SPDX-License-Identifier: BSD-3-Clause
// Vertices are written sixteen bytes at a time: members stored one by one are eight stores of four bytes each, which take
// twice as long.
#include "renderer/techniques/tessellation/tessellation_bindings.h"

layout(std430, binding = kVerticesBuffer) writeonly buffer VertexWords { uvec4 vertexWords[]; };

void storeVertex(uint at, TessellatedVertex vertex) {
  vertexWords[2u * at] = uvec4(floatBitsToUint(vertex.position), vertex.material);
  vertexWords[2u * at + 1u] = uvec4(floatBitsToUint(vertex.normal), vertex.rung);
}
