// SPDX-License-Identifier: BSD-3-Clause
// Light of the lamp where it arrives first: rays evenly over the sphere around it, each of which stands for the surface that it
// meets, added to the voxel in front as a cosine lobe.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kReflectiveRayGroup) in;
// As in voxel_propagation/inject.comp.glsl.
layout(binding = kInjectSumsImage, r32ui) uniform uimage2DArray sums;

uniform ivec2 sizePx;
uniform int rayCount;
uniform float shift;  // in voxels
#include "renderer/techniques/global_illumination/surface_light.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/light_lobes.glsl"
#include "renderer/voxels/volume.glsl"

void main() {
#ifdef LIT
  const int number = int(gl_GlobalInvocationID.x);
  if (number >= rayCount) return;
  // Fibonacci's lattice on the sphere; the golden ratio's turn in two parts, as floats hold no large angles.
  const float height = 1.0 - 2.0 * (float(number) + 0.5) / float(rayCount);
  const float turn = fract(float(number) * 0.61803399), angle = 6.28318531 * turn, radius = sqrt(1.0 - height * height);
  const vec3 direction = vec3(radius * cos(angle), height, radius * sin(angle));
  const Ray ray = Ray(lightPosition, direction, 0.0, kRayFarthest, kRayNoTriangle);
  const RayHit hit = rayClosestHit(ray);
  if (hit.triangle == kRayNoTriangle) return;
  const SurfacePoint point = hitPoint(ray, hit);
  const ivec3 voxel = ivec3(floor(toVoxels(point.position) + shift * point.flatNormal));
  if (!isInGrid(voxel)) return;
  const float steps = hit.t / voxelSize;
  // The ray's part of the sphere is cosine / steps^2 of the surface, whose radiance is reflectance * strength * cosine.
  const float flux = 3.14159265 * diffuse * steps * steps * 12.5663706 / float(rayCount);
  const vec3 colour = reflectance(point);
  const vec4 lobe = flux * cosineLobe(point.flatNormal);
  for (int channel = 0; channel < 3; ++channel)
    for (int c = 0; c < 4; ++c)
      imageAtomicAdd(sums, ivec3(voxel.xy, (4 * channel + c) * gridSizeZ + voxel.z),
                     uint(int(round(kInjectFixed * colour[channel] * lobe[c]))));
#endif
}
