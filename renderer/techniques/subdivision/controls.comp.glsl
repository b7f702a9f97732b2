// SPDX-License-Identifier: BSD-3-Clause
// First step (Holländer 2013, section 2.2.2): positions of the refined mesh, one invocation each. NORMALS_FROM_CAGE: its
// normals too, by the same weights from those of the control mesh. Terms are read four at a time, so that their latencies overlap.
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kControlEntriesBuffer) readonly buffer Entries { ControlEntry entries[]; };
layout(std430, binding = kStencilTermsBuffer) readonly buffer Terms { StencilTerm terms[]; };
layout(std430, binding = kControlsBuffer) writeonly buffer Controls { vec4 controls[]; };  // ControlVertex
#ifdef NORMALS_FROM_CAGE
layout(std430, binding = kCagePositionsBuffer) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = kCageNormalsBuffer) readonly buffer Normals { vec4 normals[]; };
vec3 posed(uint vertex) { return positions[vertex].xyz; }
#else
#include "renderer/techniques/subdivision/skinned.glsl"
vec3 posed(uint vertex) { return skinned(vertex); }
#endif
uniform uint controlCount;

const uint kBatch = 4u;

void main() {
  const uint c = gl_GlobalInvocationID.x;
  if (c >= controlCount) return;
  const ControlEntry entry = entries[c];
  precise vec3 sum = vec3(0.0);
  vec3 normal = vec3(0.0);
  for (uint first = 0u; first < entry.terms; first += kBatch) {
    StencilTerm batch[kBatch];
    vec3 at[kBatch];
    for (uint i = 0u; i < kBatch; ++i) batch[i] = terms[entry.firstTerm + min(first + i, entry.terms - 1u)];
    for (uint i = 0u; i < kBatch; ++i) at[i] = posed(batch[i].vertex);
    for (uint i = 0u; i < kBatch; ++i) {
      const float weight = first + i < entry.terms ? batch[i].weight : 0.0;
      sum += weight * at[i];
#ifdef NORMALS_FROM_CAGE
      normal += weight * normals[batch[i].vertex].xyz;
#endif
    }
  }
  controls[2u * c] = vec4(sum, 0.0);
#ifdef NORMALS_FROM_CAGE
  const float size = dot(normal, normal);
  controls[2u * c + 1u] = vec4(size > 0.0 ? normal * inversesqrt(size) : vec3(0.0), 0.0);
#endif
}
