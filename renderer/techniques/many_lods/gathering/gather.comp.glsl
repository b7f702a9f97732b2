// SPDX-License-Identifier: BSD-3-Clause
// A group a view: the mean over the hemisphere, by the cosine, of what its pixels hold. LIGHT: the light of nodes (FORM: of the
// atlas), and what the glossy lobe reflects of it towards the camera; else 1 where nothing is within the radius.
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGatherGroup) in;
layout(std430, binding = kGatherViewsBuffer) readonly buffer Views { CutView views[]; };
#ifndef LIGHT
layout(std430, binding = kGatherDepthsBuffer) readonly buffer Depths { uint depths[]; };
#endif
layout(std430, binding = kGatheredBuffer) writeonly buffer Gathered { vec4 gathered[]; };

uniform int side;
uniform float farthest;  // depth beyond which nothing occludes
uniform uint viewCount;
uniform float lift;        // of views above their surfaces, world units
uniform vec3 eyePosition;  // relative to the anchor

shared vec4 line[kGatherGroup];

#ifdef LIGHT
#include "renderer/techniques/many_lods/glossy.glsl"
#include "renderer/techniques/many_lods/held_light.glsl"
shared vec4 glossLine[kGatherGroup];
#else
float openAt(uint at) { return depths[at] == kAtlasEmpty || uintBitsToFloat(depths[at]) > farthest ? 1.0 : 0.0; }
#endif

void main() {
  const int me = int(gl_LocalInvocationIndex);
  for (uint number = gl_WorkGroupID.x; number < viewCount; number += gl_NumWorkGroups.x) {
    const CutView view = views[number];
    vec4 sum = vec4(0.0), gloss = vec4(0.0);
    const vec3 back = normalize(eyePosition - (view.eye.xyz - lift * view.axisZ.xyz));
    for (int pixel = me; pixel < side * side; pixel += kGatherGroup) {
      const vec2 at = 2.0 * (vec2(pixel % side, pixel / side) + 0.5) / float(side) - 1.0;
      const float square = dot(at, at);
      if (square >= 1.0) continue;
      // Of a stereographic pixel: cosine (1 - s) / (1 + s), solid angle in proportion to 1 / (1 + s)^2.
      const float solidAngle = 16.0 / (float(side * side) * (1.0 + square) * (1.0 + square));
      const float weight = solidAngle * (1.0 - square) / (1.0 + square);
      const uint index = number * uint(side * side) + uint(pixel);
#ifdef LIGHT
      const vec3 towards = (2.0 * at.x * view.axisX.xyz + 2.0 * at.y * view.axisY.xyz + (1.0 - square) * view.axisZ.xyz) / (1.0 + square);
      const vec3 light = heldBy(index, towards);
      sum += weight * vec4(light, 1.0);
      if (glossShare > 0.0) gloss.rgb += solidAngle * light * reflectedShare(vec3(0.0), view.axisZ.xyz, back, towards);
#else
      sum += weight * vec4(vec3(openAt(index)), 1.0);
#endif
    }
    barrier();
    line[me] = sum;
#ifdef LIGHT
    glossLine[me] = gloss;
#endif
    barrier();
    for (int half_ = kGatherGroup / 2; half_ > 0; half_ /= 2) {
      if (me < half_) {
        line[me] += line[me + half_];
#ifdef LIGHT
        glossLine[me] += glossLine[me + half_];
#endif
      }
      barrier();
    }
    if (me == 0) {
      gathered[number] = vec4(line[0].rgb / line[0].a, 1.0);
#ifdef LIGHT
      gathered[viewCount + number] = glossLine[0];
#endif
    }
  }
}
