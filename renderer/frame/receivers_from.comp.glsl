// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/receiver_plane.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReceiversFromReceiversUnit) uniform sampler2D receivers;
layout(binding = kReceiversFromNormalsUnit) uniform sampler2D normals;
layout(binding = kReceiversFromImage, rgba32f) uniform writeonly image2D outReceivers;
layout(binding = kReceiversFromPlanesImage, rg32f) uniform writeonly image2D outPlanes;

uniform ivec2 sizePx;
uniform mat3 anchorToLight;  // directions
uniform vec2 eye;            // on the light's plane

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  vec4 receiver = texelFetch(receivers, pixel, 0);
  vec2 plane = vec2(0.0);
  if (receiver.w >= 0.0) {
    const vec3 n = anchorToLight * texelFetch(normals, pixel, 0).xyz;
    const vec3 p = receiver.xyz - vec3(eye, 0.0);
    // As in g_buffer.comp.glsl: on the plane n.q = n.p depth is n.p / n.(u, v, 1).
    const float along = -dot(n, p / p.z);
    const float slope = along > 0.0 ? p.z * (abs(n.x) + abs(n.y)) / max(along, 1e-6) : 0.0;
    receiver = vec4(p, along > 0.0 ? min(slope, 1e6 * p.z) : 2e6 * p.z);
    plane = planeGradientFromEitherSide(p, n);
  }
  imageStore(outReceivers, pixel, receiver);
  imageStore(outPlanes, pixel, vec4(plane, 0.0, 0.0));
}
