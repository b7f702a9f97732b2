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
