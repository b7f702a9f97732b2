// SPDX-License-Identifier: BSD-3-Clause
// What an overlap contributes to a cone's light, and how much of that nothing nearer hides.

#ifdef TABLE
// Contribution by share of the cone and distance from its axis, for cones of which the mirror's own reflection is a share from 0
// to 1: the layers (Roger 2008, section 5.2.3).
layout(binding = kConeTableUnit) uniform sampler2DArray contributions;
uniform float tableSide, tableLayers;
#endif

// `wide`: share of the cone's angle that is the pixel's own.
float contribution(Beam beam, BeamShare found, float wide) {
#ifdef TABLE
  const vec2 at = (vec2(found.share, min(length(found.middle), 1.0)) * (tableSide - 1.0) + 0.5) / tableSide;
  const float layer = clamp(wide, 0.0, 1.0) * (tableLayers - 1.0), low = floor(layer);
  return mix(texture(contributions, vec3(at, low)).x, texture(contributions, vec3(at, low + 1.0)).x, layer - low);
#else
  return found.share;
#endif
}

#ifdef MASKED
layout(binding = kConeMaskUnit) uniform sampler2D maskPoints;  // of equal shares of the disk
uvec2 maskCovered = uvec2(0u);

// Points of the mask in the polygon of the last overlap.
uvec2 maskOfPolygon() {
  // Signed distances from the edges, on the inner side by the polygon's turn; 0 where there are fewer edges.
  vec3 sides[OVERLAP_CORNERS];
  float turn = 0.0;
  for (int i = 0; i < OVERLAP_CORNERS; ++i) {
    const vec2 p = beamPolygon[i], q = beamPolygon[i + 1 < beamCorners ? i + 1 : 0], edge = q - p;
    sides[i] = i < beamCorners ? vec3(-edge.y, edge.x, -cross2(edge, p)) : vec3(0.0);
    turn += i < beamCorners ? cross2(p, q) : 0.0;
  }
  uvec2 mask = uvec2(0u);
  for (int k = 0; k < kConeMaskPoints; ++k) {
    const vec3 at = vec3(texelFetch(maskPoints, ivec2(k, 0), 0).xy, 1.0) * (turn < 0.0 ? -1.0 : 1.0);
    const float least = min(min(dot(sides[0], at), dot(sides[1], at)),
                            min(dot(sides[2], at), min(dot(sides[3], at), dot(sides[4], at))));
    if (least >= 0.0) mask[k >> 5] |= 1u << (k & 31);
  }
  return mask;
}

float unhidden(float share, float covered) {
  const uvec2 mask = maskOfPolygon(), seen = mask & ~maskCovered;
  maskCovered |= mask;
  const int all = bitCount(mask.x) + bitCount(mask.y);
  // Between all points: as without a mask.
  const float part = all > 0 ? float(bitCount(seen.x) + bitCount(seen.y)) / float(all) : 1.0;
  return min(share * part, max(1.0 - covered, 0.0));
}
#else
// As GL_SRC_ALPHA_SATURATE: exact for triangles side by side.
float unhidden(float share, float covered) { return min(share, max(1.0 - covered, 0.0)); }
#endif
