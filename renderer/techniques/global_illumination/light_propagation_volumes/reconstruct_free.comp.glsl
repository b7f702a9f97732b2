// SPDX-License-Identifier: BSD-3-Clause
// Indirect light of each pixel's point from the light that has passed the voxels around it.
#include "renderer/techniques/global_illumination/indirect_picture.glsl"
#include "renderer/voxels/volume.glsl"

layout(binding = kReconstructArrivedUnit) uniform sampler2DArray light;
uniform float shift;

// Irradiance over pi, from the sum of all flux that has entered a voxel. By intensity, as published: (flux + 3 vector) / 4 pi against
// the normal, over the square of half a voxel: 3 / pi of the flux of a clamped cosine along the normal, and 6 / pi = 1.9 times the
// irradiance of a field that is equal to all sides, whose flux through six faces a voxel adds up. By cosines: what comes along the
// normal counts as its flux over a face, but light of all sides 2.6 times, so that scattered light is far too bright.
float against(float flux, float along) {
#if LOOKUP == LOOKUP_INTENSITY
  return (flux + 3.0 * along) / 3.14159265;
#else
  return (0.25 * flux + 0.5 * along) * (12.0 / 7.0);
#endif
}

vec3 passingLight(SurfacePoint point) {
  const vec3 at = clamp(toVoxels(point.position) + shift * point.flatNormal - 0.5, vec3(0.0), vec3(gridSize() - 1));
  const ivec3 low = ivec3(floor(at));
  const vec3 part = at - vec3(low);
  vec3 sum = vec3(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 upper = ivec3(corner & 1, corner >> 1 & 1, corner >> 2), voxel = low + upper;
    if (!isInGrid(voxel)) continue;
    const vec3 axes = mix(1.0 - part, part, vec3(upper));
    const float weight = axes.x * axes.y * axes.z;
    for (int channel = 0; channel < 3; ++channel) {
      const vec4 one = texelFetch(light, voxel + ivec3(0, 0, channel * gridSizeZ), 0);
      sum[channel] += weight * against(one.x, -dot(one.yzw, point.flatNormal));
    }
  }
  return max(sum, 0.0) / 3.14159265;
}

vec3 indirectLight(SurfacePoint point, vec3 albedo) { return albedo * passingLight(point); }
