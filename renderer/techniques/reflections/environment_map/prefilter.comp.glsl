// SPDX-License-Identifier: BSD-3-Clause
// A map filtered by a power of the cosine with each direction, over all of the map (Roger 2008, section 1.3.2.3): the mean,
// not the integral, so that a constant map stays as it is. Texels of one level of the source, each by its solid angle.
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/environment_map/cube_faces.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kEnvironmentFacesUnit) uniform sampler2DArray source;
layout(binding = kReflectionImage, rgba32f) uniform writeonly image2DArray filtered;
uniform int face, sourceLevel, sourceResolution, resolution;
uniform float exponent;

void main() {
  const ivec3 texel = ivec3(gl_GlobalInvocationID.xy, face);
  if (any(greaterThanEqual(texel.xy, ivec2(resolution)))) return;
  const vec3 axis = normalize(cubeDirection(texel.z, vec2(texel.xy) + 0.5, resolution));
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int other = 0; other < 6; ++other)
    for (int i = 0; i < sourceResolution * sourceResolution; ++i) {
      const ivec2 at = ivec2(i % sourceResolution, i / sourceResolution);
      const float cosine = dot(axis, normalize(cubeDirection(other, vec2(at) + 0.5, sourceResolution)));
      if (!(cosine > 0.0)) continue;
      const float weight = pow(cosine, exponent) * cubeSolidAngle(at, sourceResolution);
      sum += weight * texelFetch(source, ivec3(at, other), sourceLevel).rgb;
      total += weight;
    }
  imageStore(filtered, texel, vec4(total > 0.0 ? sum / total : vec3(0.0), 0.0));
}
