// SPDX-License-Identifier: BSD-3-Clause
// Works one channel of the G-buffer out of the triangle that each pixel sees.
#include "renderer/frame/scene_buffers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform usampler2D triangleIds;
layout(binding = 0, OUT_FORMAT) uniform writeonly image2D outImage;

uniform mat4 anchorToCamera, cameraToAnchor;
uniform mat4 cameraToLight;
uniform vec2 rayScale;  // half the image's extents at distance 1
uniform ivec2 sizePx;

const uint kNone = 0xffffffffu;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
#ifdef CHANNEL_RECEIVER
  vec4 result = vec4(0.0, 0.0, 0.0, -1.0);
#else
  vec4 result = vec4(0.0);
#endif
  if (id != kNone) {
#ifdef CHANNEL_ALBEDO
    result = vec4(unpackUnorm4x8(sceneAlbedos[id]).rgb, 1.0);
#else
    const uvec3 vertices = sceneTriangle(id);
    const vec3 a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
    const vec3 b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
    const vec3 c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
    // Row 0 is the top of the image.
    const vec2 ndc = vec2(2.0, -2.0) * (vec2(pixel) + 0.5) / vec2(sizePx) + vec2(-1.0, 1.0);
    const vec3 ray = vec3(ndc * rayScale, -1.0);
    // Scaled before the product: squares of a tiny scene's areas would leave float's range.
    const vec3 e1 = b - a, e2 = c - a;
    const vec3 reach = max(abs(e1), abs(e2));
    const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
    vec3 normal = normalize(cross(e1 * unit, e2 * unit));
    // Edge-on triangles make the quotient meaningless; the surface cannot lie outside the triangle's own depths.
    const float nearest = min(-a.z, min(-b.z, -c.z)), farthest = max(-a.z, max(-b.z, -c.z));
    const float denominator = dot(normal, ray);
    float depth = dot(normal, a) / denominator;
    depth = depth > nearest ? min(depth, farthest) : nearest;  // also turns a NaN into `nearest`
    const vec3 position = ray * depth;
    if (dot(normal, position) > 0.0) normal = -normal;
#ifdef CHANNEL_POSITION
    result = vec4((cameraToAnchor * vec4(position, 1.0)).xyz, 1.0);
#endif
#ifdef CHANNEL_NORMAL
    result = vec4(mat3(cameraToAnchor) * normal, 1.0);
#endif
#ifdef CHANNEL_DEPTH
    result = vec4(depth);
#endif
#ifdef CHANNEL_RECEIVER
    const vec3 p = (cameraToLight * vec4(position, 1.0)).xyz;
    const vec3 n = mat3(cameraToLight) * normal;
    if (p.z > 0.0 && dot(n, p) < 0.0) {
      // On the plane n.q = n.p, depth as a function of u = x/z, v = y/z is z = n.p / n.(u,v,1).
      const float along = abs(dot(n, p / p.z));
      result = vec4(p, min(p.z * (abs(n.x) + abs(n.y)) / max(along, 1e-6), 1e6 * p.z));
    }
#endif
#endif
  }
  imageStore(outImage, pixel, result);
}
