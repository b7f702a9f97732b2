// SPDX-License-Identifier: BSD-3-Clause
// Nodes of a hierarchy over rays: bundles of rays, how they merge, and which spheres they may meet. The comments are in
// cone_sphere.h.
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

#ifdef CONES
uniform float farthest;  // where cones end
#endif

const float kInflation = 1.9073486e-6;  // 16 epsilon of float

float halfAngle(vec3 a, vec3 b) {
  const float sum = length(a + b), difference = length(a - b);
  return sum > difference / kAllDirections ? difference / sum : kAllDirections;
}

float widened(float turned, float spread) {
  const float rest = 1.0 - turned * spread - kInflation;
  const float sum = (turned + spread) * (1.0 + kInflation) + kInflation;
  return rest * kAllDirections > sum ? sum / rest : kAllDirections;
}

void includePart(inout ConeSphere whole, ConeSphere part) {
  whole.radius = max(whole.radius, (length(part.centre - whole.centre) + part.radius) * (1.0 + kInflation));
  whole.spread = max(whole.spread, part.spread >= kAllDirections ? kAllDirections
                                                                 : widened(halfAngle(whole.axis, part.axis), part.spread));
}

const ConeSphere kNoRays = ConeSphere(vec3(0.0), -1.0, vec3(0.0, 0.0, 1.0), 0.0);

ConeSphere rayNode(vec3 origin, vec3 direction) { return ConeSphere(origin, 0.0, normalize(direction), kInflation); }

// A cone: point on its axis and radius there, direction and growth of the radius per unit of distance. The bundle of rays
// that start within that radius and diverge no more contains it.
ConeSphere coneNode(vec4 origin, vec4 direction) {
  const float growth = direction.w;
  return ConeSphere(origin.xyz, origin.w, normalize(direction.xyz),
                    growth / (1.0 + sqrt(1.0 + growth * growth)) * (1.0 + kInflation) + kInflation);
}

#if MERGE == MERGE_MEAN
ConeSphere merged(ConeSphere parts[4]) {
  ConeSphere whole = kNoRays;
  vec3 centres = vec3(0.0), axes = vec3(0.0);
  float count = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (!(parts[i].radius >= 0.0)) continue;
    centres += parts[i].centre;
    axes += parts[i].axis;
    count += 1.0;
  }
  if (count == 0.0) return whole;
  whole.centre = centres / count;
  const float size = length(axes);
  if (size > 1e-4)
    whole.axis = axes / size;
  else
    whole.spread = kAllDirections;
  for (int i = 0; i < 4; ++i)
    if (parts[i].radius >= 0.0) includePart(whole, parts[i]);
  return whole;
}
#else
ConeSphere mergedPair(ConeSphere a, ConeSphere b) {
  if (!(a.radius >= 0.0)) return b;
  if (!(b.radius >= 0.0)) return a;
  ConeSphere whole = a;
  const vec3 between = b.centre - a.centre;
  const float apart = length(between);
  if (apart + a.radius <= b.radius)
    whole.centre = b.centre;
  else if (apart + b.radius > a.radius)
    whole.centre = a.centre + between * (0.5 * (apart + b.radius - a.radius) / apart);
  whole.radius = -1.0;
  whole.spread = 0.0;
  const float wideA = 2.0 * atan(a.spread), wideB = 2.0 * atan(b.spread);
  const float turn = 2.0 * atan(halfAngle(a.axis, b.axis));
  if (turn + wideA <= wideB) {
    whole.axis = b.axis;
  } else if (turn + wideB > wideA) {
    const vec3 across = b.axis - dot(a.axis, b.axis) * a.axis;
    const float size = length(across), by = 0.5 * (wideB + turn - wideA);
    if (size > 1e-6)
      whole.axis = normalize(cos(by) * a.axis + sin(by) / size * across);
    else if (dot(a.axis, b.axis) < 0.0)
      whole.spread = kAllDirections;
  }
  includePart(whole, a);
  includePart(whole, b);
  return whole;
}

ConeSphere merged(ConeSphere parts[4]) {
  return mergedPair(mergedPair(mergedPair(parts[0], parts[1]), parts[2]), parts[3]);
}
#endif

// `sphere`: centre and radius; a radius below 0: nothing.
bool mayMeet(ConeSphere node, vec4 sphere) {
  if (!(node.radius >= 0.0) || !(sphere.w >= 0.0)) return false;
  if (node.spread >= kAllDirections) return true;
  const vec3 v = sphere.xyz - node.centre, size = abs(v);
  const float along = dot(v, node.axis), beside = length(cross(v, node.axis));
  const float h = node.spread, one = 1.0 + h * h, cosine = 1.0 - h * h, sine = 2.0 * h;
  const float reach = node.radius + sphere.w + kInflation * (size.x + size.y + size.z);
#ifdef CONES
  // A cone's end is a plane: from its rim it is farther away than along the axis.
  if (h < 1.0 && length(v) > farthest * one / cosine + reach) return false;
#endif
#if TEST == TEST_PRINTED
  return along * (sine / cosine) + reach * (one / cosine) >= beside;
#else
#if TEST == TEST_TIGHT
  if (h < 1.0 && along * cosine + beside * sine < 0.0) return dot(v, v) <= reach * reach * (1.0 + kInflation);
#endif
  return beside * cosine - along * sine <= reach * one;
#endif
}
