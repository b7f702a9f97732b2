// SPDX-License-Identifier: BSD-3-Clause
// Depth images as configureViews() binds them, VIEWS in number. View space: world units, z along the view, x to the right and y
// down in the image. A depth is near / z, reversed, without a far plane, so that its precision is the same at any distance; 0:
// nothing is seen.
#include "renderer/incremental_voxels/incremental_bindings.h"
#include "renderer/voxels/volume.glsl"

layout(binding = kViewDepthsUnit) uniform sampler2D viewDepths[VIEWS];
layout(binding = kViewTrianglesUnit) uniform usampler2D viewTriangles[VIEWS];
uniform mat4 viewFromVoxels[VIEWS], voxelsFromView[VIEWS];
uniform vec2 viewLow[VIEWS], viewExtent[VIEWS];  // tangents
uniform ivec2 viewSizePx[VIEWS];
uniform float viewNear[VIEWS];

vec3 toView(int view, vec3 voxels) { return (viewFromVoxels[view] * vec4(voxels, 1.0)).xyz; }

// Place in a view's image, in pixels, of a point in view space before the near plane.
vec2 viewPlace(int view, vec3 point) {
  return (point.xy / point.z - viewLow[view]) / viewExtent[view] * vec2(viewSizePx[view]);
}

bool isInView(int view, vec2 place) {
  return all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(viewSizePx[view])));
}

// Through a pixel's centre, with z = 1.
vec3 viewRay(int view, ivec2 pixel) {
  return vec3(viewLow[view] + viewExtent[view] * (vec2(pixel) + 0.5) / vec2(viewSizePx[view]), 1.0);
}

// Samplers are named by constants: after a fetch from an array of them by a variable index, other fetches of the same constant
// level read 0 on Mesa 22.3's llvmpipe.
float depthAt(int view, ivec2 pixel) {
#if VIEWS > 1
  if (view == 1) return texelFetch(viewDepths[1], pixel, 0).x;
#endif
  return texelFetch(viewDepths[0], pixel, 0).x;
}

uint triangleAt(int view, ivec2 pixel) {
#if VIEWS > 1
  if (view == 1) return texelFetch(viewTriangles[1], pixel, 0).x;
#endif
  return texelFetch(viewTriangles[0], pixel, 0).x;
}
