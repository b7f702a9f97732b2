// SPDX-License-Identifier: BSD-3-Clause
// Mean visibility over a pixel's rays, traced against the objects' triangles.
#include "renderer/ray_tracing/trace.glsl"
#include "renderer/techniques/visibility_fields/occlusion_rays.glsl"

layout(binding = kFieldOutImage, rgba32f) uniform image2D outImage;
uniform int firstRow, lastRow;  // of the rays' cells

uint ownObject;

bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) {
  return selfOcclusion != 0 || objectOf[hit.triangle] != ownObject;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  OcclusionPoint point;
  if (!occlusionPoint(pixel, point)) {
    imageStore(outImage, pixel, vec4(1.0));
    return;
  }
  ownObject = point.object;
  float open = firstRow == 0 ? 0.0 : imageLoad(outImage, pixel).x;
  for (int y = firstRow; y <= lastRow; ++y)
    for (int x = 0; x < raySide; ++x) {
      ++rayIterations;
      Ray ray = Ray(point.origin, occlusionDirection(point, ivec2(x, y)), 0.0, kRayFarthest, point.triangle);
      if (falloff == kFalloffBinary) {
        ray.far = falloffRadius;
        open += rayAnyHit(ray) ? 0.0 : 1.0;
      } else {
        const RayHit hit = rayClosestHit(ray);
        open += hit.triangle == kRayNoTriangle ? 1.0 : visibilityAt(hit.t);
      }
    }
  if (lastRow == raySide - 1) open /= float(raySide * raySide);
  imageStore(outImage, pixel, rayCutShort ? vec4(uintBitsToFloat(0x7fc00000u)) : vec4(vec3(open), 1.0));
}
