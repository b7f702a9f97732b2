// SPDX-License-Identifier: BSD-3-Clause
// Where a pixel was in the previous frame, and the four texels around that place.
struct Corners {
  ivec2 first;
  vec2 weight;  // of the texels right and below
};

// In pixels; (0.5, 0.5) is the first pixel's centre. A displacement that is not finite counts as none.
vec2 previousPlace(ivec2 pixel, vec2 displacement) {
  for (int c = 0; c < 2; ++c)
    if (isnan(displacement[c]) || isinf(displacement[c])) displacement[c] = 0.0;
  return vec2(pixel) + 0.5 - displacement;
}

bool isInside(vec2 place, ivec2 size) {
  return all(greaterThanEqual(place, vec2(0.0))) && all(lessThanEqual(place, vec2(size)));
}

Corners cornersAround(vec2 place) {
  vec2 first = floor(place - 0.5);
  return Corners(ivec2(first), place - 0.5 - first);
}

// Texel `corner` of 4, clamped to the image, and its weight.
ivec2 cornerTexel(Corners corners, int corner, ivec2 size) {
  return clamp(corners.first + ivec2(corner & 1, corner >> 1), ivec2(0), size - 1);
}
float cornerWeight(Corners corners, int corner) {
  return ((corner & 1) == 0 ? 1.0 - corners.weight.x : corners.weight.x) *
         ((corner >> 1) == 0 ? 1.0 - corners.weight.y : corners.weight.y);
}
