// SPDX-License-Identifier: BSD-3-Clause
// Main step in the tessellation stages. Quads are divided where tables have rows; of triangles only the sides are, and
// inner vertices lie on the triangle of three of the tables' vertices: on the mesh of the tables' level, not on the limit surface.
#include "renderer/techniques/subdivision/tables.glsl"

#if CORNERS == 3
layout(triangles, equal_spacing, ccw) in;
#else
layout(quads, equal_spacing, ccw) in;
#endif
patch in uint patchNumber;
uniform mat4 anchorToClip;
out vec3 normal;
out float distance_;
flat out uint material;
#ifdef TEXTURED
out vec2 texturePlace;
#endif

void addPoint(ivec2 place, float weight, inout vec3 position, inout vec3 sum) {
  const uvec2 source = sourceOf(patchNumber, place);
  position += weight * tablePosition(source.x, source.y);
  sum += weight * tableNormal(patchNumber, rowOfPlace(place));
#ifdef TEXTURED
  texturePlace += weight * tableTexture(patchNumber, rowOfPlace(place));
#endif
}

void main() {
  const float n = float(TABLE_SEGMENTS);
#if CORNERS == 3
  // Weights of corners 1 and 2; the driver's first coordinate is corner 0.
  const vec2 at = n * gl_TessCoord.yz;
#else
  const vec2 at = n * gl_TessCoord.xy;
#endif
  ivec2 place = ivec2(round(at));
  vec3 position = vec3(0.0), sum = vec3(0.0);
#ifdef TEXTURED
  texturePlace = vec2(0.0);
#endif
  if (all(lessThan(abs(at - vec2(place)), vec2(1e-3)))) {
    const uvec2 source = sourceOf(patchNumber, place);
    position = tablePosition(source.x, source.y);
    sum = tableNormal(patchNumber, rowOfPlace(place));
#ifdef TEXTURED
    texturePlace = tableTexture(patchNumber, rowOfPlace(place));
#endif
  } else {
    place = ivec2(floor(at));
    vec2 inside = at - vec2(place);
    const bool upper = inside.x + inside.y > 1.0;
    if (upper) inside = 1.0 - inside;
    addPoint(place + (upper ? ivec2(1) : ivec2(0)), 1.0 - inside.x - inside.y, position, sum);
    addPoint(place + (upper ? ivec2(0, 1) : ivec2(1, 0)), inside.x, position, sum);
    addPoint(place + (upper ? ivec2(1, 0) : ivec2(0, 1)), inside.y, position, sum);
  }
  precise const vec4 clip = anchorToClip * vec4(position, 1.0);
  gl_Position = clip;
  normal = unitOr(sum, vec3(0.0, 0.0, 1.0));
  distance_ = clip.w;
  material = patches[patchNumber].material;
}
