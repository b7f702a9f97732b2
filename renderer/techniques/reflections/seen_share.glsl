// SPDX-License-Identifier: BSD-3-Clause
// Share of the light along a pixel's first ray that the surface it sees passes on. `cosine`: w of MirrorRays' directions.
#include "renderer/frame/mirrored.glsl"
#include "renderer/frame/surface_buffers.glsl"

vec3 firstShare(SurfaceMaterial material, float cosine) {
#ifdef REFRACT
  if (material.transmittance != vec3(0.0)) return cosine == kTotalReflectionCosine ? vec3(1.0) : material.transmittance;
#endif
  return mirrorShare(material.mirror, material.fresnel != 0u, cosine);
}
