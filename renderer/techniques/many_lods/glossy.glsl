// SPDX-License-Identifier: BSD-3-Clause
// How receivers reflect. See receiver_surface.h.
uniform float glossShare, glossExponent;

// Reflectance times the cosine of unit `towards` to `normal`, for light from there that goes on to unit `view`.
vec3 reflectedShare(vec3 albedo, vec3 normal, vec3 view, vec3 towards) {
  const float cosine = dot(normal, towards);
  if (!(cosine > 0.0)) return vec3(0.0);
  vec3 share = (1.0 - glossShare) * 0.31830989 * albedo;
  if (glossShare > 0.0) {
    const float along = max(dot(2.0 * dot(normal, view) * normal - view, towards), 0.0);
    share += glossShare * (glossExponent + 2.0) * 0.15915494 * pow(along, glossExponent);
  }
  return cosine * share;
}
