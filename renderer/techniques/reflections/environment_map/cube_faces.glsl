// SPDX-License-Identifier: BSD-3-Clause
// Texels of a cube map, in OpenGL's order and orientation. See cube_map.h.

// Towards place `at` of a face, in texels from its top left corner; of length 1 to sqrt(3).
vec3 cubeDirection(int face, vec2 at, int resolution) {
  const vec2 p = 2.0 * at / float(resolution) - 1.0;
  if (face == 0) return vec3(1.0, -p.y, -p.x);
  if (face == 1) return vec3(-1.0, -p.y, p.x);
  if (face == 2) return vec3(p.x, 1.0, p.y);
  if (face == 3) return vec3(p.x, -1.0, -p.y);
  if (face == 4) return vec3(p.x, -p.y, 1.0);
  return vec3(-p.x, -p.y, -1.0);
}

// False for what leads nowhere.
bool isDirection(vec3 d) { return !any(isnan(d)) && !any(isinf(d)) && d != vec3(0.0); }

// Texel and face in a direction.
ivec3 cubeTexel(vec3 d, int resolution) {
  const vec3 size = abs(d);
  int face;
  vec3 of;  // s, t and the face's axis
  if (size.x >= size.y && size.x >= size.z) {
    face = d.x > 0.0 ? 0 : 1;
    of = vec3(d.x > 0.0 ? -d.z : d.z, -d.y, size.x);
  } else if (size.y >= size.z) {
    face = d.y > 0.0 ? 2 : 3;
    of = vec3(d.x, d.y > 0.0 ? d.z : -d.z, size.y);
  } else {
    face = d.z > 0.0 ? 4 : 5;
    of = vec3(d.z > 0.0 ? d.x : -d.x, -d.y, size.z);
  }
  const vec2 at = (0.5 * of.xy / of.z + 0.5) * float(resolution);
  return ivec3(clamp(ivec2(floor(at)), ivec2(0), ivec2(resolution - 1)), face);
}

// Solid angle of a texel, by the area of its face's part over the cube of its distance.
float cubeSolidAngle(ivec2 texel, int resolution) {
  const vec2 p = (2.0 * vec2(texel) + 1.0) / float(resolution) - 1.0;
  const float side = 2.0 / float(resolution), square = 1.0 + dot(p, p);
  return side * side / (square * sqrt(square));
}
