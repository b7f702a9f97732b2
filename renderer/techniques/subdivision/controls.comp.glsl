// SPDX-License-Identifier: BSD-3-Clause
// First step (Holländer 2013, section 2.2.2): positions of the refined mesh, one invocation each. NORMALS_FROM_CAGE: its
// normals too, by the same weights from those of the control mesh.
#include "renderer/techniques/subdivision/subdivision_bindings.h"

layout(local_size_x = kSubdivisionGroup) in;
layout(std430, binding = kCagePositionsBuffer) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = kControlEntriesBuffer) readonly buffer Entries { ControlEntry entries[]; };
layout(std430, binding = kStencilTermsBuffer) readonly buffer Terms { StencilTerm terms[]; };
layout(std430, binding = kControlsBuffer) writeonly buffer Controls { vec4 controls[]; };  // ControlVertex
#ifdef NORMALS_FROM_CAGE
layout(std430, binding = kCageNormalsBuffer) readonly buffer Normals { vec4 normals[]; };
#endif
uniform uint controlCount;

void main() {
  const uint c = gl_GlobalInvocationID.x;
  if (c >= controlCount) return;
  const ControlEntry entry = entries[c];
  precise vec3 sum = vec3(0.0);
  vec3 normal = vec3(0.0);
  for (uint i = 0u; i < entry.terms; ++i) {
    const StencilTerm term = terms[entry.firstTerm + i];
    sum += term.weight * positions[term.vertex].xyz;
#ifdef NORMALS_FROM_CAGE
    normal += term.weight * normals[term.vertex].xyz;
#endif
  }
  controls[2u * c] = vec4(sum, 0.0);
#ifdef NORMALS_FROM_CAGE
  const float size = dot(normal, normal);
  controls[2u * c + 1u] = vec4(size > 0.0 ? normal * inversesqrt(size) : vec3(0.0), 0.0);
#endif
}
