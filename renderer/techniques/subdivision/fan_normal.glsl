// SPDX-License-Identifier: BSD-3-Clause
// Normal of a vertex from the fan of triangles around it, weighted by their areas; 0 where they have none. The includer
// declares fans[] and positionOf().

vec3 fanNormal(vec3 centre, ControlEntry entry) {
  const uint around = entry.around & 0x7fffffffu;
  const bool closed = (entry.around >> 31) != 0u;
  if (around < 2u) return vec3(0.0);
  const vec3 first = positionOf(fans[entry.firstAround]) - centre;
  vec3 last = first, sum = vec3(0.0);
  for (uint i = 1u; i < around; ++i) {
    const vec3 edge = positionOf(fans[entry.firstAround + i]) - centre;
    sum += cross(last, edge);
    last = edge;
  }
  if (closed) sum += cross(last, first);
  // Scaled, as areas of small meshes have squares that vanish.
  const float size = max(abs(sum.x), max(abs(sum.y), abs(sum.z)));
  return size > 0.0 ? normalize(sum / size) : vec3(0.0);
}
