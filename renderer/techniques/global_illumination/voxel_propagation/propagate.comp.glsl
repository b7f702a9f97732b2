// SPDX-License-Identifier: BSD-3-Clause
// A step: what each voxel's neighbours send it. Light goes on in empty voxels; what goes from an empty voxel to an occupied one is
// partly let through, and partly comes back at once, so that opaque voxels hold no light and cannot pass it on.
//
// A step lasts as long as its chain of dependent fetches: the voxel's word and all lights first, then all shares of these.
#include "renderer/techniques/global_illumination/voxel_propagation/light_cells.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/transport.glsl"
#include "renderer/voxels/volume.glsl"

#if STEPS_TOGETHER > 1
const int kSide = kPropagateGroup + 2 * STEPS_TOGETHER;  // of a group: its voxels and those around that they depend on
#else
const int kSide = kPropagateGroup;
#endif
layout(local_size_x = kSide, local_size_y = kSide, local_size_z = kSide) in;
// Two fields, of which a step reads one and writes the other. Layer: (field * 3 + channel) * depth + z.
layout(binding = kPropagateFieldUnit) uniform sampler2DArray fields;
layout(binding = kPropagateOutImage, FIELD_FORMAT) uniform writeonly image2DArray next;
layout(binding = kPropagateSourceUnit) uniform sampler2DArray source;
uniform int from;      // the field to read
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

// As the field's texels keep it. Rounded to the nearest half here: where a driver's texels are cut off instead, light would be lost
// at each step.
#ifdef FIELD_HALF
#define LightKept uvec2
uvec2 keptOf(vec4 light) {
  light = clamp(light, -65504.0, 65504.0);  // rules that create energy would leave the range of halves
  return uvec2(packHalf2x16(light.xy), packHalf2x16(light.zw));
}
vec4 lightKept(uvec2 light) { return vec4(unpackHalf2x16(light.x), unpackHalf2x16(light.y)); }
#else
#define LightKept vec4
vec4 keptOf(vec4 light) { return light; }
vec4 lightKept(vec4 light) { return light; }
#endif

// A voxel's light after a step. `beside`: lights from the side of each face; `lit`: its source.
vec4 afterStep(ivec3 voxel, int channel, uint cell, vec4 own, vec4 beside[6], vec4 lit) {
  const bool solid = holdsSurface(cell);
  vec4 moved[6];
  for (int face = 0; face < 6; ++face) {
    const bool back = !solid && besideSurface(cell, face);
    moved[face] = leaving(back ? own : beside[face], back ? face : face ^ 1);
  }
  vec4 sum = lasting ? lit : vec4(0.0);
  const float passing = solid ? 1.0 - texelFetch(volumeNormal, voxel, 0).w : 1.0;
  for (int face = 0; face < 6; ++face) {
    if (!besideSurface(cell, face)) {
      if (besideLight(cell, face)) sum += passing * moved[face];
      continue;
    }
#ifdef TRANSPARENT
    // What has entered a transparent surface is not held up within it.
    if (besideLight(cell, face)) sum += solid ? moved[face] : leaving(beside[face], face ^ 1);
#endif
    if (solid) continue;
    const ivec3 there = voxel + ivec3(faceDirection(face));
    const vec4 surface = texelFetch(volumeNormal, there, 0);
#if ALBEDO == ALBEDO_STORED
    const float albedo = texelFetch(volumeAlbedo, there, 0)[channel];
#else
    const float albedo = 0.5;
#endif
    if (surface.w > 0.0 && moved[face].x > 0.0) sum += albedo * reflected(moved[face], faceDirection(face), surface.xyz);
  }
  return holdsLight(cell) ? lightKept(keptOf(sum)) : vec4(0.0);
}

#if STEPS_TOGETHER > 1
uniform int steps;  // of these, at most STEPS_TOGETHER

// Lights of the group's voxels.
shared LightKept lights[kSide * kSide * kSide];

// Each invocation keeps its voxel for all steps; those at a group's sides drop out, as what they depend on is another group's.
void main() {
  const int layers = (gridSizeZ + kPropagateGroup - 1) / kPropagateGroup, channel = int(gl_WorkGroupID.z) / layers;
  const ivec3 local = ivec3(gl_LocalInvocationID);
  const ivec3 voxel = kPropagateGroup * (ivec3(gl_WorkGroupID) - ivec3(0, 0, channel * layers)) + local - STEPS_TOGETHER;
  const int first = channel * gridSizeZ, own_ = local.x + kSide * (local.y + kSide * local.z);
  const bool there = isInGrid(voxel);
  uint cell = 0u;
  vec4 own = vec4(0.0), lit = vec4(0.0);
  if (there) {
    cell = texelFetch(lightCells, voxel, 0).x;
    own = texelFetch(fields, ivec3(voxel.xy, 3 * from * gridSizeZ + first + voxel.z), 0);
    lit = texelFetch(source, ivec3(voxel.xy, first + voxel.z), 0);
  }
  lights[own_] = keptOf(own);
  barrier();
  for (int s = 1; s <= steps; ++s) {
    if (all(greaterThanEqual(local, ivec3(s))) && all(lessThan(local, ivec3(kSide - s)))) {
      vec4 beside[6];
      for (int face = 0; face < 6; ++face) {
        const ivec3 towards = ivec3(faceDirection(face));
        beside[face] = lightKept(lights[own_ + towards.x + kSide * (towards.y + kSide * towards.z)]);
      }
      own = afterStep(voxel, channel, cell, own, beside, lit);
    }
    if (s == steps) break;
    barrier();
    lights[own_] = keptOf(own);
    barrier();
  }
  const bool inner = all(greaterThanEqual(local, ivec3(STEPS_TOGETHER))) && all(lessThan(local, ivec3(kSide - STEPS_TOGETHER)));
  if (there && inner) imageStore(next, ivec3(voxel.xy, 3 * (1 - from) * gridSizeZ + first + voxel.z), own);
}
#else
void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);  // z: channel and layer
  if (any(greaterThanEqual(at, ivec3(gridSize().xy, 3 * gridSizeZ)))) return;
#ifdef STOPS
  if (step_ > 0 && uintBitsToFloat(changes[step_ - 1]) <= stopBelow) return;
#endif
  const int channel = at.z / gridSizeZ, read = (3 * from + channel) * gridSizeZ, write = 3 * (1 - from) * gridSizeZ;
  const ivec3 voxel = ivec3(at.xy, at.z - channel * gridSizeZ), last = gridSize() - 1;
  const uint cell = texelFetch(lightCells, voxel, 0).x;
  const vec4 own = texelFetch(fields, ivec3(voxel.xy, read + voxel.z), 0), lit = texelFetch(source, at, 0);
  vec4 beside[6];
  for (int face = 0; face < 6; ++face) {
    const ivec3 there = clamp(voxel + ivec3(faceDirection(face)), ivec3(0), last);
    beside[face] = texelFetch(fields, ivec3(there.xy, read + there.z), 0);
  }
  const vec4 sum = afterStep(voxel, channel, cell, own, beside, lit);
  imageStore(next, ivec3(at.xy, write + at.z), sum);
#ifdef STOPS
  if (holdsLight(cell)) atomicMax(changes[step_], floatBitsToUint(abs(sum.x - own.x)));
#endif
}
#endif
