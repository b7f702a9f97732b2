// SPDX-License-Identifier: BSD-3-Clause
// Rays through the cells of a uniform grid, one after another (Amanatides and Woo 1987). Part of trace.glsl.
uniform vec3 rayGridLow, rayGridCell, rayGridSize;  // size: whole numbers

RayHit rayTraverse(Ray ray, bool anyIsEnough) {
  RayHit hit = RayHit(ray.far, kRayNoTriangle, 0.0, 0.0);
  const vec3 size = abs(ray.direction);
  const float largest = max(size.x, max(size.y, size.z));
  if (rayNodeCount == 0u || !(largest > 0.0)) return hit;
  const RayShear shear = rayShear(ray.direction);
  const ivec3 cells = ivec3(rayGridSize);
  // A direction along an axis is tilted by less than any rounding, so that every quotient is finite.
  const bvec3 negative = lessThan(ray.direction, vec3(0.0));
  const vec3 tilted = max(size, vec3(max(largest * 8.6736174e-19, 7.8886091e-31)));
  const vec3 inverse = vec3(negative.x ? -1.0 : 1.0, negative.y ? -1.0 : 1.0, negative.z ? -1.0 : 1.0) / tilted;
  const ivec3 ahead = ivec3(negative.x ? 0 : 1, negative.y ? 0 : 1, negative.z ? 0 : 1);

  const vec3 toLow = (rayGridLow - ray.origin) * inverse;
  const vec3 toHigh = (rayGridLow + rayGridCell * rayGridSize - ray.origin) * inverse;
  const vec3 entry = min(toLow, toHigh), leave = max(toLow, toHigh);
  const float from = max(max(entry.x, entry.y), max(entry.z, ray.near));
  const float to = min(min(leave.x, leave.y), leave.z);
  if (!(from <= min(to, ray.far))) return hit;
  ivec3 cell = clamp(ivec3(floor((ray.origin + from * ray.direction - rayGridLow) / rayGridCell)), ivec3(0), cells - 1);
  while (true) {
    rayIterations += 2;  // one for the end of the inner loop
    const uint index = uint((cell.z * cells.y + cell.y) * cells.x + cell.x);
    const uint last = rayCells[index + 1u];
    for (uint i = rayCells[index]; i < last; ++i) {
      if (++rayIterations > maxRayIterations) {
        rayCutShort = true;
        return hit;
      }
      if (rayHitsTriangle(ray, shear, rayCells[rayNodeCount + 1u + i], hit) && anyIsEnough) return hit;
    }
    if (rayIterations > maxRayIterations) {
      rayCutShort = true;
      return hit;
    }
    const vec3 next = (rayGridLow + rayGridCell * vec3(cell + ahead) - ray.origin) * inverse;
    const float until = min(next.x, min(next.y, next.z));
    if (until > hit.t) return hit;
    const int axis = next.x == until ? 0 : next.y == until ? 1 : 2;
    cell[axis] += 2 * ahead[axis] - 1;
    if (cell[axis] < 0 || cell[axis] >= cells[axis]) return hit;
  }
  return hit;
}
