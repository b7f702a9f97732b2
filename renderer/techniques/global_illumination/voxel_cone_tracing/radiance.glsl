// SPDX-License-Identifier: BSD-3-Clause
// A pyramid of what voxels send through each of their faces: radiance times opacity, and opacity. Faces: 2 * axis, + 1 on the low
// side.
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/voxels/volume.glsl"

layout(binding = kRadianceUnit) uniform sampler3D radiance[6];

uniform float coneStart, coneStep, coneWidth;  // voxels; share of a cone's width; of its distance
uniform int mostLevel;

// Radiance and opacity along a direction over a way of so many voxels' widths. An axis has the opacity of a way along it; the
// logarithms of what passes add up, each by the part of the way along its axis. Surfaces are a voxel thick, and their opacity a is
// interpolated, a (1 - |d|) at a distance of d voxels: the depth g(a) of a way that adds up to -ln(1 - a) over them, twice the integral
// of g(a x) over x from 0 to 1, is (a / (1 - a) - ln(1 - a)) / 2. With -ln(1 - a) itself walls would let a seventh through.
vec4 radianceAt(vec3 at, vec3 direction, float level, float way) {
  const vec3 place = at / vec3(gridSize());
  // What comes along a direction has left faces turned against it.
  const vec4 x = direction.x < 0.0 ? textureLod(radiance[0], place, level) : textureLod(radiance[1], place, level);
  const vec4 y = direction.y < 0.0 ? textureLod(radiance[2], place, level) : textureLod(radiance[3], place, level);
  const vec4 z = direction.z < 0.0 ? textureLod(radiance[4], place, level) : textureLod(radiance[5], place, level);
  const vec3 alpha = clamp(vec3(x.a, y.a, z.a), 0.0, 0.99), depth = 0.5 * way * abs(direction) * (alpha / (1.0 - alpha) - log(1.0 - alpha));
  const float all = depth.x + depth.y + depth.z;
  if (!(all > 1e-6)) return vec4(0.0);
  const vec3 colour = depth.x / max(x.a, 1e-6) * x.rgb + depth.y / max(y.a, 1e-6) * y.rgb + depth.z / max(z.a, 1e-6) * z.rgb;
  return vec4(colour / all, 1.0 - exp(-all));
}

// Light within a cone whose width is `widening` times the distance, at a position in voxels.
vec3 coneLight(vec3 at, vec3 direction, float widening) {
  vec3 light = vec3(0.0);
  float open = 1.0, far = 0.5;
  for (int i = 0; i < kMostConeSteps; ++i) {
    const float width = max(1.0, widening * far), level = log2(width);
    const vec3 place = at + far * direction;
    if (any(lessThan(place, vec3(0.0))) || any(greaterThan(place, vec3(gridSize())))) break;
    const vec4 part = radianceAt(place, direction, min(level, float(mostLevel)), coneStep);
    light += open * part.a * part.rgb;
    open *= 1.0 - part.a;
    if (open < 0.01) break;
    far += coneStep * width;
  }
  return light;
}

// Irradiance over pi about a normal: six cones of 60 degrees, one along it and five around (Crassin et al. 2011).
vec3 conesAbout(vec3 at, vec3 normal) {
  const vec3 side = normalize(cross(normal, abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  const vec3 other = cross(normal, side);
  const vec3 start = at + coneStart * normal;
  vec3 sum = 0.25 * coneLight(start, normal, coneWidth);
  for (int k = 0; k < 5; ++k) {
    const float angle = 1.25663706 * float(k);
    sum += 0.15 * coneLight(start, 0.5 * normal + 0.866025404 * (cos(angle) * side + sin(angle) * other), coneWidth);
  }
  return sum;
}
