// SPDX-License-Identifier: BSD-3-Clause
// A group a probe: the light of its two tiles, above and below, in spherical harmonics.
#include "renderer/techniques/many_lods/held_light.glsl"

layout(local_size_x = kGatherGroup) in;
layout(std430, binding = kGatherViewsBuffer) readonly buffer Views { CutView views[]; };
layout(std430, binding = kProbesBuffer) writeonly buffer Probes { vec4 probes[]; };

uniform int side;
uniform uint probeCount;
#include "renderer/techniques/many_lods/irradiance_volume/harmonics.glsl"

shared vec3 line[kGatherGroup];

void main() {
  const int me = int(gl_LocalInvocationIndex);
  for (uint probe = gl_WorkGroupID.x; probe < probeCount; probe += gl_NumWorkGroups.x) {
    vec3 sums[kProbeTerms];
    for (int i = 0; i < kProbeTerms; ++i) sums[i] = vec3(0.0);
    for (int pixel = me; pixel < 2 * side * side; pixel += kGatherGroup) {
      const uint number = 2u * probe + uint(pixel / (side * side));
      const int within = pixel % (side * side);
      const vec2 at = 2.0 * (vec2(within % side, within / side) + 0.5) / float(side) - 1.0;
      const float square = dot(at, at);
      if (square >= 1.0) continue;
      const CutView view = views[number];
      const vec3 towards =
          (2.0 * at.x * view.axisX.xyz + 2.0 * at.y * view.axisY.xyz + (1.0 - square) * view.axisZ.xyz) / (1.0 + square);
      const vec3 light = heldBy(number * uint(side * side) + uint(within), towards) *
                         (16.0 / (float(side * side) * (1.0 + square) * (1.0 + square)));
      for (int i = 0; i < kProbeTerms; ++i) sums[i] += light * harmonic(i, towards);
    }
    for (int i = 0; i < kProbeTerms; ++i) {
      barrier();
      line[me] = sums[i];
      barrier();
      for (int half_ = kGatherGroup / 2; half_ > 0; half_ /= 2) {
        if (me < half_) line[me] += line[me + half_];
        barrier();
      }
      if (me == 0) probes[probe * uint(kProbeTerms) + uint(i)] = vec4(line[0], 0.0);
    }
  }
}
