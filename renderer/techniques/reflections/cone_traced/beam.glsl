// SPDX-License-Identifier: BSD-3-Clause
// A cone, and what of it a triangle fills: the triangle is cut at the plane through the mirrored point across the cone's axis,
// which is the near plane of Roger 2008, section 5.2.2, and at the mirror's own plane there, below which no light arrives;
// the rest is projected so that the cone becomes the unit disk. Lengths are those of the scene, and results do not depend on
// their unit. As projectedToDisk() in cone_geometry.h.
#define OVERLAP_CORNERS 5
#include "renderer/techniques/reflections/cones/disk_overlap.glsl"

struct Beam {
  vec3 origin;
  float radius;  // there
  vec3 axis;
  float growth;  // of the radius per unit of distance
  vec3 x, y;     // across the axis
  vec3 above;    // normal of the mirror's plane, in coordinates x, y and along the axis
  float share;   // of the cone that is above the mirror
};

// What a triangle fills of a beam.
struct BeamShare {
  float share;  // of the part above the mirror
  vec2 middle;  // of the overlap, in the disk
  float along;  // distance there, along the axis
};

vec2 beamPolygon[OVERLAP_CORNERS];  // of the last overlap
int beamCorners;

Beam beamOf(vec4 origin, vec4 direction, vec3 normal) {
  Beam beam;
  beam.origin = origin.xyz;
  beam.radius = origin.w;
  beam.axis = direction.xyz;
  beam.growth = direction.w;
  beam.x = normalize(cross(beam.axis, abs(beam.axis.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  beam.y = cross(beam.axis, beam.x);
  beam.above = vec3(dot(normal, beam.x), dot(normal, beam.y), dot(normal, beam.axis));
  // Directions at this distance from the axis run along the mirror; beyond are those below it.
  const float chord = beam.above.z / max(beam.growth * length(beam.above.xy), 1e-30);
  beam.share = chord < 1.0 ? 1.0 - (acos(chord) - chord * sqrt(1.0 - chord * chord)) / 3.14159265 : 1.0;
  return beam;
}

vec3 inBeam(Beam beam, vec3 point) {
  const vec3 from = point - beam.origin;
  return vec3(dot(from, beam.x), dot(from, beam.y), dot(from, beam.axis));
}

// The part of a polygon where dot(plane, p) > least.
int cutPolygon(inout vec3 corners[OVERLAP_CORNERS], int count, vec3 plane, float least) {
  vec3 kept[OVERLAP_CORNERS];
  int out_ = 0;
  for (int i = 0; i < OVERLAP_CORNERS; ++i) {
    if (i >= count) break;
    const vec3 p = corners[i], q = corners[i + 1 < count ? i + 1 : 0];
    const float here = dot(plane, p) - least, there = dot(plane, q) - least;
    if (here > 0.0 && out_ < OVERLAP_CORNERS) kept[out_++] = p;
    if ((here > 0.0) != (there > 0.0) && out_ < OVERLAP_CORNERS) kept[out_++] = mix(p, q, here / (here - there));
  }
  corners = kept;
  return out_;
}

// `tolerance`: as originTolerance. Of no share: share 0.
BeamShare shareOf(Beam beam, vec3 a, vec3 b, vec3 c, float tolerance) {
  BeamShare none = BeamShare(0.0, vec2(0.0), 0.0);
  beamCorners = 0;
  vec3 corners[OVERLAP_CORNERS];
  corners[0] = inBeam(beam, a);
  corners[1] = inBeam(beam, b);
  corners[2] = inBeam(beam, c);
  corners[3] = corners[4] = vec3(0.0);
  const vec3 p = corners[0], q = corners[1], r = corners[2];
  const vec3 depths = vec3(p.z, q.z, r.z);
  const vec3 heights = vec3(dot(beam.above, p), dot(beam.above, q), dot(beam.above, r));
  const float lowest = min(heights.x, min(heights.y, heights.z)), highest = max(heights.x, max(heights.y, heights.z));
  const float nearest = min(depths.x, min(depths.y, depths.z)), farthest_ = max(depths.x, max(depths.y, depths.z));
  if (!(highest > tolerance) || !(farthest_ > 0.0)) return none;
  int count = 3;
  if (lowest <= tolerance) count = cutPolygon(corners, count, beam.above, tolerance);
  if (nearest <= 0.0 && count > 2) count = cutPolygon(corners, count, vec3(0.0, 0.0, 1.0), 0.0);
  if (count < 3) return none;
  for (int i = 0; i < OVERLAP_CORNERS; ++i)
    beamPolygon[i] = i < count ? corners[i].xy / (beam.radius + corners[i].z * beam.growth) : vec2(0.0);
  beamCorners = count;
  const vec3 found = diskOverlap(beamPolygon, count);
  if (!(found.x > 0.0)) return none;
  // Where the ray of the beam through the middle meets the triangle's plane; scaled as in planeNormal().
  const vec3 reach = max(abs(q - p), abs(r - p));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  const vec3 normal = cross((q - p) * unit, (r - p) * unit);
  const float level = dot(normal, p - vec3(beam.radius * found.yz, 0.0));
  const float along = level / dot(normal, vec3(beam.growth * found.yz, 1.0));
  // Of a triangle seen edge-on the quotient means nothing.
  const float least = max(nearest, 0.0);
  return BeamShare(min(found.x / (3.14159265 * beam.share), 1.0), found.yz,
                   isnan(along) ? least : clamp(along, least, farthest_));
}

// The beam's ray through a point of the disk, at a distance along the axis.
vec3 beamPoint(Beam beam, vec2 middle, float along) {
  const vec2 aside = (beam.radius + beam.growth * along) * middle;
  return beam.origin + along * beam.axis + aside.x * beam.x + aside.y * beam.y;
}
vec3 beamDirection(Beam beam, vec2 middle) {
  const vec2 aside = beam.growth * middle;
  return normalize(beam.axis + aside.x * beam.x + aside.y * beam.y);
}
