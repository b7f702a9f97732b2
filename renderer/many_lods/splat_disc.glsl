// SPDX-License-Identifier: BSD-3-Clause
// What a node covers in a view's tile. The including shader declares `nodes` and `views` before. Without ORIENTED: the disc that its
// sphere projects to, and at least the pixel that its centre is in, all at one depth. ORIENTED: the disc of the sphere's radius in
// the plane of the node's normals, where pixels' middles see it, at the depth of each.
#include "renderer/many_lods/many_lods_bindings.h"

uniform ivec2 tilePx;
uniform float nearest;  // spheres whose middle is nearer are not drawn, world units
uniform float radiusScale;

struct Disc {
  vec2 centre;  // px, in the tile
  float radius;
  float depth;  // 0..1
  uint node, view;
#ifdef ORIENTED
  vec3 middle, normal;  // along the view's axes
  float reach2;         // squared radius, world units
  float inverseRange;
  vec2 tangents;        // of half the field of view; 0 in a hemisphere
#endif
};

#ifdef ORIENTED
#include "renderer/many_lods/cones.glsl"
layout(std430, binding = kSplatConesBuffer) readonly buffer NodeCones { uvec2 nodeCones[]; };

// Of the plane that stands for a node: the direction within its cone that faces the eye most, so that what is curved keeps its
// outline.
vec3 facingNormal(uint node, vec3 towardsEye) {
  const uvec2 cone = nodeCones[node];
  vec3 axis = coneAxis(cone);
  float cosine = dot(axis, towardsEye);
  if (cosine < 0.0) axis = -axis, cosine = -cosine;
  // Less what merging adds.
  const float turn = max(coneHalfAngle(cone) - float(kMostDepth) * kConeSlack, 0.0);
  const float between = acos(min(cosine, 1.0));
  if (turn >= between) return towardsEye;
  const vec3 side = towardsEye - axis * cosine;
  return dot(side, side) > 0.0 ? axis * cos(turn) + normalize(side) * sin(turn) : axis;
}
#endif

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
#ifdef ORIENTED
  const vec3 normal = facingNormal(disc.node, -v / distance_);
  disc.middle = at;
  disc.normal = vec3(dot(normal, view.axisX.xyz), dot(normal, view.axisY.xyz), dot(normal, view.axisZ.xyz));
  disc.reach2 = radius * radius;
  disc.inverseRange = view.frustum.z;
  disc.tangents = vec2(0.0);
#endif
  if (view.axisZ.w == float(kViewHemisphere)) {
    // Circles stay circles. What is wholly behind the horizon, which the tile's corners still show, is culled.
    if (at.z < -sphere.w) return false;
    const float across = length(at.xy);
    const float theta = atan(across, at.z), alpha = asin(min(radius / distance_, 1.0));
    const float from = tan(0.5 * max(theta - alpha, -2.9)), to = tan(0.5 * min(theta + alpha, 2.9));
    const vec2 direction = across > 0.0 ? at.xy / across : vec2(0.0);
    disc.centre = (0.5 + 0.25 * (from + to) * direction) * vec2(tilePx);
    disc.radius = 0.25 * (to - from) * float(tilePx.x);
    disc.depth = distance_ * view.frustum.z;
  } else {
    if (!(at.z > nearest)) return false;
    const vec2 outside = abs(at.xy) - at.z * vec2(view.axisX.w, view.axisY.w);
    if (any(greaterThan(outside, sphere.w * view.frustum.xy))) return false;  // culled
    disc.depth = at.z * view.frustum.z;
#ifdef ORIENTED
    disc.tangents = vec2(view.axisX.w, view.axisY.w);
    // Around the projection of the sphere, which is an ellipse.
    const vec2 theta = atan(at.xy, at.zz), alpha = asin(min(radius / sqrt(at.xy * at.xy + at.z * at.z), vec2(1.0)));
    const vec2 from = tan(max(theta - alpha, -1.5)) / disc.tangents, to = tan(min(theta + alpha, 1.5)) / disc.tangents;
    const vec2 half_ = 0.25 * (to - from) * vec2(tilePx);
    disc.centre = (0.5 + 0.25 * (from + to)) * vec2(tilePx);
    disc.radius = max(half_.x, half_.y);
#else
    disc.centre = (0.5 + 0.5 * at.xy / (at.z * vec2(view.axisX.w, view.axisY.w))) * vec2(tilePx);
    disc.radius = 0.5 * radius / (at.z * view.axisY.w) * float(tilePx.y);
#endif
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

// Whether it covers the pixel, and the bits of its depth there.
bool coversPixel(Disc disc, ivec2 pixel, out uint depth) {
#ifdef ORIENTED
  const vec2 at = 2.0 * (vec2(pixel) + 0.5) / vec2(tilePx) - 1.0;
  const float square = dot(at, at);
  const vec3 direction = disc.tangents.x > 0.0 ? vec3(at * disc.tangents, 1.0) : vec3(2.0 * at, 1.0 - square) / (1.0 + square);
  precise float along = dot(disc.normal, disc.middle) / dot(disc.normal, direction);
  const vec3 away = along * direction - disc.middle;
  depth = floatBitsToUint(clamp(along * disc.inverseRange, 0.0, kFarthestDepth));
  return along > 0.0 && dot(away, away) <= disc.reach2;
#else
  const vec2 away = vec2(pixel) + 0.5 - disc.centre;
  depth = floatBitsToUint(disc.depth);
  return dot(away, away) <= disc.radius * disc.radius || ivec2(floor(disc.centre)) == pixel;
#endif
}
