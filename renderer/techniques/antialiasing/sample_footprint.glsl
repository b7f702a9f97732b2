// SPDX-License-Identifier: BSD-3-Clause
// The part of a surface that a sample stands for, from gradients of positions over samples, wider the fewer samples of the pixel are
// shaded (Holländer 2013, section 4.3.4). The includer declares sampleIds and sizePx.

#if GRADIENTS == GRADIENTS_PLANE
// Of the surface's own plane: exact, and there are no borders.
void setFootprint(ivec2 place, uint id, SeenPoint seen, float widening) {
  const vec3 ray = pixelRay(place, rayScale, sizePx);
  const vec3 stepX = vec3(2.0 * rayScale.x / float(sizePx.x), 0.0, 0.0);
  const vec3 stepY = vec3(0.0, -2.0 * rayScale.y / float(sizePx.y), 0.0);
  const float facing = dot(seen.normal, ray);
  const float least = facing < 0.0 ? min(facing, -1e-4) : max(facing, 1e-4);
  const mat3 turn = mat3(cameraToAnchor) * (widening * seen.depth);
  patternSideA = turn * (stepX - ray * (dot(seen.normal, stepX) / least));
  patternSideB = turn * (stepY - ray * (dot(seen.normal, stepY) / least));
}
#elif GRADIENTS == GRADIENTS_NEIGHBOURS
// From the next sample along an axis. BORDERS: none where that sees another material or lies at another depth, as a difference across a
// border says nothing about either surface.
vec3 sideTowards(ivec2 place, ivec2 axis, uint id, SeenPoint seen, float widening) {
  const ivec2 step = all(lessThan(place + axis, sizePx)) ? axis : -axis;
  const uint other = texelFetch(sampleIds, place + step, 0).x;
  if (other == 0xffffffffu) return vec3(0.0);
  SeenPoint next;
  surfaceSeen(place + step, other, next);
#ifdef BORDERS
  if (surfaceMaterialOf[other] != surfaceMaterialOf[id]) return vec3(0.0);
  if (max(next.depth, seen.depth) > BORDER_DEPTH_RATIO * min(next.depth, seen.depth)) return vec3(0.0);
#endif
  return mat3(cameraToAnchor) * ((next.position - seen.position) * widening);
}

void setFootprint(ivec2 place, uint id, SeenPoint seen, float widening) {
  patternSideA = sideTowards(place, ivec2(1, 0), id, seen, widening);
  patternSideB = sideTowards(place, ivec2(0, 1), id, seen, widening);
}
#endif
