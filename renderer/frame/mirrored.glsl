// SPDX-License-Identifier: BSD-3-Clause
// Direction in which a mirror sends what comes from `view` (towards the viewer): unit vectors, normals on the viewer's
// side. See mirror_rays.h.
vec3 mirrored(vec3 view, vec3 normal, vec3 flatNormal) {
  const vec3 direction = 2.0 * dot(normal, view) * normal - view;
  if (dot(direction, flatNormal) > 0.0) return normalize(direction);
  return normalize(2.0 * dot(flatNormal, view) * flatNormal - view);
}

// Share that a mirror reflects of light that makes an angle with its normal whose cosine is given: Schlick's rule where
// the material asks for it.
vec3 mirrorShare(vec3 atNormal, bool fresnel, float cosine) {
  if (!fresnel) return atNormal;
  const float rest = clamp(1.0 - cosine, 0.0, 1.0), squared = rest * rest;
  return atNormal + (1.0 - atNormal) * (squared * squared * rest);
}
