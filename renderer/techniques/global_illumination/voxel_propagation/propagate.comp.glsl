// SPDX-License-Identifier: BSD-3-Clause
// A step: what each voxel's neighbours send it. Light goes on in empty voxels; what goes from an empty voxel to an occupied one is
// partly let through, and partly comes back at once, so that opaque voxels hold no light and cannot pass it on.
#include "renderer/techniques/global_illumination/voxel_propagation/light_bounds.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/transport.glsl"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kPropagateFieldUnit) uniform sampler2DArray field;
layout(binding = kPropagateSourceUnit) uniform sampler2DArray source;
layout(binding = kPropagateOutImage, FIELD_FORMAT) uniform writeonly image2DArray next;
uniform bool lasting;  // sources
#ifdef STOPS
layout(std430, binding = kPropagateChangesBuffer) buffer Changes { uint changes[]; };  // bits of floats, a step each
uniform int step_;
uniform float stopBelow;
#endif

vec4 reflected(vec4 arriving, vec3 direction, vec3 normal) {
  const vec4 mirroredAtFace = vec4(arriving.x, arriving.yzw - 2.0 * dot(arriving.yzw, direction) * direction);
#if REFLECTION == REFLECTION_AXIS
  return mirroredAtFace;
#else
  // The mean normal tells nothing of thin walls, whose sides cancel, and of a face that it is turned along.
  const float reach = length(normal), along = dot(normal, direction);
  const bool known = reach > 0.3 && abs(along) > 0.2 * reach;
  const vec3 n = known ? normal / (along > 0.0 ? -reach : reach) : -direction;
#if REFLECTION == REFLECTION_NORMAL
  vec3 back = arriving.yzw - 2.0 * dot(arriving.yzw, n) * n;
  return vec4(arriving.x, back);
#else
  return arriving.x * cosineLobe(n);
#endif
#endif
}

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: channel and layer
  if (any(greaterThanEqual(at, ivec3(gridSize().xy, 3 * gridSizeZ)))) return;
#ifdef STOPS
  if (step_ > 0 && uintBitsToFloat(changes[step_ - 1]) <= stopBelow) return;
#endif
  const int channel = at.z / gridSizeZ;
  const ivec3 voxel = ivec3(at.xy, at.z - channel * gridSizeZ), toLayer = ivec3(0, 0, channel * gridSizeZ);
  const bool solid = isOccupied(voxel);
  if (!solid && !isOpen(voxel)) {
    imageStore(next, at, vec4(0.0));
    return;
  }
  const vec4 own = texelFetch(field, at, 0);
  const float passing = solid ? 1.0 - texelFetch(volumeNormal, voxel, 0).w : 1.0;
  vec4 sum = lasting ? texelFetch(source, at, 0) : vec4(0.0);
  if (passing > 0.0)
    for (int face = 0; face < 6; ++face) {
      const ivec3 direction = ivec3(faceDirection(face)), from = voxel - direction;
      if (!isInGrid(from)) continue;
      if (!isOccupied(from)) {
        sum += passing * leaving(texelFetch(field, from + toLayer, 0), face);
        continue;
      }
      const vec4 surface = texelFetch(volumeNormal, from, 0);
      // What has entered a transparent surface is not held up within it.
      if (surface.w < 1.0) sum += leaving(texelFetch(field, from + toLayer, 0), face);
      if (solid || surface.w == 0.0) continue;
#if ALBEDO == ALBEDO_STORED
      const float albedo = texelFetch(volumeAlbedo, from, 0)[channel];
#else
      const float albedo = 0.5;
#endif
      const vec4 away = leaving(own, face ^ 1);
      if (away.x > 0.0) sum += albedo * reflected(away, -vec3(direction), surface.xyz);
    }
  imageStore(next, at, sum);
#ifdef STOPS
  atomicMax(changes[step_], floatBitsToUint(abs(sum.x - own.x)));
#endif
}
