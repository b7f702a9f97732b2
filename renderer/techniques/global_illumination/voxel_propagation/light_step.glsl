// SPDX-License-Identifier: BSD-3-Clause
// A step of a voxel: what its neighbours send it. Light goes on in empty voxels; what goes from an empty voxel to an occupied one is
// partly let through, and partly comes back at once, so that opaque voxels hold no light and cannot pass it on. The including shader
// defines wallBeside().
//
// A step lasts as long as its chain of dependent fetches: the voxel's word and all lights first, then all shares of these.
#include "renderer/techniques/global_illumination/voxel_propagation/light_cells.glsl"
#include "renderer/techniques/global_illumination/voxel_propagation/transport.glsl"
#include "renderer/voxels/volume.glsl"

// Fields, of which a step reads one and writes another. Layer: (field * 3 + channel) * depth + z.
layout(binding = kPropagateFieldUnit) uniform sampler2DArray fields;
layout(binding = kPropagateOutImage, FIELD_FORMAT) uniform writeonly image2DArray next;
layout(binding = kPropagateSourceUnit) uniform sampler2DArray source;
uniform int from, to;  // the fields to read and to write
uniform bool lasting;  // sources

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

// What a voxel's neighbour beyond a face reflects by: mean normal and, in w, opacity; the channel's albedo.
struct Wall {
  vec4 surface;
  float albedo;
};
Wall fetchWall(ivec3 voxel, int channel) {
#if ALBEDO == ALBEDO_STORED
  const float albedo = texelFetch(volumeAlbedo, voxel, 0)[channel];
#else
  const float albedo = 0.5;
#endif
  return Wall(texelFetch(volumeNormal, voxel, 0), albedo);
}
// Of a voxel whose face is beside a surface.
Wall wallBeside(ivec3 voxel, int channel, int face);
// What comes back of light that moves from an empty voxel to the surface beyond a face.
vec4 reflectedAt(ivec3 voxel, int channel, int face, vec4 moved) {
  const Wall wall = wallBeside(voxel, channel, face);
  return wall.surface.w > 0.0 && moved.x > 0.0 ? wall.albedo * reflected(moved, faceDirection(face), wall.surface.xyz) : vec4(0.0);
}
// What a voxel that holds a surface lets through.
float passingShare(ivec3 voxel) { return 1.0 - texelFetch(volumeNormal, voxel, 0).w; }

// A voxel's light after a step. `beside`: lights from the side of each face; `lit`: its source.
vec4 afterStep(ivec3 voxel, int channel, uint cell, vec4 own, vec4 beside[6], vec4 lit) {
  const bool solid = holdsSurface(cell);
  vec4 moved[6];
  for (int face = 0; face < 6; ++face) {
    const bool back = !solid && besideSurface(cell, face);
    moved[face] = leaving(back ? own : beside[face], back ? face : face ^ 1);
  }
  vec4 sum = lasting ? lit : vec4(0.0);
  const float passing = solid ? passingShare(voxel) : 1.0;
  for (int face = 0; face < 6; ++face) {
    if (!besideSurface(cell, face)) {
      if (besideLight(cell, face)) sum += passing * moved[face];
      continue;
    }
#ifdef TRANSPARENT
    // What has entered a transparent surface is not held up within it.
    if (besideLight(cell, face)) sum += solid ? moved[face] : leaving(beside[face], face ^ 1);
#endif
#ifndef ABSORBS  // surfaces what reaches them
    if (!solid) sum += reflectedAt(voxel, channel, face, moved[face]);
#endif
  }
  return holdsLight(cell) ? lightKept(keptOf(sum)) : vec4(0.0);
}
