// SPDX-License-Identifier: BSD-3-Clause
// Displacement of each pixel's surface point since the previous frame. See motion.h.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kMotionIdsUnit) uniform usampler2D triangleIds;
layout(binding = kMotionDisplacementImage, rg32f) uniform writeonly image2D outDisplacement;
layout(binding = kMotionPreviousDepthImage, r32f) uniform writeonly image2D outPreviousDepth;

uniform mat4 anchorToCamera;
uniform mat4 nowToThen;  // camera space now to camera space then
#ifdef MOVING
layout(std430, binding = kMotionOfVerticesBuffer) readonly buffer MotionOf { uint motionOf[]; };
uniform mat4 partNowToThen[kMostMotions];  // the same of points of moving parts
#endif
uniform vec2 rayScale, rayScaleThen;
uniform ivec2 sizePx;

const uint kNone = 0xffffffffu;
// Smallest cosine to the previous view that still gives a position on the picture's plane.
const float kBeside = 1e-4;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  const vec3 ray = pixelRay(pixel, rayScale, sizePx);
  float depth = 0.0, inverse = 0.0;
  mat4 toThen = nowToThen;
  if (id != kNone) {
    const uvec3 vertices = sceneTriangle(id);
    depth = pointSeen((anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz,
                      (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz,
                      (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz, ray)
                .depth;
    // A point at the eye itself has no direction; it counts as very near.
    inverse = min(1.0 / max(depth, 0.0), 1e30);
#ifdef MOVING
    const uint motion = motionOf[vertices.x];
    if (motion > 0u) toThen = partNowToThen[motion - 1u];
#endif
  }
  // The point over its depth, so that a point at infinity is no special case and a camera at rest gives
  // exactly 0.
  precise const vec3 then = mat3(toThen) * ray + toThen[3].xyz * inverse;
  const vec2 half_ = 0.5 * vec2(sizePx);
  // Both places by the same steps, none of them fused with another, so that they are equal where nothing
  // moves.
  precise const vec2 nowTangent = ray.xy / -ray.z, thenTangent = then.xy / -then.z;
  precise const vec2 nowNdc = nowTangent / rayScale, thenNdc = thenTangent / rayScaleThen;
  precise vec2 displacement;
  float previousDepth;
  const float reach = max(abs(then.x), max(abs(then.y), abs(then.z)));
  if (then.z < -kBeside * reach) {
    displacement = (nowNdc - thenNdc) * half_;
    previousDepth = -then.z * depth;
  } else {
    const vec2 outwards = nowNdc * half_;
    const float far = length(outwards);
    displacement = 2.0 * length(half_) * (far > 0.0 ? outwards / far : vec2(1.0, 0.0));
    previousDepth = -1.0;
  }
  imageStore(outDisplacement, pixel, vec4(displacement.x, -displacement.y, 0.0, 0.0));
  imageStore(outPreviousDepth, pixel, vec4(previousDepth));
}
