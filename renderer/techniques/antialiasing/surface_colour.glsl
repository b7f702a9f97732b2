// SPDX-License-Identifier: BSD-3-Clause
// Colour of a surface point under the settings of SampleShading: what all techniques of the family and their reference
// shade with. The including shader declares `sizePx` before, and its program is set up by configureSampleShading().
#include "renderer/frame/shading.glsl"
#ifdef SHADOW
#include "renderer/frame/hard_shadow.glsl"
#include "renderer/frame/receiver.glsl"
#endif

uniform vec3 lightExtentX, lightExtentY;  // sides of the light's rectangle

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) {
#ifdef SHADOW
  vec2 plane;
  return hardShadow(receiverAt(seen.position, seen.normal, plane));
#else
  return 1.0;
#endif
}
#endif

// Mean over points of the light's rectangle, whose first is the centre: the cost of a shader, in light samples.
vec3 manyLightsColour(SurfacePoint point, float sun) {
  const vec3 albedo = patterned(surfaceMaterials[surfaceMaterialOf[point.triangle]], point.position);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < LIGHT_SAMPLES; ++i) {
    // A rank-1 lattice by the plastic number, which covers the square evenly for any number of points.
    const vec2 at = fract(0.5 + float(i) * vec2(0.75487767, 0.56984029)) - 0.5;
    const vec3 away = lightPosition + at.x * lightExtentX + at.y * lightExtentY - point.position;
    const vec3 toLight = dot(away, away) > 0.0 ? normalize(away) : point.normal;
    sum += litColour(albedo, point.normal, toLight, point.view, 1.0, sun);
  }
  return sum / float(LIGHT_SAMPLES);
}

// `seen`: the same point in camera space.
vec3 surfaceColour(SurfacePoint point, SeenPoint seen) {
  float sun = 1.0;
  const bool aperture = surfaceMaterials[surfaceMaterialOf[point.triangle]].surface == kSurfaceAperture;
#ifdef LIT
  if (!aperture) sun = sunShare(ivec2(0), seen);
#if LIGHT_SAMPLES > 1
  if (!aperture) return manyLightsColour(point, sun);
#endif
#endif
  return pointColour(point, sun);
}
