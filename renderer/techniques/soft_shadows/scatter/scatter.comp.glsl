// SPDX-License-Identifier: BSD-3-Clause
// Scatters the texels of a map of casters: each adds the share of the light that it hides to every texel of the soft shadow
// map whose receiver it can shadow. An invocation a caster texel.
#include "renderer/techniques/soft_shadows/scatter/scatter_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kScatterCastersUnit) uniform sampler2D casters;
layout(binding = kScatterReceiversUnit) uniform sampler2D receivers;
layout(binding = kScatterHiddenImage, r32ui) uniform uimage2D hidden;  // in parts of the light of 1 / kWhole
layout(std430, binding = kScatterCostsBuffer) buffer Costs { ScatterCosts costs; };

uniform int resolution, softResolution, maxIterations;
uniform vec2 tangentLow, tangentSize, softLow, softSize, lightSize;
uniform float casterNear, receiverNear, farthestReceiver, bias;
uniform float nothing;  // in the map of casters

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, ivec2(resolution)))) return;
  const float depth = texelFetch(casters, texel, 0).x;
  if (depth == nothing || depth <= 0.0) return;
  const float z = casterNear / depth;
  if (z >= farthestReceiver) return;
  const vec2 perTexel = tangentSize / float(resolution), low = tangentLow + vec2(texel) * perTexel, high = low + perTexel;
  // Receivers from which this texel covers any of the light, at the depth of the farthest of all.
  const vec2 reach = 0.5 * lightSize * (1.0 / z - 1.0 / farthestReceiver);
  const float texels = float(softResolution);
  const vec2 first = floor((low - reach - softLow) / softSize * texels - 0.5),
             last = ceil((high + reach - softLow) / softSize * texels - 0.5);
  const ivec2 from = ivec2(clamp(first, vec2(0.0), vec2(texels))), to = ivec2(clamp(last, vec2(-1.0), vec2(texels - 1.0)));
  const ivec2 count = to - from + 1;
  if (any(lessThanEqual(count, ivec2(0)))) return;
#ifdef COUNT
  atomicAdd(costs.casterTexels, 1u);
#endif
  if (float(count.x + 1) * float(count.y) > float(maxIterations)) {
    atomicAdd(costs.cutShort, 1u);
    return;
  }
  for (int y = from.y; y <= to.y; ++y)
    for (int x = from.x; x <= to.x; ++x) {
      const float receiver = texelFetch(receivers, ivec2(x, y), 0).x;
      if (receiver <= 0.0) continue;
      const float pz = receiverNear / receiver;
      if (!(z < pz - bias * pz)) continue;
      const vec2 at = softLow + (vec2(x, y) + 0.5) / texels * softSize;
      const float thrown = z * pz / (pz - z);
      const vec2 a = clamp(thrown * (low - at) / lightSize + 0.5, 0.0, 1.0),
                 b = clamp(thrown * (high - at) / lightSize + 0.5, 0.0, 1.0);
      const vec2 size = b - a;
      const uint share = uint(roundEven(size.x * size.y * WHOLE));
      if (share == 0u) continue;
      imageAtomicAdd(hidden, ivec2(x, y), share);
#ifdef COUNT
      atomicAdd(costs.splats, 1u);
#endif
    }
}
