// SPDX-License-Identifier: BSD-3-Clause
// Draws the nodes of a list of cuts into their views' tiles as discs, the projections of their spheres. FORM: what is kept of the
// nearest (view_atlas.h). WINNERS: second pass of kFormTwoPasses.
#if FORM == 2
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
#endif
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/many_lods/depth_packing.glsl"

layout(local_size_x = kSplatGroup) in;
layout(std430, binding = kCutNodesBuffer) readonly buffer Nodes { vec4 nodes[]; };
layout(std430, binding = kCutViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kCutListBuffer) readonly buffer List { uvec2 list[]; };
layout(std430, binding = kCutControlBuffer) readonly buffer Control { CutControl control; };
#if FORM == 2
layout(std430, binding = kSplatDepthsBuffer) buffer Depths { uint64_t depths[]; };
#else
layout(std430, binding = kSplatDepthsBuffer) buffer Depths { uint depths[]; };
#endif
#if FORM == 1 || FORM == 3
layout(std430, binding = kSplatWinnersBuffer) buffer Winners { uint winners[]; };
#endif
#if FORM == 3
layout(std430, binding = kSplatColoursBuffer) readonly buffer Colours { uvec2 colours[]; };
#endif

uniform ivec2 tilePx;
uniform float nearest;  // spheres whose middle is nearer are not drawn, world units
uniform float radiusScale;

struct Disc {
  vec2 centre;  // px, in the tile
  float radius;
  float depth;  // 0..1
  uint node, view;
};

// False: none of it shows.
bool discOf(uvec2 entry, out Disc disc) {
  disc.node = entry.x;
  disc.view = entry.y & ~kEntryDone;
  const vec4 sphere = nodes[disc.node];
  const CutView view = views[disc.view];
  const vec3 v = sphere.xyz - view.eye.xyz;
  const vec3 at = vec3(dot(v, view.axisX.xyz), dot(v, view.axisY.xyz), dot(v, view.axisZ.xyz));
  const float distance_ = length(v), radius = sphere.w * radiusScale;
  if (!(distance_ > nearest)) return false;
  if (view.axisZ.w == float(kViewHemisphere)) {
    // Circles stay circles. Far behind the horizon nothing is in the tile.
    if (at.z < -0.5 * distance_ - radius) return false;
    const float across = length(at.xy);
    const float theta = atan(across, at.z), alpha = asin(min(radius / distance_, 1.0));
    const float from = tan(0.5 * max(theta - alpha, -2.9)), to = tan(0.5 * min(theta + alpha, 2.9));
    const vec2 direction = across > 0.0 ? at.xy / across : vec2(0.0);
    disc.centre = (0.5 + 0.25 * (from + to) * direction) * vec2(tilePx);
    disc.radius = 0.25 * (to - from) * float(tilePx.x);
    disc.depth = distance_ * view.frustum.z;
  } else {
    if (!(at.z > nearest)) return false;
    disc.centre = (0.5 + 0.5 * at.xy / (at.z * vec2(view.axisX.w, view.axisY.w))) * vec2(tilePx);
    disc.radius = 0.5 * radius / (at.z * view.axisY.w) * float(tilePx.y);
    disc.depth = at.z * view.frustum.z;
  }
  disc.depth = clamp(disc.depth, 0.0, kFarthestDepth);
  return true;
}

// Pixels whose centres may be in the disc, and the one that its centre is in; within the tile.
void boxOf(Disc disc, out ivec2 low, out ivec2 high) {
  const vec2 most = vec2(tilePx) + 1.0;
  const vec2 from = clamp(min(ceil(disc.centre - disc.radius - 0.5), floor(disc.centre)), vec2(-1.0), most);
  const vec2 to = clamp(max(floor(disc.centre + disc.radius - 0.5), floor(disc.centre)), vec2(-2.0), most);
  low = max(ivec2(from), ivec2(0));
  high = min(ivec2(to), tilePx - 1);
}

void cover(Disc disc, ivec2 pixel) {
  const vec2 away = vec2(pixel) + 0.5 - disc.centre;
  if (dot(away, away) > disc.radius * disc.radius && ivec2(floor(disc.centre)) != pixel) return;
  const uint at = (disc.view * uint(tilePx.y) + uint(pixel.y)) * uint(tilePx.x) + uint(pixel.x);
  const uint depth = floatBitsToUint(disc.depth);
#if FORM == 0
  atomicMin(depths[at], depth);
#elif FORM == 1
#ifdef WINNERS
  if (depths[at] == depth) atomicMin(winners[at], disc.node);
#else
  atomicMin(depths[at], depth);
#endif
#elif FORM == 2
  atomicMin(depths[at], packUint2x32(uvec2(disc.node, depth)));
#else
  const uvec2 halves = colours[disc.node];
  const vec3 colour = clamp(vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x), 0.0, 1.0);
  const uvec3 bytes = uvec3(round(colour * 255.0));
  const uvec2 words = packedSplat(disc.depth, bytes.x | bytes.y << 8u | bytes.z << 16u);
  atomicMin(depths[at], words.x);
  atomicMin(winners[at], words.y);
#endif
}

shared Disc large[kSplatGroup];
shared uint largeCount;

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = control.count, at = control.readAt;
  for (uint first = gl_WorkGroupID.x * uint(kSplatGroup); first < count; first += gl_NumWorkGroups.x * uint(kSplatGroup)) {
    if (me == 0u) largeCount = 0u;
    barrier();
    Disc disc;
    if (first + me < count && discOf(list[at + first + me], disc)) {
      ivec2 low, high;
      boxOf(disc, low, high);
      const ivec2 size = max(high - low + 1, ivec2(0));
      if (size.x * size.y > kSmallSplatPx) {
        large[atomicAdd(largeCount, 1u)] = disc;
      } else {
        for (int y = low.y; y <= high.y; ++y)
          for (int x = low.x; x <= high.x; ++x) cover(disc, ivec2(x, y));
      }
    }
    barrier();
    const uint discs = largeCount;
    for (uint i = 0u; i < discs; ++i) {
      const Disc shared_ = large[i];
      ivec2 low, high;
      boxOf(shared_, low, high);
      const ivec2 size = high - low + 1;
      for (int pixel = int(me); pixel < size.x * size.y; pixel += kSplatGroup)
        cover(shared_, low + ivec2(pixel % size.x, pixel / size.x));
    }
    barrier();
  }
}
