// SPDX-License-Identifier: BSD-3-Clause
// Basis functions of all parameters of a grid, once each (SC-17).
#include "renderer/techniques/tessellation/nurbs/nurbs.glsl"

layout(local_size_x = kTessellationGroup) in;
layout(std430, binding = kNurbsBasisBuffer) writeonly buffer Basis { BasisRecord records[]; };

void main() {
  const NurbsRecord of = surfaces[surfaceNumber];
  const uint number = gl_GlobalInvocationID.x;
  if (number >= of.columns + of.rows) return;
  const bool along = number < of.columns;
  const uint at = along ? of.firstU + number : of.firstV + number - of.columns;
  records[at] = along ? basisAt(of.firstKnotU, int(of.degreeU), int(of.pointsU), parameters[at])
                      : basisAt(of.firstKnotV, int(of.degreeV), int(of.pointsV), parameters[at]);
}
