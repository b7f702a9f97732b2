// SPDX-License-Identifier: BSD-3-Clause
// Colour of a curved surface, after shading.glsl. There are no shadows.

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif

// `materialNumber`: with kSurfaceDarkCheck on a dark check. `found`: normal on the viewer's side, of any length, and distance along the view.
vec3 surfaceColour(ivec2 pixel, vec4 found, uint materialNumber) {
  const vec3 position = (cameraToAnchor * vec4(pixelRay(pixel, rayScale, sizePx) * found.w, 1.0)).xyz;
  const vec3 towardsEye = eye - position;
  const vec3 view = dot(towardsEye, towardsEye) > 0.0 ? normalize(towardsEye) : vec3(0.0, 1.0, 0.0);
  vec3 normal = found.xyz;
  normal = dot(normal, normal) > 0.0 ? normalize(normal) : view;
  const SurfaceMaterial material = surfaceMaterials[materialNumber & ~kSurfaceDarkCheck];
  const float share = (materialNumber & kSurfaceDarkCheck) != 0u ? 0.4 : 1.0;
  return litColour(share * patterned(material, position), normal, towardsLight(position, normal), view, 1.0, 1.0);
}
