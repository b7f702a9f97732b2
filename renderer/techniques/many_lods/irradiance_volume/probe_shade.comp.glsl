// SPDX-License-Identifier: BSD-3-Clause
// Light of the eight probes around each pixel's point, by its place between them, on its diffuse surface.
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kProbesBuffer) readonly buffer Probes { vec4 probes[]; };
layout(binding = kGatherPositionsUnit) uniform sampler2D positions;
layout(binding = kGatherNormalsUnit) uniform sampler2D normals;
layout(binding = kGatherAlbedosUnit) uniform sampler2D albedos;
layout(binding = kProbeImage, rgba32f) uniform writeonly image2D picture;

uniform ivec2 sizePx;
uniform vec3 gridLow, gridStep;  // of the first probe, relative to the anchor; world units
uniform vec3 gridCount;
#include "renderer/techniques/many_lods/irradiance_volume/harmonics.glsl"

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 position = texelFetch(positions, pixel, 0);
  vec3 light = vec3(0.0);
  if (position.w > 0.0) {
    const vec3 normal = texelFetch(normals, pixel, 0).xyz;
    const vec3 at = clamp((position.xyz - gridLow) / gridStep, vec3(0.0), gridCount - 1.0);
    const vec3 first = min(floor(at), max(gridCount - 2.0, vec3(0.0))), part = at - first;
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const vec3 offset = vec3(corner & 1, corner >> 1 & 1, corner >> 2);
      const vec3 cell = min(first + offset, gridCount - 1.0);
      const vec3 place = mix(1.0 - part, part, offset);
      // Probes behind the surface see what it does not.
      const vec3 away = gridLow + cell * gridStep - position.xyz;
      const float facing = dot(away, away) > 0.0 ? 0.5 + 0.5 * dot(normalize(away), normal) : 0.5;
      const float weight = (place.x * place.y * place.z + 1e-4) * facing * facing;
      const int probe = int((cell.z * gridCount.y + cell.y) * gridCount.x + cell.x);
      vec3 mean = vec3(0.0);
      for (int i = 0; i < kProbeTerms; ++i)
        mean += probes[probe * kProbeTerms + i].rgb * (cosineShare(i) * harmonic(i, normal));
      sum += weight * max(mean, vec3(0.0));
      total += weight;
    }
    if (total > 0.0) light = sum / total * texelFetch(albedos, pixel, 0).rgb;
  }
  imageStore(picture, pixel, vec4(light, 1.0));
}
