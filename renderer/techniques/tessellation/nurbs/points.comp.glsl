// SPDX-License-Identifier: BSD-3-Clause
// Vertices of a grid over a NURBS surface. GRID: from the tables of basis.comp.glsl, otherwise each for itself.
#include "renderer/techniques/tessellation/nurbs/nurbs.glsl"
#include "renderer/techniques/tessellation/store_vertex.glsl"

layout(local_size_x = kTessellationGroup) in;
#ifdef GRID
layout(std430, binding = kNurbsBasisBuffer) readonly buffer Basis { BasisRecord records[]; };
#endif

void main() {
  const NurbsRecord of = surfaces[surfaceNumber];
  const uint number = gl_GlobalInvocationID.x;
  if (number >= of.columns * of.rows) return;
  const uint row = number / of.columns, column = number - row * of.columns;
  const float u = parameters[of.firstU + column], v = parameters[of.firstV + row];
#ifdef GRID
  const NurbsJet jet = combined(of, records[of.firstU + column], records[of.firstV + row]);
#else
  const NurbsJet jet = jetAt(of, u, v);
#endif
  TessellatedVertex vertex;
  vertex.position = jet.p.xyz / jet.p.w;
  vertex.material = of.material;
  bool degenerate;
  vec3 normal = normalOf(jet, degenerate);
  vertex.rung = kRungTangents;
  if (degenerate) {
    // As at poles: that of a place a thousandth of the way to the middle of the domain (SC-04).
    const vec2 low = vec2(parameters[of.firstU], parameters[of.firstV]),
               high = vec2(parameters[of.firstU + of.columns - 1u], parameters[of.firstV + of.rows - 1u]);
    const vec2 inside = mix(vec2(u, v), 0.5 * (low + high), 1e-3);
    normal = normalOf(jetAt(of, inside.x, inside.y), degenerate);
    vertex.rung = degenerate ? kRungNone : kRungInward;
  }
  const float reach = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
  vertex.normal = reach > 0.0 ? normalize(normal / reach) : vec3(0.0, 0.0, 1.0);
  storeVertex(of.firstVertex + number, vertex);
}
