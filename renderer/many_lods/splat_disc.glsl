// SPDX-License-Identifier: BSD-3-Clause
// The disc that a node's sphere projects to in a view's tile. The including shader declares `nodes` and `views` before.
#include "renderer/many_lods/many_lods_bindings.h"

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
