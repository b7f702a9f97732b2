// SPDX-License-Identifier: BSD-3-Clause
// What views_mean.comp.glsl shows, by a ray for each pixel and view.
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
uniform ivec2 sizePx;
#include "renderer/frame/mirror_trace.glsl"

layout(binding = kCameraViewsUnit) uniform sampler2D viewRows;  // eye, axes of each view; w of the first two: shift
layout(binding = kPointsImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 tilePx;
uniform int viewCount;
uniform vec2 tangents;
uniform vec3 backdrop;

vec3 seen(int view, vec2 at) {
  const vec4 eye = texelFetch(viewRows, ivec2(0, view), 0), x = texelFetch(viewRows, ivec2(1, view), 0),
             y = texelFetch(viewRows, ivec2(2, view), 0), z = texelFetch(viewRows, ivec2(3, view), 0);
  const vec2 tangent = (2.0 * at / vec2(tilePx) - 1.0) * tangents + vec2(eye.w, x.w);
  const Ray ray = Ray(eye.xyz, normalize(z.xyz + tangent.x * x.xyz + tangent.y * y.xyz), 0.0, kRayFarthest, kRayNoTriangle);
  const RayHit hit = rayClosestHit(ray);
  return hit.triangle == kRayNoTriangle ? backdrop : hitColour(hitPoint(ray, hit), false);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
#ifdef SIDE_BY_SIDE
  const int view = min(pixel.x / tilePx.x, 1);
  vec3 colour = seen(view, vec2(min(pixel.x - view * tilePx.x, tilePx.x - 1), pixel.y) + 0.5);
#else
  vec3 colour = vec3(0.0);
  for (int view = 0; view < viewCount; ++view) colour += seen(view, vec2(pixel + (tilePx - sizePx) / 2) + 0.5);
  colour /= float(viewCount);
#endif
  if (rayCutShort) colour = vec3(uintBitsToFloat(0x7fc00000u));
  imageStore(picture, pixel, vec4(colour, 1.0));
}
