// SPDX-License-Identifier: BSD-3-Clause
// Hard shadow of one point of the light: counts the pixels' lit samples.
#include "renderer/references/reference_bindings.h"
#ifdef BIAS_PLANE
#include "renderer/frame/receiver_plane.glsl"
#endif

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampledLightReceiversUnit) uniform sampler2D receivers;
layout(binding = kSampledLightNormalsUnit) uniform sampler2D normals;
layout(binding = kSampledLightDepthMapUnit) uniform sampler2D depthMap;
layout(binding = kSampledLightLitCountsImage, r32ui) uniform uimage2D litCounts;

uniform ivec2 sizePx;
uniform mat3 anchorToLight;  // directions
uniform vec2 offset;         // the sample, on the light's plane
uniform vec2 low, extent;    // of the map, in tangents
uniform float near;
uniform int resolution;
uniform float bias;       // share of the depth
uniform float slopeBias;  // texels

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 receiver = texelFetch(receivers, pixel, 0);
  if (receiver.w < 0.0) return;
  const vec3 p = receiver.xyz - vec3(offset, 0.0);
  const vec3 n = anchorToLight * texelFetch(normals, pixel, 0).xyz;
  const vec3 ray = p / p.z;  // depth 1
  const float along = -dot(n, ray);
  if (along <= 0.0) return;  // the sample is behind the surface
  bool lit = true;
  const vec2 u = (ray.xy - low) / extent;
  if (all(greaterThanEqual(u, vec2(0.0))) && all(lessThan(u, vec2(1.0)))) {
    const ivec2 texel = ivec2(u * float(resolution));
    const float depth = texelFetch(depthMap, texel, 0).x;
    const vec2 perTexel = extent / float(resolution);
    // Change of depth over a texel on each axis, of the plane through p.
    const float slope = p.z * dot(abs(n.xy), perTexel) / along;
#ifdef BIAS_PLANE
    // The plane's depth at the texel's centre is p.z / planeFactor.
    const float planeFactor = 1.0 + dot(planeGradient(p, n), low + (vec2(texel) + 0.5) * perTexel - ray.xy);
    lit = depth <= 0.0 || p.z <= near / depth * planeFactor + bias * p.z + slopeBias * slope;
#else
    lit = depth <= 0.0 || p.z <= near / depth + bias * p.z + slopeBias * slope;
#endif
  }
  if (lit) imageStore(litCounts, pixel, imageLoad(litCounts, pixel) + uvec4(1));
}
