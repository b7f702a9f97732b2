// SPDX-License-Identifier: BSD-3-Clause
// Whether a node is fine enough for a view. See node_predicate.h, of which this is the twin: the same operations in the same
// order, without fused ones, so that both decide alike.
#include "renderer/many_lods/many_lods_bindings.h"

// What is wholly outside a view is fine enough, whatever its size.
bool isCulledAt(vec3 centre, float radius, uint levelsAboveLeaves, CutView view) {
  precise vec3 v = centre - view.eye.xyz;
  // Rounding moves what is compared by a few 2^-24 of |v|; what decides gives way by more at each level, so that no child of what
  // is culled is not.
  precise float give = radius + kCullSlack * float(levelsAboveLeaves) * (abs(v.x) + abs(v.y) + abs(v.z));
  precise float depth = v.x * view.axisZ.x + v.y * view.axisZ.y + v.z * view.axisZ.z;
  if (view.axisZ.w == float(kViewHemisphere)) return depth < -give;
  precise float x = v.x * view.axisX.x + v.y * view.axisX.y + v.z * view.axisX.z;
  precise float y = v.x * view.axisY.x + v.y * view.axisY.y + v.z * view.axisY.z;
  precise float outX = abs(x) - depth * view.axisX.w, outY = abs(y) - depth * view.axisY.w;
  precise float giveX = give * view.frustum.x, giveY = give * view.frustum.y;
  return outX > giveX || outY > giveY || depth < -give;
}

bool isCulled(vec3 centre, float radius, uint node, uint leaves, CutView view) {
  return isCulledAt(centre, radius, uint(findMSB(leaves) - findMSB(node)), view);
}

bool isFineEnough(vec4 sphere, CutView view) {
  precise vec3 v = sphere.xyz - view.eye.xyz;
  precise float distance2 = v.x * v.x + v.y * v.y + v.z * v.z;
  precise float size2 = view.eye.w * (sphere.w * sphere.w);
  return distance2 > size2;
}

bool isValid(vec4 sphere, uint node, uint leaves, CutView view) {
  return node >= leaves || isFineEnough(sphere, view) || isCulled(sphere.xyz, sphere.w, node, leaves, view);
}

#ifdef MARGINS
const float kNoMargin = 1e38;  // never to be tested again

// How far a node and the eye may move apart or together, and how far, turning included, what is seen from the eye may move across, before
// what is said of the node's validity can change; no more than rounding leaves certain. A change of the radius counts q times, as in
// isFineEnough(). `valid`: what that or isCulledAt() said of the node, which is no leaf.
vec2 marginsOf(vec4 sphere, uint levelsAboveLeaves, CutView view, bool valid) {
  const vec3 v = sphere.xyz - view.eye.xyz;
  const float distance_ = length(v), size = sqrt(view.eye.w) * sphere.w, rounding = 4e-6 * (distance_ + size);
  const float apart = distance_ - size;
  if (valid && apart > rounding) return vec2(apart - rounding, kNoMargin);
  const float depth = dot(v, view.axisZ.xyz);
  float outside = -depth;
  if (view.axisZ.w != float(kViewHemisphere)) {
    const float x = abs(dot(v, view.axisX.xyz)), y = abs(dot(v, view.axisY.xyz));
    outside = max(outside, (x - depth * view.axisX.w) / view.frustum.x);
    outside = max(outside, (y - depth * view.axisY.w) / view.frustum.y);
  }
  outside -= sphere.w + kCullSlack * float(levelsAboveLeaves) * (abs(v.x) + abs(v.y) + abs(v.z));
  return valid ? vec2(kNoMargin, outside - rounding) : vec2(-apart, -outside) - rounding;
}

// Rounded down, to 8 bits of mantissa each.
uint packedMargins(vec2 margins) {
  const uvec2 bits = floatBitsToUint(max(margins, vec2(0.0)));
  return (bits.x & 0xffff0000u) | bits.y >> 16u;
}
vec2 unpackedMargins(uint bits) { return uintBitsToFloat(uvec2(bits & 0xffff0000u, bits << 16u)); }
#endif
