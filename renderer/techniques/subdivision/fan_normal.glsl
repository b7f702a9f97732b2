// SPDX-License-Identifier: BSD-3-Clause
// Normal of a vertex from the fan of triangles around it, weighted by their areas; 0 where they have none. The includer
// declares fans[] and positionOf().

vec3 fanNormal(vec3 centre, ControlEntry entry) {
  const uint around = entry.around & 0x7fffffffu;
  const bool closed = (entry.around >> 31) != 0u;
  if (around < 2u) return vec3(0.0);
  const vec3 first = positionOf(fans[entry.firstAround]) - centre;
  vec3 last = first, sum = vec3(0.0);
  for (uint i = 1u; i < around; i += 4u) {  // four at a time: their latencies overlap
    vec3 edges[4];
    for (uint j = 0u; j < 4u; ++j) edges[j] = positionOf(fans[entry.firstAround + min(i + j, around - 1u)]) - centre;
    for (uint j = 0u; j < 4u; ++j) {
      if (i + j < around) sum += cross(last, edges[j]);
      last = edges[j];
    }
  }
  if (closed) sum += cross(last, first);
  // Scaled, as areas of small meshes have squares that vanish.
  const float size = max(abs(sum.x), max(abs(sum.y), abs(sum.z)));
  return size > 0.0 ? normalize(sum / size) : vec3(0.0);
}
